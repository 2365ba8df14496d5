"""Names: the lecture's are free to use, the ones that would clash in generated code are not."""

from __future__ import annotations

import pytest

from kinsym.errors import RobotError
from kinsym.robot.names import check_parameter, check_robot_name, check_variable, nearest

LECTURE = [
    "a1",
    "a2",
    "a10",
    "b",
    "d1",
    "d6",
    "g",
    "h",
    "l1",
    "l2",
    "alpha1",
    "alpha_1",
    "beta",
    "e",
    "offset",
    "x",
    "L1",
]
CLASHES = ["c1", "s23", "c12m4", "theta1", "theta234", "u_x", "p16_x", "p_z", "kappa1", "mu2", "nu1", "gamma3", "k_2"]
CLASHES += ["calpha1", "salpha2", "T", "q", "p", "R", "tau", "size", "pi", "sqrt", "sin", "cos", "atan2", "fabs", "NAN"]
CLASHES += ["if", "lambda", "match", "double", "restrict", "new", "float", "len", "_a", "a__b", "2a", "a-b", "", "a b"]
CLASHES += ["A1", "M_PI", "reference", "é", "a" * 41, "z1_x", "o2_y", "np", "A1\n"]
CLASHES += ["block", "path", "LANES", "half_turn", "larger", "lane_linear", "w_lanes", "a2_other"]


@pytest.mark.parametrize("name", LECTURE)
def test_usual_names_are_parameters(name: str) -> None:
    assert check_parameter(name, where="") == name


@pytest.mark.parametrize("name", CLASHES)
def test_clashing_names_are_refused_with_a_reason(name: str) -> None:
    with pytest.raises(RobotError) as caught:
        check_parameter(name, where="arm.toml, joints row 1, a")
    assert caught.value.where == "arm.toml, joints row 1, a"
    assert caught.value.remedy == "Choose another name, for example l2."


@pytest.mark.parametrize("name", ["theta1", "theta9", "d3", "q2", "slide", "phi"])
def test_variables(name: str) -> None:
    assert check_variable(name, where="") == name


@pytest.mark.parametrize("name", ["theta12", "c1", "T", "for", "kappa1", ""])
def test_refused_variables(name: str) -> None:
    with pytest.raises(RobotError):
        check_variable(name, where="")


@pytest.mark.parametrize("name", ["my_robot", "puma560", "UR5", "R2D2", "a" * 40])
def test_robot_names(name: str) -> None:
    assert check_robot_name(name, where="") == name


@pytest.mark.parametrize(
    "name",
    [
        "../x",
        "a/b",
        "a.b",
        ".",
        "",
        "class",
        "int",
        "std",
        "math",
        "numpy",
        "kinsym",
        "Con",
        "_x",
        "x" * 41,
        "a\n",
        "ö",
    ],
)
def test_refused_robot_names(name: str) -> None:
    with pytest.raises(RobotError, match="Choose a plain name such as my_robot"):
        check_robot_name(name, where="")


def test_nearest() -> None:
    assert nearest("apha", ["alpha", "a", "d"]) == "Did you mean alpha? "
    assert nearest("zzz", ["alpha", "a", "d"]) == ""
