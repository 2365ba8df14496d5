"""The command line on URDF files, from the file to checked sources."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from xml.sax.saxutils import escape

import pytest

from kinsym.cli import main
from kinsym.robot import load
from tests.urdf.trees import J, panda, planar, ur5, urdf, write


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("few_poses")
def test_derive_a_ur5_with_rounded_numbers(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Eight solutions, all checks pass, and terminal and report say what was read otherwise; so does a later check."""
    write(here, ur5("1.5708"))
    assert main(["derive", "arm.urdf", "--tip-link", "ee_link", "-o", "out"]) == 0
    printed = capsys.readouterr().out
    assert "joint shoulder_lift, rpy: 1.5708 is read as pi/2 (off by 3.7e-06)." in printed
    assert "at most 8 solutions" in printed
    path = here / "out" / "ur5_CB.report.json"
    report = json.loads(path.read_text())
    assert report["checked"] == "passed"
    assert report["most_solutions"] == 8
    assert report["deviation"]["changes"][0] == {
        "where": "joint shoulder_lift, rpy",
        "written": "1.5708",
        "read_as": "pi/2",
        "difference": "3.7e-06",
    }
    assert 1e-6 < float(report["deviation"]["position"]) < 1e-5
    assert main(["check", "out", "--quiet"]) == 0
    assert json.loads(path.read_text()) == report


@pytest.mark.usefixtures("few_poses")
def test_check_takes_the_table_as_it_is(here: Path) -> None:
    """A table derived with --exact holds numbers that a second reading would make special."""
    rows = "0 0.4 0 theta1+1.5708; 0 0.3 0 theta2"
    assert main(["derive", "--dh", rows, "--convention", "paul", "--name", "exact", "--exact", "--quiet"]) == 0
    report = (here / "exact" / "exact.report.json").read_text()
    assert "1.5708" in report
    assert main(["check", "exact", "--quiet"]) == 0
    assert (here / "exact" / "exact.report.json").read_text() == report


def test_exact_and_snap_on_a_table(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same two options decide for tables and for URDF."""
    rows = ["show", "--dh", "1.57 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3", "--convention", "paul"]
    assert main([*rows, "--snap", "1e-3"]) == 0
    assert "row 1, alpha: 1.57 is read as pi/2 (off by 8.0e-04)." in capsys.readouterr().out
    assert main([*rows, "--exact"]) == 0
    assert "row 1, alpha: 1.57 is near pi/2 but not equal; write pi/2 if that is meant." in capsys.readouterr().out
    for wrong in ("0", "-1", "0.5", "a lot"):
        assert main([*rows, "--snap", wrong]) == 2
        assert "--snap" in capsys.readouterr().err
    assert main([*rows, "--snap", "1e-3", "--exact"]) == 2


@pytest.mark.usefixtures("few_poses")
def test_planar_arm_from_urdf(here: Path) -> None:
    write(here, planar())
    assert main(["derive", "arm.urdf", "--quiet"]) == 0
    report = json.loads((here / "planar" / "planar.report.json").read_text())
    assert report["checked"] == "passed"
    assert report["task"] == "planar"
    assert report["deviation"] == {"position": "0.0e+00", "rotation": "0.0e+00", "changes": []}


def test_import_writes_a_robot_file(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The head tells source, joints and deviation; the file is read back as the same robot."""
    write(here, ur5("1.5708"))
    assert main(["import", "arm.urdf", "--base-link", "base_link", "--tip-link", "ee_link", "--name", "mine"]) == 0
    text = (here / "mine.toml").read_text()
    head = [line for line in text.splitlines() if line.startswith("#")]
    assert head[0].endswith("from arm.urdf, base_link to ee_link")
    assert head[1] == "# theta1 is the joint shoulder_pan."
    assert "# joint flange, rpy: 1.5708 is read as pi/2 (off by 3.7e-06)." in head
    assert head[-1].startswith("# 3 numbers read as special values; the forward kinematics differs")
    assert tomllib.loads(text)["name"] == "mine"
    again, direct = load("mine.toml"), load("arm.urdf", base_link="base_link", tip_link="ee_link", name="mine")
    assert again.joints == direct.joints
    assert again.parameters == direct.parameters
    assert head[-1][2:] in " ".join(capsys.readouterr().out.split())


def test_import_replaces_only_what_it_is_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(here, planar())
    Path("planar.toml").write_text("mine")
    assert main(["import", "arm.urdf"]) == 2
    assert "planar.toml is there already" in capsys.readouterr().err
    assert Path("planar.toml").read_text() == "mine"
    assert main(["import", "arm.urdf", "-o", "planar.toml", "--quiet"]) == 0
    assert load("planar.toml").name == "planar"
    assert capsys.readouterr().out == ""


@pytest.mark.usefixtures("few_poses")
def test_names_of_links_and_joints_are_only_text(here: Path) -> None:
    """Quotes, comment signs and line ends in names change neither the robot file nor the sources."""
    odd = escape('% $ # { \\ */ """ ?>\u2028', {'"': "&quot;", "\u2028": "&#10;name = 1"})
    write(here, urdf(J(f"j{odd}", "continuous", "a", f"b{odd}", rpy="1e-8 0 0"), name=odd))
    assert main(["import", "arm.urdf", "-o", "odd.toml"]) == 0
    head, _, rest = Path("odd.toml").read_text(encoding="utf-8").partition('name = "')
    assert all(line.startswith("# ") for line in head.splitlines())
    assert rest.startswith("name_1_arm") or rest.startswith("name_1")
    assert main(["derive", "odd.toml", "--name", "odd", "--quiet"]) == 0


MISUSE: dict[str, tuple[list[str], str]] = {
    "no file": (["show", "none.urdf"], "none.urdf: there is no such file"),
    "import of a table": (["import", "ur5"], "'ur5' is no .urdf file"),
    "several leaves": (["derive", "arm.urdf"], "--tip-link: leftfinger, rightfinger"),
    "several leaves, import": (["import", "arm.urdf"], "--tip-link: leftfinger, rightfinger"),
    "misspelled": (["show", "arm.urdf", "--tip-link", "panda_link9"], "Did you mean panda_link"),
    "links of a table": (["show", "ur5", "--tip-link", "tool0"], "only a URDF file has links"),
    "links of rows": (["show", "--dh", "0 1 0 theta1", "--base-link", "x"], "--dh has no links"),
    "convention": (["show", "arm.urdf", "--convention", "paul"], "a URDF file has no convention"),
    "no command": (["arm.urdf"], "Did you mean: kinsym derive arm.urdf?"),
    "xacro": (["show", "arm.urdf.xacro"], "xacro FILE > robot.urdf"),
}


@pytest.mark.parametrize(("words", "message"), MISUSE.values(), ids=MISUSE)
def test_misuse(here: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str) -> None:
    write(here, panda())
    assert main(words) == 2
    assert message in capsys.readouterr().err
