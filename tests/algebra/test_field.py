"""The prime field holds every angle it promises, and rationals behave as they should."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from sympy import isprime

from kinsym.algebra.field import PRIME, angle_point, circle_point, inverse, residue, turn


def test_prime_is_prime_and_one_modulo_5040() -> None:
    assert isprime(PRIME)
    assert PRIME % 5040 == 1


@pytest.mark.parametrize("degrees", [0, 30, 36, 45, 60, 72, 90, 120, 180, 270])
def test_angle_points_lie_on_the_circle(degrees: int) -> None:
    point = angle_point(Fraction(degrees, 180))
    assert point is not None
    c, s = point
    assert (c * c + s * s) % PRIME == 1


def test_angle_points_keep_their_exact_relations() -> None:
    c30, s30 = angle_point(Fraction(1, 6)) or (0, 0)
    c60, s60 = angle_point(Fraction(1, 3)) or (0, 0)
    c45, s45 = angle_point(Fraction(1, 4)) or (0, 0)
    assert (s30, c30) == (c60, s60)
    assert s30 * 2 % PRIME == 1
    assert c45 == s45
    assert turn((c30, s30), (c30, s30)) == (c60, s60)
    assert turn((c60, s60), (c30, s30), -1) == (c30, s30)


def test_every_multiple_of_the_smallest_angle_has_a_point_of_its_own() -> None:
    """Were the root of unity of a smaller order than 5040, an angle that is no full turn would have the point of 0."""
    points = [angle_point(Fraction(number, 2520)) for number in range(5040)]
    assert len(set(points)) == 5040
    assert points[0] == (1, 0)
    assert angle_point(Fraction(5041, 2520)) == points[1]


def test_an_angle_outside_the_field_is_refused() -> None:
    assert angle_point(Fraction(1, 11)) is None


def test_random_points_and_residues() -> None:
    generator = random.Random(1)
    c, s = circle_point(generator)
    assert (c * c + s * s) % PRIME == 1
    assert residue(Fraction(-3, 7)) * 7 % PRIME == PRIME - 3
    assert inverse(5) * 5 % PRIME == 1
