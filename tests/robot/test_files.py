"""Files and lines of text: the same robot from each way of writing it, and clear words for what is no table."""

from __future__ import annotations

import contextlib
import os
import time
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kinsym.errors import RobotError
from kinsym.robot import Convention, Task, from_inline, load, parse, to_toml
from kinsym.robot.dh_text import rows_from_csv
from kinsym.robot.expressions import symbol
from kinsym.robot.files import from_draft
from tests.robot.helpers import ARM, build, changed

TOML = """
name = "arm"
title = "An arm"
convention = "craig"
task = "position"
[[joints]]
alpha = 0
a = 0.25
d = "d1"
theta = "theta1"
limits = ["deg(-90)", 1.5]
[[joints]]
type = "P"
variable = "slide"
alpha = "pi/2"
a = "0"
d = "slide + 0.1"
theta = "0"
[[joints]]
type = "fixed"
alpha = "0"
a = "l3"
d = "0"
theta = "0"
[parameters]
l3 = 0.3
[base]
xyz = ["0", "0", "h"]
[tool]
rpy = [0, "pi/2", 0]
"""


def write(folder: Path, name: str, content: str | bytes) -> str:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return str(path)


def test_everything_in_a_file_arrives(tmp_path: Path) -> None:
    robot = load(write(tmp_path, "arm.toml", TOML))
    assert (robot.name, robot.title, robot.convention, robot.task) == (
        "arm",
        "An arm",
        Convention.CRAIG,
        Task.POSITION,
    )
    assert robot.variables == ("theta1", "slide")
    assert [joint.kind for joint in robot.joints] == ["R", "P", "fixed"]
    assert robot.joints[0].a == parse("1/4")
    assert robot.joints[0].limits is not None
    assert float(robot.joints[0].limits[1]) == 1.5
    assert {name: value and float(value) for name, value in robot.parameters.items()} == {
        "d1": None,
        "l3": 0.3,
        "h": None,
    }
    assert robot.base is not None
    assert robot.base[2][3] == symbol("h")
    # A pitch of 90 degrees turns x to -z and z to x.
    assert robot.tool == tuple(
        tuple(map(parse, row)) for row in ((0, 0, 1, 0), (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 0, 1))
    )


def test_rpy_turns_about_fixed_axes() -> None:
    robot = build(changed(ARM, "tool", to={"rpy": ["pi/2", "0", "pi/2"]}))
    assert robot.tool is not None
    # Rz(90) Rx(90): x goes to y, y to z, z to x.
    assert [row[:3] for row in robot.tool[:3]] == [(0, 0, 1), (1, 0, 0), (0, 1, 0)]


def test_csv_inline_and_toml_agree(tmp_path: Path) -> None:
    inline = from_inline("pi/2 0 d1 theta1; 0 a2 0 theta2-pi/2; 0 a3 d3+0.1 0;", convention="paul", name="arm")
    text = "alpha, a, d, theta\n# shoulder\npi/2,0,d1,theta1\n\n0,a2,0,theta2 - pi/2\n0,a3,d3 + 0.1,0\n"
    assert load(write(tmp_path, "arm.csv", text), convention="paul") == inline == build(ARM)


def test_csv_with_type_and_variable(tmp_path: Path) -> None:
    text = "theta,d,a,alpha,type,variable\nq1,0,a1,0,R,q1\n0,0,a2,0,fixed,\ntheta2,0,a3,0,,\n"
    robot = load(write(tmp_path, "x.csv", text), convention="craig", name="arm")
    assert robot.variables == ("q1", "theta2")
    assert [joint.kind for joint in robot.joints] == ["R", "fixed", "R"]


def test_a_wrist_counts_from_four() -> None:
    robot = from_inline("-pi/2 0 0 theta4; pi/2 0 0 theta5; 0 0 d6 theta6", convention="paul")
    assert robot.variables == ("theta4", "theta5", "theta6")


def test_d_beside_theta_is_a_parameter() -> None:
    robot = from_inline("0 a1 d1 theta1; 0 0 d2 0; 0 0 d3 theta3", convention="paul")
    assert robot.variables == ("theta1", "d2", "theta3")
    assert list(robot.parameters) == ["a1", "d1", "d3"]


def test_rounded_angles_are_made_exact_and_noted() -> None:
    robot = from_inline("1.5708 0 0 theta1; -1.5707963267948966 a2 0 theta2+0.7854", convention="paul")
    assert robot.joints[0].alpha == parse("pi/2")
    assert robot.joints[1].alpha == parse("-pi/2")
    assert robot.joints[1].theta == parse("theta2 + pi/4")
    assert robot.notes[:2] == (
        "row 1, alpha: 1.5708 is read as pi/2 (off by 3.7e-06).",
        "row 2, theta: 0.7854 is read as pi/4 (off by 1.8e-06).",
    )
    assert robot.notes[2].startswith("3 numbers read as special values")


def test_other_angles_stay_as_they_are() -> None:
    robot = from_inline("1.5709 1.5708 0 theta1; 0.3 0 1.5708 theta2", convention="paul")
    assert robot.joints[0].alpha == parse("1.5709")
    assert robot.joints[0].a == robot.joints[1].d == parse("1.5708")
    assert robot.notes == ()


def test_slips_are_noted() -> None:
    robot = from_inline("90 0 pi theta1; 1.57 1 0 theta2", convention="paul")
    notes = robot.notes
    assert robot.joints[1].alpha == parse("1.57")
    assert [note.split(":")[0] for note in notes] == ["row 1, alpha", "row 1, d", "row 2, alpha"]
    assert "deg(90)" in notes[0]


@pytest.mark.parametrize(
    ("name", "content", "where", "what"),
    [
        ("no.toml", None, "", "no such file"),
        ("binary.toml", b"name\0", "", "binary"),
        ("latin.toml", b'name = "a"\ntitle = "\xe9"\n', ", line 2", "not UTF-8"),
        ("large.toml", b"#" * ((1 << 20) + 1), "", "larger than 1 MiB"),
        ("syntax.toml", 'name = "a"\nconvention = paul\n', ", line 2, column 14", "not TOML"),
        ("twice.toml", 'name = "a"\nname = "b"\n', ", line 2, column 11", "not TOML"),
        ("deep.toml", "a = " + "[" * 5000, "", "nested too deeply"),
        ("digits.toml", "a = " + "9" * 5000, "", "not TOML"),
        ("empty.toml", "", "", "name is missing"),
        ("empty.csv", "", "", "empty"),
        ("header.csv", "alpha,a,d,thta\n", ", header", "unknown key 'thta'"),
        ("lack.csv", "alpha,a,d\n", ", header", "theta is missing"),
        ("again.csv", "alpha,a,d,theta,a\n", ", header", "a occurs twice"),
        ("rows.csv", "alpha,a,d,theta\n", ", joints", "no rows"),
        ("few.csv", "alpha,a,d,theta\n0,1\n", ", joints row 1, d", "cell is missing"),
        ("many.csv", "alpha,a,d,theta\n0,1,0,theta1,5\n", ", joints row 1", "5 cells for 4 columns"),
        ("quote.csv", 'alpha,a,d,theta\n"0,1,0,theta1\n', "", "not CSV"),
    ],
)
def test_files_that_are_no_table(tmp_path: Path, name: str, content: str | bytes | None, where: str, what: str) -> None:
    path = str(tmp_path / name) if content is None else write(tmp_path, name, content)
    with pytest.raises(RobotError) as caught:
        load(path, convention="paul" if name.endswith("csv") else None)
    assert caught.value.where == path + where
    assert what in caught.value.what
    assert caught.value.remedy


def test_neither_folder_nor_pipe_is_opened(tmp_path: Path) -> None:
    (tmp_path / "folder.toml").mkdir()
    os.mkfifo(tmp_path / "pipe.toml")
    for name in ("folder.toml", "pipe.toml"):
        with pytest.raises(RobotError, match="not a regular file"):
            load(str(tmp_path / name))


def test_unreadable_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Taking the permission away does not stop root, so the refusal of the system is played.
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    path = write(tmp_path, "arm.toml", TOML)
    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(RobotError, match=r"cannot be read \(Permission denied\)"):
        load(path)


def test_csv_whose_file_name_is_no_name(tmp_path: Path) -> None:
    path = write(tmp_path, "my arm.csv", "alpha,a,d,theta\n0,1,0,theta1\n")
    with pytest.raises(RobotError, match=r"'my arm' is not a plain name.*with --name"):
        load(path, convention="paul")
    assert load(path, convention="paul", name="arm").name == "arm"


def test_a_path_cannot_break_the_message(tmp_path: Path) -> None:
    with pytest.raises(RobotError) as caught:
        load(str(tmp_path / "a\nb\x1b.toml"))
    assert str(caught.value).isprintable()


def test_path_that_is_too_long() -> None:
    with pytest.raises(RobotError, match="cannot be read"):
        load("a" * 5000 + ".toml")


@pytest.mark.parametrize(
    ("source", "remedy"), [("puma", "Did you mean puma560?"), ("stanford", "Did you mean stanford_arm?")]
)
def test_unknown_gallery_name(source: str, remedy: str) -> None:
    with pytest.raises(RobotError) as caught:
        load(source)
    assert remedy in caught.value.remedy


def test_other_suffix() -> None:
    with pytest.raises(RobotError, match=r"ends in \.toml, \.csv or \.urdf"):
        load("arm.yaml")


def test_convention_of_option_and_file(tmp_path: Path) -> None:
    path = write(tmp_path, "arm.toml", TOML)
    assert load(path, convention="craig", name="other").name == "other"
    with pytest.raises(RobotError, match="the file says 'craig' and the option 'paul'"):
        load(path, convention="paul")
    for convention, words in ((None, "convention of the table is missing"), ("screw", "needs a TOML file")):
        with pytest.raises(RobotError, match=words):
            from_inline("0 0 0 theta1", convention=convention)


@pytest.mark.parametrize(
    ("text", "where"),
    [("0 0 theta1", "--dh, joints row 1"), ("0 0 0 theta1; 0 a2 0 theta2 - pi/2", "--dh, joints row 2")],
)
def test_inline_rows_have_four_cells(text: str, where: str) -> None:
    with pytest.raises(RobotError) as caught:
        from_inline(text, convention="paul")
    assert caught.value.where == where


def test_empty_inline_table() -> None:
    with pytest.raises(RobotError, match="the table has no rows"):
        from_inline("  ", convention="paul")


@settings(max_examples=150, deadline=None)
@given(st.text(max_size=60))
def test_random_text_is_a_robot_or_refused(text: str) -> None:
    with contextlib.suppress(RobotError):
        from_inline(text, convention="paul")
    with contextlib.suppress(RobotError):
        rows_from_csv(text, where="x.csv")


def test_a_byte_order_mark_is_no_key(tmp_path: Path) -> None:
    assert load(write(tmp_path, "arm.toml", "\ufeff" + TOML)).name == "arm"


RPY = [
    ["deg(3)", 0, 0],
    ["deg(15)", "deg(30)", "deg(45)"],
    ["deg(3)", "deg(15)", 0],
    ["deg(10)", "deg(20)", "deg(30)"],
    ["deg(7.5)", "deg(22.5)", "deg(36)"],
    [0.1, 0.2, 0.3],
    [1.5708, "-pi", 0],
]


@pytest.mark.parametrize("rpy", RPY, ids=str)
def test_a_turned_tool_is_read_back(rpy: list[object]) -> None:
    robot = build(changed(ARM, "tool", to={"rpy": rpy}))
    assert build(tomllib.loads(to_toml(robot))).tool == robot.tool


def test_angles_of_too_many_roots() -> None:
    start = time.process_time()
    with pytest.raises(RobotError, match=r"\[tool\] rpy: the sines and cosines of these angles have too many roots"):
        build(changed(ARM, "tool", to={"rpy": ["deg(1.5)"] * 3}))
    assert time.process_time() - start < 3


def test_a_bound_angle_is_made_exact_as_well() -> None:
    rows = [{"alpha": "beta", "a": "1", "d": "0", "theta": "theta1"}]
    draft = {"name": "arm", "convention": "paul", "joints": rows}
    robot = from_draft(draft, where="arm.toml", bindings={"beta": Fraction("1.5708")})
    assert robot.joints[0].alpha == parse("pi/2")
    assert build(tomllib.loads(to_toml(robot))).joints == robot.joints


def test_reading_back_what_was_written() -> None:
    draft = changed(ARM, "tool", to={"xyz": ["0.1", 0, "h"], "rpy": ["deg(20)", 0, "0.3"]})
    draft = changed(draft, "joints", 0, "limits", to=["deg(-170)", 2.5])
    robot = build(changed(draft, "parameters", to={"a2": "1/3", "h": 0.25}))
    assert build(tomllib.loads(to_toml(robot))) == robot
