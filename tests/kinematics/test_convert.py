"""One arm, three tables: conversions keep T, to the last coefficient."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Symbol

from kinsym.errors import RobotError
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.forward import forward_kinematics
from kinsym.robot import from_inline, gallery, load
from kinsym.robot.model import Convention, Robot
from tests.arms import SHAPES, robot

BENT = ("open_manipulator_x", "ufactory_xarm6", "viperx_300s", "widowx_200")
"""Their upper arms reach up and forwards: as a row that is the length sqrt(a2^2 + b2^2) at an odd angle."""

SKEW = "nao_left_leg"

ODD = ("kinova_jaco", "raven_2")
"""Angles of 52, 75, 100 and 128 degrees become other constants on the way, so that coefficients cannot be compared."""

CONVERTIBLE = [name for name in gallery() if name not in (*BENT, *ODD, SKEW)]

Terms = dict[frozenset[tuple[str, int]], Fraction]


def pose(arm: Robot) -> list[list[Terms]]:
    """T as plain dictionaries, so that tables with different rings can be compared."""
    chain = build_chain(arm)
    names = [generator.name for generator in chain.ring.generators]

    def terms(poly: object) -> Terms:
        return {
            frozenset((n, e) for n, e in zip(names, monomial, strict=True) if e): Fraction(
                int(coefficient.numerator), int(coefficient.denominator)
            )
            for monomial, coefficient in poly.terms()  # type: ignore[attr-defined]
        }

    return [[terms(entry) for entry in column] for column in forward_kinematics(chain).columns]


@pytest.mark.parametrize("convention", list(Convention))
@pytest.mark.parametrize("name", [*CONVERTIBLE, "reversed_axes", "cylindrical_wrist", "wrist_first", "three_slides"])
def test_conversion_keeps_the_pose_there_and_back(name: str, convention: Convention) -> None:
    arm = robot(name)
    there = convert(arm, convention)
    assert there.convention is convention
    assert there.variables == arm.variables
    assert pose(there) == pose(arm)
    assert pose(convert(there, arm.convention)) == pose(arm)


@pytest.mark.parametrize("name", [*BENT, SKEW])
def test_a_table_without_exact_cells_is_refused(name: str) -> None:
    with pytest.raises(RobotError, match="has no exact form as a cell of a Denavit-Hartenberg table"):
        convert(robot(name), Convention.PAUL)


def test_the_lectures_planar_arm_in_three_conventions() -> None:
    """Slides 17, 19 and 36; the Craig table calls its lengths l, the others a."""
    rename = {Symbol(f"l{i}", real=True): Symbol(f"a{i}", real=True) for i in (1, 2, 3)}
    craig = load("planar_rrr_craig")
    joints = tuple(
        type(joint)(
            kind=joint.kind,
            variable=joint.variable,
            alpha=joint.alpha,
            a=joint.a.subs(rename) if joint.a is not None else None,
            d=joint.d,
            theta=joint.theta,
        )
        for joint in craig.joints
    )
    renamed = type(craig)(
        name=craig.name,
        title=craig.title,
        convention=craig.convention,
        joints=joints,
        parameters=dict.fromkeys(("a1", "a2", "a3")),
    )
    assert pose(renamed) == pose(load("planar_rrr_paul")) == pose(load("planar_rrr_screw"))


def test_the_lectures_stanford_arm_in_two_conventions() -> None:
    """Slides 30 and 42: the screws count their angles from another home pose."""
    paul = from_inline(
        "-pi/2 0 0 theta1-pi/2; pi/2 0 g theta2-pi/2; 0 0 d3 0; -pi/2 0 0 theta4+pi/2; pi/2 0 0 -theta5; 0 0 h theta6",
        convention="paul",
        name="stanford",
    )
    assert pose(paul) == pose(load("stanford_screw"))
    plain = load("stanford_paul")
    assert [joint.alpha for joint in plain.joints] == [joint.alpha for joint in paul.joints]


def test_what_has_no_exact_table_is_refused_by_name() -> None:
    arm = load("planar_rr")
    skew = convert(arm, Convention.SCREW)
    moved = type(skew)(
        **{
            **{f: getattr(skew, f) for f in ("name", "title", "convention", "parameters", "home")},
            "joints": (
                skew.joints[0],
                type(skew.joints[1])(
                    kind="R",
                    variable="theta2",
                    s=skew.joints[1].s,
                    s0=(Symbol("l1", real=True), Symbol("l2", real=True), skew.joints[1].s0[2]),  # type: ignore[index]
                ),
            ),
        }
    )
    with pytest.raises(RobotError, match=r"joint theta1.*no exact form.*Turn the base frame"):
        convert(moved, Convention.PAUL)


def test_twists_survive() -> None:
    arm = from_inline(SHAPES["skew_shoulder"], convention="paul", name="skew")
    craig = convert(arm, Convention.CRAIG)
    assert pose(craig) == pose(arm)
    assert craig.joints[1].alpha == arm.joints[0].alpha
