"""Every mistake in a table is one message: what is wrong, where, how to mend it; exit status 2."""

from __future__ import annotations

import pytest

from kinsym.errors import RobotError
from tests.robot.helpers import ARM, SCREWS, Draft, build, changed

# (what is changed, place in the message, words of the fault, words of the remedy)
Case = tuple[Draft, str, str, str]


def arm(*path: str | int, to: object = None, drop: bool = False) -> Draft:
    return changed(ARM, *path, to=to, drop=drop)


def screws(*path: str | int, to: object = None, drop: bool = False) -> Draft:
    return changed(SCREWS, *path, to=to, drop=drop)


CASES: dict[str, Case] = {
    "unknown key": (arm("titel", to="x"), "arm.toml", "unknown key 'titel'", "Did you mean title?"),
    "unknown key in a row": (
        arm("joints", 1, "alhpa", to="0"),
        "arm.toml, joints row 2",
        "unknown key 'alhpa'",
        "Did you mean alpha?",
    ),
    "unknown key in home": (screws("home", "w1", to=[0, 0, 1]), "arm.toml, [home]", "'w1'", "Did you mean w0?"),
    "unknown key in tool": (arm("tool", to={"xzy": [0, 0, 0]}), "arm.toml, [tool]", "'xzy'", "Did you mean xyz?"),
    "home of a DH table": (arm("home", to={}), "arm.toml, [home]", "no home frame", "[tool]"),
    "missing key": (arm("convention", drop=True), "arm.toml", "convention is missing", 'convention = "paul"'),
    "missing cell": (
        arm("joints", 2, "a", drop=True),
        "arm.toml, joints row 3, a",
        "the cell is missing",
        'Write "0"',
    ),
    "empty cell": (arm("joints", 2, "a", to=""), "arm.toml, joints row 3, a", "the cell is missing", 'Write "0"'),
    "blank cell": (arm("joints", 2, "a", to=" "), "arm.toml, joints row 3, a", "the cell is empty", 'Write "0"'),
    "missing screw point": (
        screws("joints", 0, "s0", drop=True),
        "arm.toml, joints row 1, s0",
        "the cell is missing",
        "Write",
    ),
    "wrong convention": (
        arm("convention", to="Pual"),
        "arm.toml, convention",
        "unknown convention 'Pual'",
        "Did you mean paul? The conventions are paul, craig, screw.",
    ),
    "wrong task": (arm("task", to="positon"), "arm.toml, task", "unknown task 'positon'", "Did you mean position?"),
    "wrong type": (arm("joints", 0, "type", to="r"), "arm.toml, joints row 1, type", "joint type 'r'", '"R"'),
    "screw without type": (
        screws("joints", 0, "type", drop=True),
        "arm.toml, joints row 1, type",
        "type of the joint is missing",
        'type = "R"',
    ),
    "column of another convention": (
        arm("joints", 0, "s", to=[0, 0, 1]),
        "arm.toml, joints row 1",
        'the column s does not belong to the convention "paul"',
        "alpha, a, d, theta",
    ),
    "unused parameter": (
        arm("parameters", to={"a_2": 0.4}),
        "arm.toml, [parameters] a_2",
        "'a_2' has a value but is used nowhere",
        "Did you mean a2? The parameters of the table: d1, a2, a3.",
    ),
    "value of a joint variable": (
        arm("parameters", to={"theta1": 0.4}),
        "arm.toml, [parameters] theta1",
        "is a joint variable",
        "d1, a2, a3",
    ),
    "NaN parameter": (
        arm("parameters", to={"a2": float("nan")}),
        "arm.toml, [parameters] a2",
        "NaN and infinity are not numbers",
        "finite",
    ),
    "infinite parameter": (
        arm("parameters", to={"a2": "inf"}),
        "arm.toml, [parameters] a2",
        "NaN and infinity are not numbers",
        "finite",
    ),
    "parameter with a name as value": (
        arm("parameters", to={"a2": "2*a3"}),
        "arm.toml, [parameters] a2",
        "depends on a3",
        "Write a number",
    ),
    "call": (
        arm("joints", 0, "d", to="__import__('os').system('x')"),
        "arm.toml, joints row 1, d",
        "does not belong into a cell",
        "A cell is a number or an expression",
    ),
    "call of a name": (
        arm("joints", 0, "d", to="exec(1)"),
        "arm.toml, joints row 1, d",
        "the call of 'exec' is not allowed",
        "Only sqrt, sin, cos and deg",
    ),
    "attribute": (arm("joints", 0, "d", to="a.b"), "arm.toml, joints row 1, d", "'a.b' has a dot", "no parts"),
    "factor 2": (
        arm("joints", 1, "theta", to="2*theta2"),
        "arm.toml, joints row 2, theta",
        "theta2 enters with factor 2",
        "factor +1 or -1",
    ),
    "factor that is a name": (
        arm("joints", 2, "d", to="a3*d3"),
        "arm.toml, joints row 3, d",
        "d3 enters with factor a3",
        "factor +1 or -1",
    ),
    "squared variable": (
        arm("joints", 1, "theta", to="theta2**2"),
        "arm.toml, joints row 2, theta",
        "enters with factor 2*theta2",
        "factor +1 or -1",
    ),
    "variable in two cells of a row": (
        arm("joints", 1, "a", to="theta2"),
        "arm.toml, joints row 2, a",
        "theta2 stands in two cells, theta and a",
        "one cell only",
    ),
    "variable in two rows": (
        arm("joints", 2, "theta", to="theta1"),
        "arm.toml, joints row 3, theta",
        "theta1, the joint variable of row 1, stands here as well",
        "one cell only",
    ),
    "variable missing": (
        arm("joints", 1, "theta", to="pi/2"),
        "arm.toml, joints row 2, theta",
        "the joint variable theta2 is missing",
        'Write "theta2" in theta',
    ),
    "variable in the wrong column": (
        changed(arm("joints", 2, "theta", to="d3"), "joints", 2, "d", to="0"),
        "arm.toml, joints row 3, d",
        "d3 is missing here and stands in theta",
        'Write "d3" in d',
    ),
    "variable of no column": (
        changed(arm("joints", 1, "type", drop=True), "joints", 1, "variable", to="q2"),
        "arm.toml, joints row 2",
        "q2 is neither in theta nor in d",
        "variable",
    ),
    "variable named twice": (
        changed(arm("joints", 1, "variable", to="theta1"), "joints", 1, "theta", to="theta1"),
        "arm.toml, joints row 2",
        "theta1 is the variable of rows 1 and 2",
        "its own variable",
    ),
    "variable that is a sum": (
        arm("joints", 1, "theta", to="theta22"),
        "arm.toml, joints row 2, theta",
        "'theta22' cannot be a joint variable",
        "another name",
    ),
    "variable in the tool": (
        arm("tool", to={"xyz": ["d3", 0, 0]}),
        "arm.toml, [tool]",
        "d3 stands in a fixed transform",
        "do not move",
    ),
    "variable in a screw": (
        screws("joints", 1, "s0", to=["theta1", 0, 0]),
        "arm.toml, joints row 2, s0",
        "theta1, the joint variable of row 1",
        "one cell only",
    ),
    "variable in its own screw": (
        screws("joints", 1, "s0", to=["d2", 0, 0]),
        "arm.toml, joints row 2, s0",
        "d2 stands in the screw",
        "home pose",
    ),
    "singular home": (
        screws("home", "v0", to=[1, 0, 0]),
        "arm.toml, [home]",
        "the home frame is singular",
        "independent axes",
    ),
    "left-handed home": (
        screws("home", "w0", to=[0, 0, -1]),
        "arm.toml, [home]",
        "the home frame is left-handed",
        "Reverse one axis",
    ),
    "home off by rounding": (
        screws("home", "u0", to=["0.999", 0, 0]),
        "arm.toml, [home]",
        "not orthonormal",
        "exact numbers",
    ),
    "home lacks an axis": (screws("home", "w0", drop=True), "arm.toml, [home]", "lacks w0", "u0, v0, w0"),
    "symbolic home": (screws("home", "u0", to=["b", 0, 0]), "arm.toml, [home]", "depends on b", "numbers here"),
    "screw axis not unit": (
        screws("joints", 0, "s", to=["0.707", "0.707", 0]),
        "arm.toml, joints row 1, s",
        "not a unit vector: its length is 0.999848989",
        "sqrt(2)/2",
    ),
    "screw axis zero": (
        screws("joints", 0, "s", to=[0, 0, 0]),
        "arm.toml, joints row 1, s",
        "has no direction",
        "unit vector",
    ),
    "screw axis symbolic": (
        screws("joints", 0, "s", to=["b", 0, 1]),
        "arm.toml, joints row 1, s",
        "depends on b",
        "numbers here",
    ),
    "screw axis of two cells": (
        screws("joints", 0, "s", to=[0, 1]),
        "arm.toml, joints row 1, s",
        "three cells",
        "Write a list",
    ),
    "keyword as name": (arm("name", to="lambda"), "arm.toml, name", "'lambda' is a keyword of Python", "plain name"),
    "C keyword as name": (arm("name", to="double"), "arm.toml, name", "a fixed word of C", "plain name"),
    "path as name": (arm("name", to="../arm"), "arm.toml, name", "'../arm' is not a plain name", "plain name"),
    "module as name": (arm("name", to="random"), "arm.toml, name", "is a module", "plain name"),
    "header as name": (arm("name", to="stdio"), "arm.toml, name", "is a header of C", "plain name"),
    "device as name": (arm("name", to="NUL"), "arm.toml, name", "not a file name on every system", "plain name"),
    "number as name": (arm("name", to=7), "arm.toml, name", "name is not text", 'name = "..."'),
    "title of two lines": (arm("title", to="a\nb"), "arm.toml, title", "not one line", "Shorten"),
    "keyword as parameter": (
        arm("joints", 0, "a", to="int"),
        "arm.toml, joints row 1, a",
        "'int' is a keyword or a fixed word of C",
        "another name",
    ),
    "empty table": (arm("joints", to=[]), "arm.toml, joints", "the table has no rows", "one row for each joint"),
    "table of fixed rows": (
        arm("joints", to=[{"type": "fixed", "alpha": 0, "a": 1, "d": 0, "theta": 0}]),
        "arm.toml, joints",
        "no row has a joint variable",
        "add a joint",
    ),
    "joints that are no table": (arm("joints", to="x"), "arm.toml", "not an array of tables", "[[joints]]"),
    "limits reversed": (
        arm("joints", 0, "limits", to=[1, -1]),
        "arm.toml, joints row 1, limits",
        "not below the upper",
        "Exchange",
    ),
    "limits of a name": (
        arm("joints", 0, "limits", to=[0, "a2"]),
        "arm.toml, joints row 1, limits",
        "depends on a2",
        "Write a number",
    ),
    "true as cell": (arm("joints", 0, "a", to=True), "arm.toml, joints row 1, a", "true or false", "Write a number"),
    "list as cell": (arm("joints", 0, "a", to=[]), "arm.toml, joints row 1, a", "a list", "Write a number"),
    "tool not rigid": (
        arm("tool", to={"matrix": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}),
        "arm.toml, [tool] matrix",
        "not orthonormal",
        "exact numbers",
    ),
    "tool of a wrong last row": (
        arm("tool", to={"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}),
        "arm.toml, [tool] matrix",
        "last row is not 0 0 0 1",
        "rigid transform",
    ),
    "tool not 4x4": (arm("tool", to={"matrix": [[1]]}), "arm.toml, [tool] matrix", "not 4x4", "four rows"),
    "empty base": (arm("base", to={}), "arm.toml, [base]", "empty", "xyz and rpy"),
    "symbolic rpy": (
        arm("base", to={"rpy": ["b", 0, 0]}),
        "arm.toml, [base] rpy",
        "rpy depends on b",
        "numbers here",
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_refusal_says_what_where_and_how(case: Case) -> None:
    draft, where, what, remedy = case
    with pytest.raises(RobotError) as caught:
        build(draft)
    error = caught.value
    assert error.exit_status == 2
    assert error.where == where
    assert what in error.what
    assert remedy in error.remedy
    assert str(error) == f"{error.where}: {error.what}. {error.remedy}"
    assert error.remedy.endswith(".")
    assert not error.what.endswith(".")
    assert str(error).isprintable()


def test_the_unchanged_drafts_are_good() -> None:
    assert build(ARM).variables == ("theta1", "theta2", "d3")
    assert build(SCREWS).variables == ("theta1", "d2")


def test_ten_moving_joints_are_refused() -> None:
    rows = [{"alpha": "0", "a": "1", "d": "0", "theta": f"theta{i}"} for i in range(1, 11)]
    with pytest.raises(RobotError, match="the robot has 10 joints"):
        build({"name": "snake", "convention": "paul", "joints": rows})
