"""Where two roots of a linear equation meet at a pole of the rotation: which equations are such, and what they read."""

from __future__ import annotations

import pytest

from kinsym.algebra.ring import Poly
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import LinearForm
from kinsym.inverse.rules.linear_pole import Pole, _column, _pole
from kinsym.inverse.state import start
from kinsym.kinematics.chain import build_chain
from kinsym.robot.model import Task
from tests.arms import robot

CHAIN = build_chain(robot("general_pieper"))
STATE, _ = start(CHAIN, Task.POSE)
RING = CHAIN.ring
ANGLE = next(iter(CHAIN.angles.values()))
A, B, WX, VY, PX, C = (RING[name] for name in ("a1", "a2", "w_x", "v_y", "p_x", "c4"))
ZERO = RING.zero


def pole(a: Poly, b: Poly, e: Poly) -> Pole | None:
    """The pole of a c + b s = e."""
    return _pole(STATE, LinearForm(ANGLE, a, b, e, PoolEquation(a, e, 0, "", (ANGLE,), ())))


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("sign", [1, -1])
def test_at_a_pole_the_right_side_is_as_long_as_the_left(sense: int, sign: int) -> None:
    """There e = A - B, with the sign of the entry; at the other end of the axis it is A + B."""
    radius, e = (A - B) * sign, A - B * sense * WX
    assert pole(radius, ZERO, e) == pole(ZERO, radius, e) == Pole(A, -B * sense, "w_x", sense)


@pytest.mark.parametrize(
    ("a", "b", "e"),
    [
        (A - B, A, A - B * WX),
        (ZERO, ZERO, A - B * WX),
        (C, ZERO, A - B * WX),
        (A, ZERO, A - B * WX),
        (A - B, ZERO, A - B * PX),
        (A - B, ZERO, A - B),
        (A - B, ZERO, A - B * WX + VY),
        (A - B, ZERO, A - B * WX**2),
        # both ends of the axis would be poles
        (A - B, ZERO, (A - B) * WX),
    ],
)
def test_what_has_no_pole_of_its_own(a: Poly, b: Poly, e: Poly) -> None:
    assert pole(a, b, e) is None


@pytest.mark.parametrize("column", "uvw")
def test_the_other_entries_of_the_column_are_read(column: str) -> None:
    assert _column(f"{column}_x") == (f"{column}_x", f"{column}_y", f"{column}_z")
    assert _column(f"{column}_y") == (f"{column}_y", f"{column}_x", f"{column}_z")
    assert _column(f"{column}_z") == (f"{column}_z", f"{column}_x", f"{column}_y")
