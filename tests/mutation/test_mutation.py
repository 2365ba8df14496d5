"""The mutation run itself: what is broken is seen, what is not is not, nothing hangs, and the tree stays as it is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.mutation import mutants
from tests.mutation.killers import KILLERS, calls
from tests.mutation.mutants import PACKAGES, ROOT, Mutant, Place, changed, sample
from tests.mutation.reasons import reason, reasons
from tests.mutation.run import ENDLESS, KILLED, NO_IMPORT, SURVIVED, TREE, Laboratory, Outcome, Unsound
from tests.mutation.table import EQUAL, judged, line, percent, section

MODULE = "kinsym/algebra/half.py"
GOOD = '''
def half(value: int) -> int:
    """
    >>> half(8)
    4
    """
    while value % 2:
        value += 1
    return value // 2
'''
SETTINGS = """
[tool.pytest.ini_options]
addopts = "--doctest-modules --import-mode=importlib"
consider_namespace_packages = true
pythonpath = ["."]
"""
TEST = "from kinsym.algebra.half import half\n\n\ndef test_half():\n    assert half(7) == 4\n"


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Laboratory:
    """A project of one module and one test, and a copy of it."""
    root = tmp_path_factory.mktemp("project")
    for name in TREE[:-1]:
        (root / name).mkdir()
    (root / "kinsym" / "algebra").mkdir()
    for name, text in {
        MODULE: GOOD,
        "kinsym/__init__.py": "",
        "tests/test_half.py": TEST,
        "pyproject.toml": SETTINGS,
    }.items():
        (root / name).write_text(text, encoding="utf-8")
    return Laboratory(tmp_path_factory.mktemp("copy"), root, lambda module: (module, "tests/test_half.py"))


def mutant(before: str, after: str) -> Mutant:
    """The module with a part of it replaced."""
    assert before in GOOD
    return changed(MODULE, GOOD, GOOD.replace(before, after), "ReplaceBinaryOperator_Add_Sub")


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("value // 2", "value // 3", f"{MODULE}::kinsym.algebra.half.half"),
        ("value += 1", "value -= 1", "tests/test_half.py::test_half"),
        ("value += 1", "value += 2", ENDLESS),
        ("\ndef half", "\n1 / 0\ndef half", NO_IMPORT),
    ],
)
def test_what_is_broken_is_killed(
    laboratory: Laboratory, monkeypatch: pytest.MonkeyPatch, before: str, after: str, reason: str
) -> None:
    if reason == ENDLESS:
        monkeypatch.setattr("tests.mutation.run.SECONDS", 1)
    outcome = laboratory.try_out(mutant(before, after))
    assert (outcome.outcome, outcome.reason) == (KILLED, reason)


def test_what_is_not_broken_survives_also_after_what_was(laboratory: Laboratory) -> None:
    assert laboratory.try_out(mutant("value += 1", "value -= 1")).outcome == KILLED
    assert laboratory.try_out(mutant("value += 1", "value = value + 1")).outcome == SURVIVED


def test_tests_that_fail_without_a_change_are_no_judge(tmp_path: Path) -> None:
    root = tmp_path / "root"
    for name in TREE[:-1]:
        (root / name).mkdir(parents=True)
    (root / "pyproject.toml").write_text("", encoding="utf-8")
    (root / "tests" / "test_no.py").write_text("def test_no():\n    assert False\n", encoding="utf-8")
    (tmp_path / "copy").mkdir()
    with pytest.raises(Unsound, match=r"tests/test_no\.py::test_no"):
        Laboratory(tmp_path / "copy", root, lambda module: ("tests/test_no.py",)).try_out(mutant("% 2", "% 3"))


def test_lines_that_change_are_named() -> None:
    one = mutant("value % 2", "value %  3")
    assert str(one) == f"{MODULE}:7: while value % 2: -> while value % 3:"
    assert one.package == "algebra"


def test_a_seed_draws_a_place_first_and_what_is_no_program_never(monkeypatch: pytest.MonkeyPatch) -> None:
    def made(module: str, operator: str, occurrence: int, root: Path) -> Mutant | None:
        return None if operator == "no program" else replace(mutant("% 2", "% 3"), line=occurrence, operator=operator)

    monkeypatch.setattr(mutants, "_mutant", made)
    ways = tuple((f"way {number}", 0) for number in range(11))
    every = [Place(module=MODULE, operators=(("no program", 0), *ways))]
    every += [Place(module=MODULE, operators=(("other", number), ("no program", 0))) for number in range(1, 20)]
    every += [Place(module=MODULE, operators=(("no program", 0),))]
    drawn = list(sample(every, 1))
    assert drawn == list(sample(every, 1)) != list(sample(every, 2))
    assert sorted(one.line for one in drawn) == list(range(20))
    assert list(sample(every[1:], 1)) == [one for one in drawn if one.operator == "other"]


def test_what_is_never_computed_is_left_alone() -> None:
    text = f"{GOOD}\npairs = dict(zip((), (), strict=True))"
    lines = text.splitlines()
    idle = [lines[start[0] - 1][start[1] : end[1]] for start, end in sorted(mutants._idle(text))]
    assert idle == ["int", "int", "True"]


def test_without_cosmic_ray_one_line_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    from importlib import metadata

    def missing(name: str) -> str:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", missing)
    with pytest.raises(SystemExit, match=r"pip install 'cosmic-ray>="):
        mutants.version()


def test_every_module_has_tests_that_exist() -> None:
    paths = [path for name in PACKAGES for path in (ROOT / "kinsym" / name).rglob("*.py")]
    every = {call for path in paths for call in calls(path.relative_to(ROOT).as_posix())}
    assert all((ROOT / name.partition("::")[0]).exists() for call in every for name in call.split())
    assert all((ROOT / name).exists() for name in KILLERS)
    assert calls("kinsym/inverse/locks.py")[1] == KILLERS["kinsym/inverse/locks.py"][0]


def test_reasons_are_of_lines_that_exist() -> None:
    known = reasons()
    for (module, before, after), why in known.items():
        text = " ".join((ROOT / module).read_text(encoding="utf-8").split())
        assert before in text, f"{module} has no line {before!r} any more"
        assert after != before
        assert why.endswith(".")


def test_the_score_leaves_out_what_cannot_be_killed() -> None:
    one = mutant("value % 2", "value % 3")
    killed = Outcome(mutant=one, outcome=KILLED, reason="tests/test_half.py::test_half", seconds=0.5)
    lives = Outcome(mutant=one, outcome=SURVIVED, reason="", seconds=1.0)
    why = reason(one, {(one.module, one.before, one.after): "Both are odd."})
    assert (why, reason(one, {})) == ("Both are odd.", "")
    assert [judged(killed, why), judged(lives, why), judged(lives, "")] == [KILLED, EQUAL, SURVIVED]
    assert (percent([KILLED, KILLED, EQUAL]), percent([KILLED, SURVIVED]), percent([EQUAL])) == (
        "100.0",
        "50.0",
        "100.0",
    )
    assert line(lives, why).endswith("(Both are odd.)")
    text = section(
        [(killed, ""), (lives, why), (lives, "")], {"algebra": 7, "kinematics": 8, "inverse": 9}, "command", "8"
    )
    assert "| `kinsym/algebra/` | 7 | 3 | 1 | 1 | 1 | 50.0 |" in text
    assert "| `tests/test_half.py` | 1 |" in text
    assert "| replace binary operator | 3 | 1 | 1 | 1 | 50.0 |" in text
    assert text[-1] == f"* `{one}`: Both are odd."
