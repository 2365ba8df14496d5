"""The gallery's list, what programs read, and the nearest name of everything that can be mistyped."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from kinsym.cli import COMMANDS, main
from kinsym.command.parsing import parser_of
from kinsym.facts import facts
from kinsym.kinematics.arm_class import arm_class
from kinsym.kinematics.chain import chain_to_solve
from kinsym.robot import gallery, gallery_index
from tests.arms import derivation, robot

#: The keys of ``kinsym derive --json``, which ``docs/terminal.md`` promises.
KEYS = """status kinsym robot title class joints convention task table closed_form solutions branches figures operations
singular_poses checked checks files""".split()
DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "terminal.md"

CLASSES = {
    "planar_rpr": "planar",
    "cylindrical_rpp": "cylindrical",
    "scara": "SCARA",
    "gudel_fp1": "gantry",
    "spherical_wrist": "spherical wrist",
    "stanford_paul": "spherical wrist",
    "pieper_first": "spherical shoulder",
    "meeting_234": "axes 2, 3, 4 meet",
    "ur5": "three parallel axes",
    "slides_between": "three slides",
    "elbow_rrr": "two parallel axes",
    "spherical_rrp": "two axes that meet",
    "general_3r": "general 3R",
    "kuka_iiwa": "spherical wrist",
}


@pytest.mark.parametrize("name", CLASSES)
def test_classes(name: str) -> None:
    """By the axes that meet or are parallel in every posture; locked joints are constants."""
    assert arm_class(chain_to_solve(robot(name))) == CLASSES[name]


@pytest.mark.parametrize("name", ["puma560", "kuka_iiwa", "scara"])
def test_the_index_is_derived(name: str) -> None:
    """Three of it; ``test_generated.py`` holds every robot."""
    assert gallery_index()[name] == facts(derivation(name))


class Run:
    """A call with --json: its status, its object, its standard error."""

    def __init__(self, capsys: pytest.CaptureFixture[str], *words: str) -> None:
        self.status = main([*words, "--json"])
        out, self.err = capsys.readouterr()
        self.content: dict[str, Any] = json.loads(out)


def test_robots(capsys: pytest.CaptureFixture[str]) -> None:
    """All, or those that have every word in their name, title, class or convention; 80 columns are enough."""
    assert main(["robots"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(gallery())
    assert max(map(len, lines)) <= 80
    assert "kuka_iiwa           RRRRRRR  spherical wrist, theta3 locked     paul   8" in lines
    assert "ufactory_xarm6      RRRRRR   general 6R                         screw  16 ~" in lines
    assert main(["robots", "UNIVERSAL", "paul"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()[1:]] == ["ur10e", "ur3", "ur5", "ur5e"]
    assert main(["robots", "pumma"]) == 2
    assert "no robot of the gallery has 'pumma'. Did you mean puma560?" in capsys.readouterr().err
    found = Run(capsys, "robots", "scorbot").content
    assert [entry["name"] for entry in found["robots"]] == ["scorbot_5r"]
    assert found["robots"][0]["solutions"] == 4


def test_derive_gives_one_object(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With every key that is promised, in that order, and nothing beside it."""
    monkeypatch.chdir(tmp_path)
    run = Run(capsys, "derive", "planar_rr", "--no-check", "--quiet")
    assert run.status == run.content["status"] == 0
    assert run.err == ""
    assert list(run.content) == KEYS
    assert run.content["class"] == "planar"
    assert [joint["variable"] for joint in run.content["table"]["joints"]] == ["theta1", "theta2"]
    assert run.content["table"]["parameters"] == {"l1": None, "l2": None}
    assert (run.content["solutions"], len(run.content["branches"])) == (2, 2)
    assert run.content["singular_poses"]["conditions"]
    assert run.content["operations"]["forward"]["sincos"] == 2
    assert run.content["checked"] == "not run"
    assert all(Path(path).is_file() for path in run.content["files"])
    assert len(run.content["files"]) == 5


def test_the_keys_are_documented() -> None:
    """Each of them, and those that only some robots have."""
    text = DOCUMENT.read_text(encoding="utf-8")
    assert all(f"`{key}`" in text for key in (*KEYS, "deviation", "nominal_arm", "error"))


@pytest.mark.parametrize(
    ("words", "status", "kind", "message"),
    [
        (["derive", "planar_r"], 2, "RobotError", "planar_rr"),
        (["derive", "--taget"], 2, "UsageError", "--target"),
        (["derive", "planar_rr", "-o", __file__], 2, "OutputError", "is a file"),
        (["derive", "franka_panda", "--lock", "theat7"], 2, "RobotError", "theta7"),
        (["dervie", "ur5"], 2, "KinsymError", "derive"),
    ],
)
def test_errors_are_objects_too(
    words: list[str], status: int, kind: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """On standard output, with the message that a person reads on standard error."""
    run = Run(capsys, *words)
    assert run.status == run.content["status"] == status
    assert run.content["error"]["kind"] == kind
    assert message in run.content["error"]["message"]
    assert f"kinsym: {run.content['error']['message']}" in run.err


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        ("derive ur5 --taget numpy", "--target"),
        ("derive ur5 --taget=numpy", "--target"),
        ("derive ur5 --target nmupy", "numpy"),
        ("derive ur5 --task positon", "position"),
        ("derive ur55", "ur5"),
        ("show ur5 --method peiper", "pieper"),
        ("show puma560 --bind a22=1", "a2"),
        ("robts", "robots"),
        ("explian ur5", "explain"),
    ],
)
def test_the_nearest_name(words: str, hint: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a command, an option, its value, a robot, a parameter."""
    assert main(words.split()) == 2
    assert f"Did you mean {hint}?" in capsys.readouterr().err


def test_the_nearest_file(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Of those beside it that are of the same kind; none where the folder is missing."""
    for name in ("my_arm.toml", "my_amr.csv"):
        (tmp_path / name).touch()
    assert main(["show", str(tmp_path / "my_amr.toml")]) == 2
    assert "there is no such file. Did you mean my_arm.toml? Check the path." in capsys.readouterr().err
    assert main(["show", str(tmp_path / "nowhere" / "my_amr.toml")]) == 2
    assert "there is no such file. Check the path." in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("check x y", "'y' is not expected of kinsym check"),
        ("derive ur5 -z", "'-z' is not an option of kinsym derive"),
        ("derive ur5 --target", "expected one argument"),
        ("derive ur5 --deadline soon", "'soon'"),
        ("check", "DIR"),
    ],
)
def test_words_that_are_not_understood(words: str, told: str, capsys: pytest.CaptureFixture[str]) -> None:
    """One line that says which, and where the help is."""
    assert main(words.split()) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.endswith(" --help.\n")
    assert err.count("\n") == 1


@pytest.mark.parametrize("name", [None, *COMMANDS])
def test_help_fits_80_columns(
    name: str | None, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the program and of each command, and no two options of a command are the same."""
    monkeypatch.setenv("COLUMNS", "80")
    assert main([name, "--help"] if name else ["--help"]) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 80
    if name:
        options = parser_of(name, COMMANDS[name]).options()
        assert len(set(options)) == len(options)


@pytest.mark.parametrize("words", [["show", "abb_irb120", "--full"], ["show", "raven_2"], ["show", "ur5"]])
def test_output_fits_80_columns(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """Where there is no terminal; home poses and long equations were wider."""
    assert main(words) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 80
