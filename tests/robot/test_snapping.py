"""One policy says which numbers are read as special values, in tables as in URDF, and every change is told."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import pi, sqrt

from kinsym.deriving import derive
from kinsym.errors import RobotError
from kinsym.robot import from_inline, load, parse
from kinsym.robot.geometry.arm import arm_of
from kinsym.robot.model import Robot
from kinsym.robot.snapping import EXACT, ROUNDING, Snapping, snapping_of
from tests.robot.helpers import ARM, SCREWS, build, changed


def paul(rows: str, snapping: Snapping = ROUNDING) -> Robot:
    return from_inline(rows, convention="paul", snapping=snapping)


# (written, read by default); the first five agree with the multiple to all of their places, four or more.
ANGLES = [
    ("1.5708", pi / 2),
    ("-3.1416", -pi),
    ("0.2618", pi / 12),
    ("1.570796", pi / 2),
    ("4.7123", 3 * pi / 2),
    ("1.5707969", pi / 2),
    ("1.5707960", pi / 2),
    ("theta2 + 0.0000004", parse("theta2")),
    ("pi/2 - 0.0000002", pi / 2),
    ("1.571", None),
    ("1.57", None),
    ("1.5709", None),
    ("1.57079", pi / 2),
    ("1.57090", None),
    ("0.000002", None),
    ("0.3", None),
    ("1", None),
    ("100.5310", None),
    ("1/3", None),
]


@pytest.mark.parametrize(("written", "read"), ANGLES)
def test_angles(written: str, read: object) -> None:
    cell = parse(written)
    assert ROUNDING.angle(cell, where="")[0] == (cell if read is None else read)
    assert EXACT.angle(cell, where="") == (cell, None)


def test_a_tolerance_replaces_both_rules() -> None:
    """--snap 1e-7 does not read 1.5708 as pi/2, --snap 1e-3 reads 1.57 so."""
    assert snapping_of("1e-7").angle(parse("1.5708"), where="")[1] is None
    assert snapping_of("1e-3").angle(parse("1.57"), where="")[0] == pi / 2


@pytest.mark.parametrize("text", ["0", "-1e-6", "0.11", "nan", "", "x", "1e-6 rad"])
def test_a_tolerance_that_is_none(text: str) -> None:
    with pytest.raises(RobotError, match="--snap"):
        snapping_of(text)


NOISY = (
    "1.570796 1e-9 0.089159 theta1; 1e-7 -0.425 0 theta2; 0 -0.39225 -2e-10 theta3-3e-8; "
    "1.5707961 0 0.10915 theta4; -1.5707962 3e-8 0.09465 theta5; 0 0 0.0823 theta6"
)


def test_lengths_next_to_zero_and_angles_next_to_special_ones() -> None:
    """A UR5 with the noise of a program: the closed form of the clean table, and how far T is off."""
    robot = paul(NOISY)
    assert [str(joint.a) for joint in robot.joints] == ["0", "-17/40", "-1569/4000", "0", "0", "0"]
    assert robot.joints[2].d == 0
    assert robot.joints[2].theta == parse("theta3")
    assert derive(robot).plan.maximum == 8
    assert robot.deviation is not None
    assert [change.where for change in robot.deviation.changes] == [
        *("row 1, a", "row 1, alpha", "row 2, alpha", "row 3, d", "row 3, theta"),
        *("row 4, alpha", "row 5, a", "row 5, alpha"),
    ]
    exact = paul(NOISY, EXACT)
    assert exact.deviation is None
    zero = [0] * 6
    a, b = arm_of(exact).pose(zero), arm_of(robot).pose(zero)
    moved = float(sum((p - q) ** 2 for p, q in zip(a.origin, b.origin, strict=True)) ** 0.5)
    assert 1e-9 < moved <= robot.deviation.position < 1e-6


def test_size_decides_what_a_small_length_is() -> None:
    """In millimetres 5e-4 is half a micrometre and nothing in an arm of 800 mm; in an arm of 5 mm it is a length."""
    assert paul("pi/2 0.0005 0 theta1; 0 800 0 theta2").joints[0].a == 0
    assert paul("pi/2 0.0005 0 theta1; 0 5 0 theta2").joints[0].a == parse("0.0005")
    assert paul("pi/2 1e-9 0 theta1; 0 a2 0 theta2").joints[0].a == parse("1e-9")


def test_a_parameter_next_to_zero_is_folded() -> None:
    draft = changed(ARM, "parameters", to={"d1": "1e-9", "a2": 0.4, "a3": 0.3})
    robot = build(draft)
    assert list(robot.parameters) == ["a2", "a3"]
    assert robot.notes[0] == "parameter d1: 0.000000001 is read as 0 (off by 1.0e-09)." or robot.deviation is not None
    assert "d1" in build(changed(draft, "parameters", "d1", to="1e-3")).parameters


def test_points_of_screws_and_turned_tools() -> None:
    robot = build(changed(SCREWS, "joints", 0, "s0", to=["0", "1e-9", "2"]))
    assert robot.joints[0].s0 == (0, 0, 2)
    tool = changed(ARM, "tool", to={"rpy": ["1.5708", 0, 0]})
    robot = build(tool)
    assert robot.tool is not None
    assert robot.tool[1][:3] == (0, 0, -1)
    assert robot.deviation is not None
    assert robot.deviation.rotation == pytest.approx(3.673205e-6, rel=1e-6)
    assert robot.notes[0] == "[tool] rpy: 1.5708 is read as pi/2 (off by 3.7e-06)."


def test_vectors_of_rounded_cosines() -> None:
    """0.7071 is the cosine of 45 degrees, 0.99999 is 1; what T is off by is measured from the vector as written."""
    robot = build(changed(SCREWS, "joints", 0, "s", to=["0.70711", "0", "-0.70711"]))
    assert robot.joints[0].s == (sqrt(2) / 2, 0, -sqrt(2) / 2)
    assert robot.notes[0] == ("row 1, s: 0.70711, 0, -0.70711 is read as sqrt(2)/2, 0, -sqrt(2)/2 (off by 3.2e-06).")
    robot = build(changed(SCREWS, "home", "u0", to=["0.99999", "0", "0"]))
    assert robot.home is not None
    assert robot.home.u0 == (1, 0, 0)
    askew = changed(SCREWS, "joints", 0, "s", to=["0.0000003", "0", "1"])
    robot = build(askew)
    assert robot.joints[0].s == (0, 0, 1)
    assert robot.deviation is not None
    assert robot.deviation.rotation == pytest.approx(6e-7, rel=0.1)


def test_a_matrix_of_rounded_cosines() -> None:
    matrix = [["0.86603", "-0.5", 0, "0.1"], ["0.5", "0.86603", 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    robot = build(changed(ARM, "tool", to={"matrix": [["0.8660254", "-0.5", 0, "0.1"], *matrix[1:]]}))
    assert robot.tool is not None
    assert robot.tool[1][1] == sqrt(3) / 2
    assert [change.where for change in robot.deviation.changes] == ["[tool] matrix"] * 2  # type: ignore[union-attr]
    with pytest.raises(RobotError, match="not orthonormal"):
        build(changed(ARM, "tool", to={"matrix": [["0.87", "-0.5", 0, "0.1"], *matrix[1:]]}))


def test_other_vectors_are_refused_as_before() -> None:
    for vector in (["0.707", "0.707", "0"], ["0.7071", "0.7171", "0"], ["0.6001", "0.8001", "0"]):
        with pytest.raises(RobotError, match="not a unit vector"):
            build(changed(SCREWS, "joints", 0, "s", to=vector))
    assert build(SCREWS).deviation is None


def test_the_gallery_is_read_as_it_is_written() -> None:
    for name in ("ur5", "puma560", "stanford_screw"):
        assert load(name).deviation is None
        assert load(name) == load(name, snapping=EXACT)


def test_values_of_parameters_count_in_the_deviation() -> None:
    """The same slip of a twist is carried farther by a longer arm."""
    draft = changed(ARM, "joints", 0, "alpha", to="1.5708")
    short, long = (build(changed(draft, "parameters", to={"a2": size, "a3": size})) for size in (1, 10))
    assert short.deviation is not None
    assert long.deviation is not None
    assert long.deviation.position > 4 * short.deviation.position
    assert long.deviation.rotation == pytest.approx(short.deviation.rotation)
    assert [change.difference for change in long.deviation.changes] == [pytest.approx(3.673205e-6, rel=1e-6)]
    assert long.deviation.changes[0].where == "row 1, alpha"
    assert Fraction(long.deviation.changes[0].written) == Fraction("1.5708")
