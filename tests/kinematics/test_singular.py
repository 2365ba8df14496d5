"""The singular set of known arms, and its identity with det J.

Sources of the expected factors: planar RR, l1 l2 s2, J. J. Craig, Introduction to Robotics, section 5.8; Puma 560,
Stanford and UR5 by hand from the block form of J at the wrist centre; the sets of the others by hand from their tables.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from kinsym.algebra import factors
from kinsym.algebra.linear import determinant, kernel
from kinsym.algebra.residues import residue_of
from kinsym.emit.prose.singular import angles, equations, leading_to, verdict
from kinsym.emit.text.formula import TextPrinter
from kinsym.kinematics.chain import build_chain, chain_to_solve
from kinsym.kinematics.singular import SingularSet, minors, singular_set
from kinsym.kinematics.singular.conditions import Arm
from kinsym.kinematics.singular.given import given_conditions
from kinsym.kinematics.singular.posture import Posture
from kinsym.kinematics.singular.zeros import Part, postures, somewhere
from kinsym.robot import from_inline, load, lock
from kinsym.robot.expressions import parse
from kinsym.robot.model import Task
from tests.arms import NAMES, derivation
from tests.kinematics.determinants import square

WRITE = TextPrinter()

# name: (det J, then name and geometry of each condition); the constant in front is the first factor.
KNOWN = {
    "planar_rr": ("l1*l2*s2", [("elbow", "axes 1 and 2 and the end point lie in one plane")]),
    "planar_rrr_paul": ("a1*a2*s2", [("elbow", "axes 1, 2 and 3 lie in one plane")]),
    "scara": ("a1*a2*s2", [("elbow", "axes 1, 2 and 4 lie in one plane")]),
    "spherical_wrist": ("-s5", [("wrist", "axes 1 and 3 coincide")]),
    "cylindrical_rpp": ("d3", [("shoulder", "the end point lies on axis 1")]),
    "elbow_rrr": (
        "-a2*a3*s3*(a2*c2 + a3*c23)",
        [("elbow", "axes 2 and 3 and the end point lie in one plane"), ("shoulder", "the end point lies on axis 1")],
    ),
    "puma560": (
        "a2*s5*(d4*c3 + a3*s3)*(a2*c2 + a3*c23 - d4*s23)",
        [
            ("wrist", "axes 4 and 6 coincide"),
            ("elbow", "axes 2 and 3 and the wrist centre lie in one plane"),
            ("shoulder", "the wrist centre lies in the plane of axes 1 and 2"),
        ],
    ),
    "fanuc_s900w": (
        "-a2*s5*(d4*c3 - a3*s3)*(a2*c2 + a3*c23 + d4*s23 + a1)",
        [
            ("wrist", "axes 4 and 6 coincide"),
            ("elbow", "axes 2 and 3 and the wrist centre lie in one plane"),
            ("shoulder", "the wrist centre lies on axis 1"),
        ],
    ),
    "ur5": (
        "a2*a3*s5*s3*(a2*c2 + a3*c23 + d5*s234)",
        [
            ("wrist", "axis 6 is parallel to axes 2, 3 and 4"),
            ("elbow", "axes 2, 3 and 4 lie in one plane"),
            ("shoulder", "the point where axes 5 and 6 meet lies in the plane of axes 1 and 2"),
        ],
    ),
    "stanford_paul": (
        "d3^2*s5*s2",
        [
            ("", "the wrist centre lies on axis 2"),
            ("wrist", "axes 4 and 6 coincide"),
            ("shoulder", "the wrist centre lies in the plane of axes 1 and 2"),
        ],
    ),
    "elbow_6r_screw": (
        "a2*a3*c5*s3*(a2*c2 + a3*c23 + a4*c234)",
        [
            ("wrist", "axis 6 is parallel to axes 2, 3 and 4"),
            ("elbow", "axes 2, 3 and 4 lie in one plane"),
            ("shoulder", "the point where axes 5 and 6 meet lies on axis 1"),
        ],
    ),
}


def value(found: SingularSet, posture: Posture) -> int | None:
    """The product of the factors at a posture, modulo the prime."""
    return residue_of(found.determinant, posture.values)


@pytest.mark.parametrize("name", KNOWN)
def test_known_arms(name: str) -> None:
    found = derivation(name).singular
    product, meanings = KNOWN[name]
    assert WRITE(found.determinant) == product
    assert [(c.meaning.name, c.meaning.reason.partition(":")[0]) for c in found.conditions] == meanings
    assert found.square
    assert found.exhaustive
    assert found.split


@pytest.mark.parametrize("name", NAMES)
def test_the_product_is_the_determinant(name: str) -> None:
    """Where there is one: a Jacobian that is not square has none, and the factors of some were not looked for."""
    arm = derivation(name)
    for posture in somewhere(arm.solved, 3):
        slopes = square(arm.plan.task, posture)
        if arm.singular.square:
            assert determinant(slopes) == value(arm.singular, posture)


@pytest.mark.parametrize("name", NAMES)
def test_j_loses_a_motion_on_every_part_of_every_condition_and_nowhere_by_chance(name: str) -> None:
    arm = derivation(name)
    for condition in arm.singular.conditions:
        for zero in condition.zeros:
            found = postures(arm.solved, zero, 3)
            assert found
            for posture in found:
                assert all(arm.solved.ring.evaluate(poly, posture.values) == 0 for poly in condition.polys)
                assert kernel(posture.jacobian(arm.plan.task))
    for posture in somewhere(arm.solved, 3):
        assert not kernel(posture.jacobian(arm.plan.task))


def test_an_arm_with_fewer_joints_than_the_pose_needs_two_conditions_at_once() -> None:
    # by hand: the columns of joints 1 and 5 are the only ones with y and the two angular velocities across axis 2
    found = derivation("scorbot_5r").singular
    assert not found.square
    assert found.exhaustive
    assert [tuple(map(WRITE, c.values)) for c in found.conditions] == [("s3",), ("s234", "a2*c2 + a3*c23 + a1")]


def test_position_and_axis_has_a_square_jacobian() -> None:
    # joint 5 turns w, and the turn about w that the task leaves open is the sixth column
    table = "pi/2 a1 d1 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; -pi/2 0 d4 theta4; pi/2 0 0 theta5"
    chain = build_chain(from_inline(table, convention="paul", name="five"))
    found = singular_set(chain, Task.POSITION_AXIS)
    assert WRITE(found.determinant) == "-a2*s5*(d4*c3 - a3*s3)*(a2*c2 + a3*c23 + d4*s23 + a1)"
    for posture in somewhere(chain, 3):
        assert determinant(square(Task.POSITION_AXIS, posture)) == value(found, posture)


def test_a_factor_may_count_in_one_of_its_zeros_only() -> None:
    table = "-pi/2 a a theta1; -pi/2 a 0 theta2; -pi/2 a 0 theta3; -pi/2 0 a theta4"
    chain = build_chain(from_inline(table, convention="paul", name="equal"))
    found = singular_set(chain, Task.POSE)
    one = next(c for c in found.conditions if not c.whole and len(c.values) == 1)
    (zero,) = one.zeros
    assert not found.exhaustive
    assert (angles(one, WRITE), leading_to(one)) == ("theta2 = pi", "but only for")
    at_zero = replace(zero[0], quarters=0)
    assert not any(kernel(posture.jacobian(Task.POSE)) for posture in postures(chain, (at_zero,), 2))


def test_an_arm_of_slides_is_never_singular() -> None:
    found = derivation("three_slides").singular
    assert (found.conditions, found.square, found.exhaustive) == ((), True, True)


def test_lengths_that_are_numbers_stay_lengths() -> None:
    numbers = {"a2": Fraction("-0.425"), "a3": Fraction("-0.39225"), "d5": Fraction("0.09465")}
    robot = load("ur5", bindings=numbers)
    found = singular_set(build_chain(robot), Task.POSE)
    shoulder = next(c for c in found.conditions if c.meaning.name == "shoulder")
    assert WRITE(shoulder.values[0]) in (
        "0.425*c2 + 0.39225*c23 - 0.09465*s234",
        "0.09465*s234 - 0.425*c2 - 0.39225*c23",
    )


def test_an_arm_that_moves_without_moving_its_end_has_no_list() -> None:
    robot = from_inline("0 a1 0 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4", convention="paul", name="four")
    found = singular_set(build_chain(robot), Task.PLANAR)
    assert found.conditions == ()
    assert "without moving the end effector" in found.missing


def test_a_determinant_out_of_bounds_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(minors, "WORK", 1)
    found = singular_set(build_chain(load("ur5")), Task.POSE)
    assert found.conditions == ()
    assert "too many terms" in found.missing


def test_a_factor_that_is_too_long_is_left_whole_and_the_others_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(factors, "LARGEST", 2)
    arm = derivation("puma560")
    found = singular_set(arm.chain, Task.POSE)
    assert not found.split
    assert "s5" in [WRITE(value) for c in found.conditions for value in c.values]
    for posture in somewhere(arm.chain, 2):
        assert determinant(posture.jacobian(Task.POSE)) == value(found, posture)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("general_pieper", "joints 1, 2 and 3 move the wrist centre in fewer than 3 ways"),
        ("pieper_first", "joints 4, 5 and 6 move the point where axes 1, 2 and 3 meet in fewer than 3 ways"),
    ],
)
def test_three_joints_that_carry_a_point_are_named_where_no_figure_fits(name: str, reason: str) -> None:
    """The other condition is the wrist's, so this one is the determinant of the position alone."""
    assert [c.meaning.reason for c in derivation(name).singular.conditions][1:] == [reason]


def test_the_same_set_in_every_convention_and_unit() -> None:
    twins = [derivation(name).singular for name in ("planar_rrr_paul", "planar_rrr_craig", "planar_rrr_screw")]
    assert len({tuple(c.meaning.reason for c in one.conditions) for one in twins}) == 1


GIVEN = {
    ("kuka_iiwa", "theta2"): ("s2", "joint 2", ["theta2 = 0", "theta2 = pi"]),
    ("kuka_iiwa", "theta6"): ("s6", "joint 6", ["theta6 = 0", "theta6 = pi"]),
    ("puma560", "theta5"): ("s5", "joint 5", ["theta5 = 0", "theta5 = pi"]),
    ("elbow_6r_screw", "theta5"): ("c5", "joint 5", ["theta5 = pi/2", "theta5 = -pi/2"]),
    ("stanford_paul", "d3"): ("d3", "joint 3", ["d3 = 0"]),
}


def locked(name: str, joint: str, value: str | None = None) -> SingularSet:
    """The singular set of a gallery robot with one joint locked."""
    return singular_set(chain_to_solve(lock(load(name), {joint: value})), Task.POSE)


@pytest.mark.parametrize(("name", "joint"), GIVEN)
def test_values_of_an_input_at_which_every_pose_is_singular(name: str, joint: str) -> None:
    factor, who, where = GIVEN[name, joint]
    (one,) = locked(name, joint).given
    assert (WRITE(one.values[0]), one.meaning.reason) == (factor, f"with {who} locked there, every pose is singular")
    assert [f"{WRITE(left)} = {WRITE(right)}" for (part,) in one.zeros for left, _, right in [part.relation]] == where
    for relation in where:
        value = parse(relation.partition(" = ")[2], where="test")
        chain = chain_to_solve(replace(load(name), locks={joint: value}))
        assert all(kernel(posture.jacobian(Task.POSE)) for posture in somewhere(chain, 2))


def test_a_polynomial_in_one_input_is_not_its_cosine() -> None:
    """2 c2 = 1 is told as it is, and only of a square Jacobian: nothing is known of where it vanishes."""
    arm = Arm(chain_to_solve(lock(load("kuka_iiwa"), {"theta2": None})), Task.POSE)
    factor = 2 * arm.chain.ring["c2"] - 1
    (found,) = given_conditions(arm, [factor], square=True)
    assert found.zeros == ((Part(factor),),)
    assert not list(given_conditions(arm, [factor], square=False))


def test_a_sum_in_an_input_is_told_as_it_is() -> None:
    # by hand: the triple product of three slides with a locked turn by theta2 and twists of 90, alpha2 and 90 degrees
    # is sin(phi) cos(alpha2) c2 + cos(phi) s2
    table = "pi/2 0 d1 0; alpha2 0 0 theta2; pi/2 0 d3 phi; 0 0 d4 0"
    robot = from_inline(table, convention="paul", name="skew")
    found = singular_set(chain_to_solve(lock(robot, {"theta2": None})), Task.POSITION)
    (one,) = found.given
    assert WRITE(one.values[0]) == WRITE(found.determinant) == "calpha2*sphi*c2 + cphi*s2"
    assert [part.relation for (part,) in one.zeros] == [None]
    assert "vanishes" in verdict(found)


@pytest.mark.parametrize(("name", "joint", "value"), [("kuka_iiwa", "theta2", "0.4"), ("kuka_iiwa", "theta3", None)])
def test_no_value_is_told_where_none_is_given_or_none_is_singular(name: str, joint: str, value: str | None) -> None:
    found = locked(name, joint, value)
    assert found.given == ()
    assert found.listed == found.conditions


def test_axes_have_the_numbers_of_the_table_also_next_to_a_locked_joint() -> None:
    # by hand: axes 5, 6 and 7 meet in the wrist, and s4 = 0 puts the shoulder on the forearm's axis 5
    found = {WRITE(c.values[0]): c.meaning for c in locked("kuka_iiwa", "theta3").conditions}
    assert found["s6"].reason == "axes 5 and 7 coincide"
    assert found["s4"].reason == "the point where axes 1 and 2 meet lies on axis 5"


def test_two_conditions_that_hold_for_one_value_of_an_angle_name_the_value() -> None:
    # by hand: axis 5 through the shoulder, a4 before or behind it; c2 = c23 = 0 is part of s3 = 0
    found = locked("elbow_6r_screw", "theta6")
    assert [list(equations(c, WRITE)) for c in found.conditions] == [
        [("s3", "0")],
        [("theta234", "0"), ("a2*c2 + a3*c23 + a4", "0")],
        [("theta234", "pi"), ("a2*c2 + a3*c23 - a4", "0")],
    ]
