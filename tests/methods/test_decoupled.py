"""The lecture's way for an arm whose wrist point leaves three joints: it says of others why it does not fit."""

from __future__ import annotations

import pytest

from kinsym.errors import DoesNotApply
from kinsym.methods import METHODS
from kinsym.robot import from_inline, load

decoupled = METHODS["decoupled"]


def test_the_lecture_finds_the_joints_in_this_order() -> None:
    """Slides 61 to 65: two values of theta1, theta3 and theta5, one of the others."""
    found = [(solution.unknown, solution.branches) for solution in decoupled(load("fanuc_s900w")).solutions]
    assert found == [("theta1", 2), ("theta3", 2), ("theta2", 1), ("theta5", 2), ("theta4", 1), ("theta6", 1)]


def test_a_shoulder_offset_makes_the_first_equation_inhomogeneous() -> None:
    """The Puma's wrist point is beside its first axis: theta1 has a condition and a sign."""
    derivation = decoupled(load("puma560"))
    assert [c.name for c in derivation.solutions[0].conditions] == ["theta1.real"]
    assert "loop.z" in {equation.name for equation in derivation.equations}


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("scara", "it needs six joints, this arm has 4 joints"),
        ("ur5", "axes 4 and 6 miss by d5"),
        ("stanford_paul", "axes 2 and 3 are not parallel, or a joint slides"),
        ("kuka_kr6_r900", "a base or a tool moves its frames 0 or 6"),
    ],
)
def test_it_says_why_it_does_not_apply(name: str, why: str) -> None:
    """The arm and the reason."""
    with pytest.raises(DoesNotApply, match=why):
        decoupled(load(name))


def test_a_wrist_of_other_twists_is_refused() -> None:
    """The quotients by the sine of theta5 need axes that cross at right angles."""
    table = "pi/2 a1 0 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; deg(-60) 0 d4 theta4; deg(60) 0 0 theta5; 0 0 d6 theta6"
    with pytest.raises(DoesNotApply, match="do not cross at right angles"):
        decoupled(from_inline(table, convention="paul", name="skew_wrist"))
