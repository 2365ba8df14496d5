"""``--real float`` from the command line to the report, and whether its checks would see a fault."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest

import kinsym as ks
from kinsym.check.compare import compare
from kinsym.check.poses import Counts
from kinsym.check.report import FAILED
from kinsym.check.single import (
    BATCH_LAW,
    CLOSURE_LAW,
    COPY_LAW,
    EMPTY_LAW,
    FAR_LAW,
    FORWARD_LAW,
    JACOBIAN_LAW,
    KNOWN_LAW,
    ORDINARY_LAW,
    RANGE_LAW,
    SAME_LAW,
)
from kinsym.cli import main
from kinsym.emit import TARGETS
from kinsym.errors import UsageError
from tests import arms
from tests.emit.built import needs_compiler
from tests.single.arms import single_schedule

pytestmark = needs_compiler

FEW = Counts(uniform=60, quarter=30, singular=40, pair=8, exact=8)


@pytest.fixture(autouse=True)
def few_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kinsym.check.compare.counts_of", lambda schedule: FEW)


@cache
def sources(name: str) -> dict[str, str]:
    return TARGETS["c"](single_schedule(name))


def failures(name: str, texts: dict[str, str]) -> set[str]:
    """The laws that fail."""
    findings = compare(arms.derivation(name).robot, single_schedule(name), texts)
    return {check.law for check in findings.checks if check.status == FAILED}


#: A slide, a wrist, a locked joint, five joints for a position and an axis, a root search.
@pytest.mark.parametrize("name", ["scara", "puma560", "kuka_iiwa", "scorbot_5r", "cylindrical_rpp", "general_3r"])
def test_good_code_passes(name: str) -> None:
    assert failures(name, sources(name)) == set()


CALL = "planar_rr_ik_marked(T, p, reference, q, marks)"
NEAR = f"return {CALL};"
#: What is changed in the C of two links, and a law that has to see it.
FAULTS = {
    "a length off by a thousandth": ("const float l2 = p->l2;", "const float l2 = 1.001f * p->l2;", FORWARD_LAW),
    "a slope": ("J[0] = ", "J[0] = 1e-4f + ", JACOBIAN_LAW),
    "a soft solution": (NEAR, f"const int n = {CALL};\n    q[0][1] += 1e-3f;\n    return n;", CLOSURE_LAW),
    "a few digits less": ("q[count][1] = theta2;", "q[count][1] = theta2 * 1.00005f;", ORDINARY_LAW),
    "a branch lost": ("for (int i1 = 0; i1 < n1; ++i1) {", "for (int i1 = 0; i1 < n1 - 1; ++i1) {", KNOWN_LAW),
    "the other branch lost": ("for (int i1 = 0; i1 < n1; ++i1) {", "for (int i1 = n1 / 2; i1 < n1; ++i1) {", SAME_LAW),
    "nothing at borders": ("return 1;\n    }\n    *k = ", "return 0;\n    }\n    *k = ", EMPTY_LAW),
    "a copy": (NEAR, f"const int n = {CALL};\n    q[1][0] = q[0][0];\n    q[1][1] = q[0][1];\n    return n;", COPY_LAW),
    "a turn too many": ("q[count][0] = theta1;", "q[count][0] = theta1 + 6.2831855f;", RANGE_LAW),
    "anything is reached": (NEAR, f"const int n = {CALL};\n    return n == 0 ? 1 : n;", FAR_LAW),
    "another batch": ("block->q[path][1][k] = theta2;", "block->q[path][1][k] = -theta2;", BATCH_LAW),
    "no reference refused": ("if (!(weights[i] >= 0.0f", "if (!(weights[i] >= -1.0f", "wrong parameters"),
    "no pose refused": ("<= 1e-3f", "<= 1.0f", "what is no pose is refused"),
    "a double": ("const float l2 = p->l2;", "const float l2 = p->l2 * 1.0;", "compiles without a warning"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults_are_seen(fault: str) -> None:
    old, new, law = FAULTS[fault]
    texts = sources("planar_rr")
    assert old in texts["planar_rr.c"]
    broken = {**texts, "planar_rr.c": texts["planar_rr.c"].replace(old, new)}
    found = failures("planar_rr", broken)
    assert any(each.startswith(law) for each in found), found


def test_the_command_writes_checks_and_remembers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "arm"
    assert main(["derive", "planar_rr", "--real", "float", "-o", str(folder), "--json", "--quiet"]) == 0
    assert json.loads(capsys.readouterr().out)["real"] == "float"
    report = json.loads((folder / "planar_rr.report.json").read_text(encoding="utf-8"))
    assert report["real"] == "float"
    assert (folder / "planar_rr.c").read_text(encoding="utf-8") == sources("planar_rr")["planar_rr.c"]
    assert main(["check", str(folder)]) == 0
    said = capsys.readouterr()
    assert "FK(IK(T)) = T for regular solutions (<= 2e-05): C in float" in " ".join(said.out.split())
    assert "would write today" not in said.err
    source = folder / "planar_rr.c"
    source.write_text(source.read_text(encoding="utf-8").replace("T[3] = ", "T[3] = 1e-4f + "), encoding="utf-8")
    assert main(["check", str(folder), "--quiet"]) == 1
    assert "it was changed after kinsym wrote it" in capsys.readouterr().err
    path = folder / "planar_rr.report.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"real": "float"', '"real": "half"'), encoding="utf-8")
    assert main(["check", str(folder)]) == 2
    assert "no type 'half' of numbers" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--real", "half"], "half"),
        (["--real", "float", "--target", "extension"], "extension have double precision alone"),
        (["--real", "float", "--target", "c", "--target", "cpp", "--target", "ikfast"], "cpp and ikfast"),
        (["--real", "float", "--target", "numpy"], "Add --target c"),
    ],
)
def test_what_float_is_not_for(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["derive", "planar_rr", *arguments, "-o", str(tmp_path / "x")]) == 2
    assert said in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "x").exists()


def test_from_python(tmp_path: Path) -> None:
    solution = ks.derive(ks.load("planar_rr"))
    assert solution.sources("c", real="float") == sources("planar_rr")
    written = solution.write(tmp_path / "x", ["c"], real="float")
    assert written.report.real == "float"
    with pytest.raises(UsageError, match=r"no type 'half' of numbers\. They are double, float"):
        solution.sources(real="half")
    assert solution.sources("c") == solution.sources("c", real="double") != sources("planar_rr")
