"""T of every table equals the product of its matrices, exactly; so do the link transforms and the Jacobian."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.forward import forward_kinematics
from kinsym.robot.model import Robot
from tests.arms import FRAMED, NAMES, derivation, numpy_module, robot
from tests.kinematics.exact import home, identity, of_chain, of_tree, product, sample, times

SKEW = (
    "kinova_jaco",
    "nao_left_leg",
    "skew_wrist",
    "skew_shoulder",
    "symbolic_pieper",
    *(name for name in NAMES if name.startswith("slid") and name != "slide_and_two"),
    FRAMED,
)
RIGHT_ANGLED = [name for name in NAMES if name not in SKEW]


def pose(arm: Robot, seed: int) -> list[list[Fraction]]:
    """T from the chain's polynomials at random rational values."""
    chain = build_chain(arm)
    columns = forward_kinematics(chain).columns
    values = sample(arm, seed)
    rows = [[of_chain(chain, values, column[i]) for column in columns] for i in range(3)]
    return [*rows, [Fraction(0), Fraction(0), Fraction(0), Fraction(1)]]


@pytest.mark.parametrize("name", RIGHT_ANGLED)
def test_forward_kinematics_is_the_product_of_the_table(name: str) -> None:
    arm = robot(name)
    for seed in (1, 2):
        assert pose(arm, seed) == product(arm, sample(arm, seed))


@pytest.mark.parametrize("name", RIGHT_ANGLED)
def test_jacobian_is_the_derivative_of_the_position(name: str) -> None:
    """For a joint angle at c + i s the derivative of a trigonometric polynomial is exact: c -> -s, s -> c."""
    found = derivation(name)
    chain, columns, jacobian = found.chain, found.forward.columns, found.jacobian
    values = sample(found.robot, 3)
    for j, joint in enumerate(chain.joints):
        axis = [of_chain(chain, values, entry) for entry in jacobian.axes[j]]
        derivative = [_derivative(found, values, entry, joint.variable, joint.kind) for entry in columns[3]]
        if joint.kind == "P":
            assert derivative == axis
            continue
        end = [of_chain(chain, values, entry) for entry in jacobian.end]
        lever = [e - of_chain(chain, values, entry) for e, entry in zip(end, jacobian.points[j], strict=True)]
        assert derivative == _cross(axis, lever)
        for column in columns[:3]:
            turned = [_derivative(found, values, entry, joint.variable, "R") for entry in column]
            assert turned == _cross(axis, [of_chain(chain, values, entry) for entry in column])


def _cross(left: list[Fraction], right: list[Fraction]) -> list[Fraction]:
    (a, b, c), (x, y, z) = left, right
    return [b * z - c * y, c * x - a * z, a * y - b * x]


def _derivative(found: object, values: object, poly: object, variable: str, kind: str) -> Fraction:
    chain = found.chain  # type: ignore[attr-defined]
    total = chain.ring.zero
    if kind == "P":
        return of_chain(chain, values, poly.diff(chain.ring[variable]))  # type: ignore[arg-type, attr-defined]
    for angle in chain.angles.values():
        sign = dict(angle.terms).get(variable, 0)
        if sign:
            c, s = chain.ring[angle.cosine], chain.ring[angle.sine]
            total += (poly.diff(s) * c - poly.diff(c) * s) * sign  # type: ignore[attr-defined]
    return of_chain(chain, values, total)  # type: ignore[arg-type]


def test_scara_sums_its_angles_with_signs() -> None:
    """The lecture's SCARA arm turns by theta1 + theta2 - theta4 (slide 22)."""
    chain = derivation("scara").chain
    assert "c12m4" in chain.ring
    assert [group.joints for group in chain.groups] == [(0, 1, 2, 3)]


@pytest.mark.parametrize("name", RIGHT_ANGLED)
def test_the_links_that_are_shown_multiply_to_the_pose(name: str) -> None:
    """A1 A2 ... An for a Denavit-Hartenberg table, times the home pose for screws."""
    arm, found = robot(name), derivation(name)
    values = sample(arm, 5)
    total = identity()
    for number, link in enumerate(found.forward.links, start=1):
        assert link.name == f"A{number}"
        total = times(total, [[of_tree(found.chain, values, cell) for cell in row] for row in link.matrix])
    if arm.home is not None:
        total = times(total, home(arm, values))
    assert total == product(arm, values)


@pytest.mark.parametrize("name", RIGHT_ANGLED)
def test_the_nested_pose_is_the_product_of_the_table(name: str) -> None:
    arm, found = robot(name), derivation(name)
    values = sample(arm, 6)
    shown = [[of_tree(found.chain, values, cell) for cell in row] for row in found.forward.pose]
    assert shown == product(arm, values)


def test_base_and_tool_stand_around_the_table() -> None:
    """T = base T' tool with rpy = Rz Ry Rx, and T' the arm without them; the oracle multiplies floats."""
    framed, bare = numpy_module(FRAMED), numpy_module("ur5")
    q = np.random.default_rng(3).uniform(-3.0, 3.0, (50, 6))
    base = rigid((0.1, 0.7, 0.3), (0.3, 0.2, 0.1))
    tool = rigid((0.0, 0.05, 0.12), (np.pi / 2, 0.0, np.pi / 4))
    assert np.abs(framed.fk(q, h=0.7) - base @ bare.fk(q) @ tool).max() < 1e-14


def rigid(xyz: tuple[float, ...], rpy: tuple[float, ...]) -> np.ndarray:
    """A 4x4 transform from a position and roll, pitch, yaw."""
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(angle), np.sin(angle)) for angle in rpy)
    result = np.eye(4)
    result[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    result[:3, 3] = xyz
    return result
