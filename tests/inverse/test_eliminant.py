"""X^2 + Y^2 - k1^2 - k2^2 where all four are linear in the cosine and sine of an angle, at points of the circle."""

from __future__ import annotations

import random
from types import SimpleNamespace

import pytest

from kinsym.algebra.field import PRIME, circle_point
from kinsym.inverse.nonzero import _eliminant
from kinsym.inverse.rules.turned_pair import eliminant_of, proportional

GENERATOR = random.Random(10)
LINES = [[tuple(GENERATOR.randrange(PRIME) for _ in range(3)) for _ in range(4)] for _ in range(4)]
POINTS = [circle_point(GENERATOR) for _ in range(6)]


def at(coefficients: tuple[int, ...], point: tuple[int, int]) -> int:
    """The sum of c^2, c s, c, s and 1 with these coefficients."""
    c, s = point
    return sum(k * value for k, value in zip(coefficients, (c * c, c * s, c, s, 1), strict=True)) % PRIME


def along(line: tuple[int, ...], point: tuple[int, int]) -> int:
    return line[0] * point[0] + line[1] * point[1] + line[2]


@pytest.mark.parametrize("lines", LINES)
def test_the_inputs_of_a_step_give_its_polynomial(lines: list[tuple[int, ...]]) -> None:
    inputs = {
        f"{name}{end}": value
        for name, line in zip("xykl", lines, strict=True)
        for end, value in zip(("c", "s", ""), line, strict=True)
    }
    found = tuple(_eliminant(inputs))
    for point in POINTS:
        x, y, k1, k2 = (along(line, point) for line in lines)
        assert at(found, point) == (x * x + y * y - k1 * k1 - k2 * k2) % PRIME
    for name in inputs:
        assert any(_eliminant({**inputs, name: None}))
    same = {**inputs, **{f"{k}{end}": inputs[f"{x}{end}"] for x, k in ("xk", "yl") for end in ("c", "s", "")}}
    assert not any(_eliminant(same))


def pair(lines: list[tuple[int, ...]], scales: tuple[int, int]):
    """A pair whose polynomials are numbers, the same at both points."""
    x, y, k1, k2 = lines
    sides = [SimpleNamespace(rest=line, scale=scale) for line, scale in zip((x, y), scales, strict=True)]
    return SimpleNamespace(sides=sides, k1=k1, k2=k2)


STATE = SimpleNamespace(values=lambda number: (number, number + 1))


@pytest.mark.parametrize("lines", LINES)
def test_the_polynomials_of_a_pair_give_it_with_the_scales_of_its_sides(lines: list[tuple[int, ...]]) -> None:
    scales = (3, 5)
    first, second = eliminant_of(STATE, pair(lines, scales))
    for shift, found in ((0, first), (1, second)):
        m, n = (scale + shift for scale in scales)
        for point in POINTS:
            x, y, k1, k2 = (along(tuple(value + shift for value in line), point) for line in lines)
            assert at(found, point) == (n * n * x * x + m * m * y * y - m * m * n * n * (k1 * k1 + k2 * k2)) % PRIME


def test_proportional_eliminations_say_the_same() -> None:
    one, other = (eliminant_of(STATE, pair(lines, (1, 1))) for lines in LINES[:2])
    half = tuple(tuple(3 * value % PRIME for value in point) for point in one)
    assert proportional(one, one)
    assert proportional(one, half)
    assert not proportional(one, other)
    assert not proportional(one, (one[0], other[1]))
    assert not proportional(one, (other[0], one[1]))
    for place in range(5):
        changed = tuple(value + (number == place) for number, value in enumerate(one[1]))
        assert not proportional(one, (one[0], changed))
