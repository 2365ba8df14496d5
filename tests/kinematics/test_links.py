"""Frames along given axes: rotations, the same for the same direction, and refused where no exact one is known."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest

from kinsym.algebra.ring import Poly, Ring
from kinsym.errors import RobotError
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.links import _foot, _normal_foot, axis_frame
from kinsym.robot import load

AXES = [
    (0, 0, 1),
    (0, 0, -1),
    (1, 0, 0),
    (0, -1, 0),
    (0, "3/5", "-4/5"),
    ("3/5", "4/5", 0),
    ("-5/13", 0, "12/13"),
    ("2/3", "1/3", "2/3"),
    ("2/3", "-1/3", "-2/3"),
    ("-2/7", "3/7", "6/7"),
]
"""Unit vectors with rational components: on a coordinate axis, in a coordinate plane, in none."""


@pytest.fixture(scope="module")
def ring() -> Ring:
    return build_chain(load("planar_rr")).ring


@pytest.mark.parametrize("axis", AXES, ids=str)
def test_a_frame_turns_z_into_the_axis(ring: Ring, axis: tuple[int | str, ...]) -> None:
    wanted = tuple(ring.number(Fraction(part)) for part in axis)
    rows = axis_frame(ring, wanted, 1)
    columns = list(zip(*rows, strict=True))
    assert columns[2] == wanted

    def dot(a: tuple[Poly, ...], b: tuple[Poly, ...]) -> Poly:
        return sum((p * q for p, q in zip(a, b, strict=True)), ring.zero)

    unit = [[ring.one if i == j else ring.zero for j in range(3)] for i in range(3)]
    assert [[dot(a, b) for b in columns] for a in columns] == unit
    (x1, y1, z1), (x2, y2, z2) = columns[:2]
    assert (y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2) == wanted


def test_z_keeps_its_frame_and_the_smallest_turn_is_about_an_axis_across(ring: Ring) -> None:
    one, zero = ring.one, ring.zero
    assert axis_frame(ring, (zero, zero, one), 1) == ((one, zero, zero), (zero, one, zero), (zero, zero, one))
    x, y, z = (ring.number(Fraction(part, 7)) for part in (-2, 3, 6))
    rows = axis_frame(ring, (x, y, z), 1)
    # the turn from z to the axis is about (-y, x, 0), which stays where it is
    across = (-y, x, zero)
    assert tuple(sum((p * q for p, q in zip(row, across, strict=True)), zero) for row in rows) == across


def test_three_components_that_are_no_numbers_are_refused(ring: Ring) -> None:
    name = ring["l1"]
    with pytest.raises(RobotError, match=r"three components that are not rational"):
        axis_frame(ring, (name, name, name), 1)


Vector = tuple[Fraction, Fraction, Fraction]


def dot(left: Vector, right: Vector) -> Fraction:
    return sum((a * b for a, b in zip(left, right, strict=True)), Fraction(0))


def less(left: Vector, right: Vector, times: Fraction = Fraction(1)) -> Vector:
    x, y, z = (a - times * b for a, b in zip(left, right, strict=True))
    return x, y, z


def feet(
    ring: Ring, function: Callable[..., tuple[Poly, ...]], *vectors: tuple[int | str | Fraction, ...]
) -> tuple[Vector, ...]:
    """The vectors as numbers, and last what the function makes of them."""
    numbers = [tuple(Fraction(part) for part in vector) for vector in vectors]
    found = function(ring, *(tuple(map(ring.number, vector)) for vector in numbers))
    return (*numbers, tuple(Fraction(int(f.numerator), int(f.denominator)) for f in (part.coeff(1) for part in found)))


@pytest.mark.parametrize("axis", AXES, ids=str)
def test_the_foot_is_the_point_of_an_axis_nearest_to_a_point(ring: Ring, axis: tuple[int | str, ...]) -> None:
    point, axis, through, foot = feet(ring, _foot, (2, -3, 5), axis, (7, 1, -4))
    assert dot(less(point, foot), axis) == 0
    along = dot(less(foot, through), axis)
    assert less(foot, through, Fraction(1)) == less((Fraction(0),) * 3, axis, -along)


@pytest.mark.parametrize("before", AXES[2:], ids=str)
@pytest.mark.parametrize("axis", AXES[:2] + AXES[4:6] + AXES[8:], ids=str)
def test_the_common_normal_ends_on_both_axes(
    ring: Ring, before: tuple[int | str, ...], axis: tuple[int | str, ...]
) -> None:
    """What is left between the axes, less its part along the first, is across both; parallel ones keep their point."""
    point, before, axis, through, foot = feet(ring, _normal_foot, (2, -3, 5), before, axis, (7, 1, -4))
    if before in (axis, less((Fraction(0),) * 3, axis)):
        assert foot == through
        return
    along = dot(less(foot, through), axis)
    assert less(foot, through) == less((Fraction(0),) * 3, axis, -along)
    gap = less(foot, point)
    across = less(gap, before, dot(gap, before))
    assert dot(across, axis) == dot(across, before) == 0


def test_axes_that_meet_have_their_normal_in_that_point(ring: Ring) -> None:
    *_, foot = feet(ring, _normal_foot, (1, 2, 3), (0, 0, 1), ("3/5", "4/5", 0), ("8/5", "14/5", 9))
    assert foot == (1, 2, 9)


def test_an_angle_that_is_no_number_keeps_the_point_of_the_table(ring: Ring) -> None:
    zero, one, name = ring.zero, ring.one, ring["l1"]
    through = (one, name, one * 7)
    assert _normal_foot(ring, (zero, zero, zero), (zero, zero, one), (name, zero, one), through) == through
