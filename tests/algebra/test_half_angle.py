"""Polynomials in the tangents of half the angles have the values of those in cosines and sines, and come back."""

from __future__ import annotations

import random
from fractions import Fraction
from math import prod

import pytest

from kinsym.algebra.half_angle import HalfAngles, Piece
from kinsym.algebra.ring import Generator, Kind, Poly, Ring

RING = Ring(
    [
        Generator("c1", Kind.COSINE),
        Generator("s1", Kind.SINE, "c1"),
        Generator("c2", Kind.COSINE),
        Generator("s2", Kind.SINE, "c2"),
        Generator("d", Kind.LENGTH),
        Generator("a", Kind.PARAMETER),
    ]
)
C1, S1, C2, S2, D, A = (RING[name] for name in ("c1", "s1", "c2", "s2", "d", "a"))
POLYS = {
    "s1": S1,
    "c1": C1,
    "1 + c1": 1 + C1,
    "1 - c1": 1 - C1,
    "two angles": C1 * S2 + S1 * C2 * 3,
    "squares": C1**2 * S2 - A * C2 + 5 * D,
    "a length": D**2 * C1 - A * S1 + D,
    "no angle": D + A,
    "one angle of two": D * S2 - A,
}


def value(poly: object, numbers: list[Fraction]) -> Fraction:
    """A polynomial at values of its generators."""
    terms = poly.terms()  # type: ignore[attr-defined]
    return sum(
        (
            Fraction(int(k.numerator), int(k.denominator))
            * prod((n**e for n, e in zip(numbers, m, strict=True)), start=Fraction(1))
            for m, k in terms
        ),
        Fraction(0),
    )


def numbers(half: HalfAngles, seed: int) -> tuple[list[Fraction], list[Fraction], list[Fraction]]:
    """Values of the ring's generators, of those in half angles, and 1 + t^2 for each tangent t."""
    generator = random.Random(seed)
    tangents = {c: Fraction(generator.randrange(1, 20), generator.randrange(1, 20)) for c, _ in half.circles}
    others = {name: Fraction(generator.randrange(1, 20)) for name in RING.index}
    points = dict(others)
    for c, s in half.circles:
        t = tangents[c]
        points[c], points[s] = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    half_points = [*tangents.values(), *(others[name] for name in half._others)]
    return [points[g.name] for g in RING.generators], half_points, [1 + t * t for t in tangents.values()]


@pytest.mark.parametrize("name", POLYS)
def test_in_half_angles_it_has_the_same_value_times_what_makes_it_homogeneous(name: str) -> None:
    poly = RING.reduce(POLYS[name])
    half = HalfAngles(RING, poly)
    used = set(RING.used(poly))
    assert half.circles == [pair for pair in (("c1", "s1"), ("c2", "s2")) if {*pair} & used]
    whole = half.homogeneous(poly)
    assert all(degree > 0 and degree % 2 == 0 for degree in whole.degrees)
    for seed in range(3):
        plain, halves, scales = numbers(half, seed)
        scale = prod((k ** (degree // 2) for k, degree in zip(scales, whole.degrees, strict=True)), start=Fraction(1))
        assert value(whole.poly, halves) == value(poly, plain) * scale


@pytest.mark.parametrize("name", POLYS)
def test_its_factors_multiply_to_it_and_back_it_is_a_positive_multiple(name: str) -> None:
    poly = RING.reduce(POLYS[name])
    half = HalfAngles(RING, poly)
    whole = half.homogeneous(poly)
    back = half.back(whole)
    ratio = Fraction(int(back.LC.numerator), int(back.LC.denominator)) / Fraction(
        int(poly.LC.numerator), int(poly.LC.denominator)
    )
    assert ratio > 0
    assert back == poly * RING.number(ratio)
    pieces = half.factors(whole)
    product = half.product(pieces) if half.circles else None
    if product is not None:
        assert product.degrees == whole.degrees
        assert product.poly * whole.poly.LC == whole.poly * product.poly.LC


@pytest.mark.parametrize(
    ("poly", "count", "degrees"),
    [
        (S1, 2, {(1,)}),
        (C1, 2, {(1,)}),
        (1 + C1, 2, {(1,)}),
        (C1 * S2, 4, {(1, 0), (0, 1)}),
        (C1 * S2 + S1 * C2, 2, {(1, 1)}),
        (D * C1 - A, 1, {(2,)}),
        (A * C1 + D * S1, 1, {(2,)}),
    ],
)
def test_how_many_factors_there_are(poly: Poly, count: int, degrees: set[tuple[int, ...]]) -> None:
    half = HalfAngles(RING, poly)
    pieces = half.factors(half.homogeneous(poly))
    assert len(pieces) == count
    assert {piece.degrees for piece in pieces} == degrees
    assert {piece.parity for piece in pieces} == {tuple(degree % 2 for degree in one) for one in degrees}


def test_what_is_linear_in_a_length_is_divided_by_what_its_coefficients_share() -> None:
    """s1 d (a + d c2): linear in a, with the factor s1 d in both coefficients."""
    poly = RING.mul(S1, D * (A + D * C2))
    half = HalfAngles(RING, poly)
    found = half.factors(half.homogeneous(poly))
    assert sorted(piece.degrees for piece in found) == [(0, 0), (0, 2), (1, 0), (1, 0)]
    assert isinstance(found[0], Piece)
