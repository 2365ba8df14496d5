"""Factors modulo c^2 + s^2 = 1, determinants in blocks, roots modulo the prime."""

from __future__ import annotations

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kinsym.algebra import factors
from kinsym.algebra.determinant import block_determinants, determinant, expansion
from kinsym.algebra.factors import Factored, factored
from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import determinant as determinant_of_numbers
from kinsym.algebra.linear import dot, kernel
from kinsym.algebra.ring import Generator, Kind, Poly, Ring
from kinsym.algebra.roots import roots

RING = Ring(
    [
        Generator("c1", Kind.COSINE),
        Generator("s1", Kind.SINE, "c1"),
        Generator("c2", Kind.COSINE),
        Generator("s2", Kind.SINE, "c2"),
        Generator("d", Kind.LENGTH),
        Generator("a", Kind.PARAMETER),
        Generator("b", Kind.PARAMETER),
    ]
)
C1, S1, C2, S2, D, A, B = (RING[name] for name in ("c1", "s1", "c2", "s2", "d", "a", "b"))


def product(found: Factored) -> Poly:
    """What the factors multiply to."""
    total = found.constant
    for poly, power in found.factors:
        for _ in range(power):
            total = RING.mul(total, poly)
    return total


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ([S1, S1], {S1: 2}),
        ([A * C1 + B * S1, A * C2 + B], {A * C1 + B * S1: 1, A * C2 + B: 1}),
        # the second factor shares its angle with the first: the product reduces and no longer looks like one
        ([A * S1 + B * C1, A * C1 + D], {B * C1 + A * S1: 1, A * C1 + D: 1}),
        ([S1, S1, C2], {S1: 2, C2: 1}),
        ([1 + C1], {C1 + 1: 1}),
        ([C1 * S2 + S1 * C2], {C1 * S2 + S1 * C2: 1}),
        ([D, D, D - A * C1], {D: 2, A * C1 - D: 1}),
    ],
)
def test_what_was_multiplied_is_found(parts: list[Poly], expected: dict[Poly, int]) -> None:
    whole = RING.one
    for part in parts:
        whole = RING.mul(whole, part)
    found = factored(RING, [whole])
    assert {(p if p.LC > 0 else -p): k for p, k in found.factors} == expected
    assert product(found) == whole
    assert found.complete


def test_parameters_are_no_factors_but_stand_in_the_constant() -> None:
    found = factored(RING, [3 * A * B * S1])
    assert (found.constant, found.factors) == (3 * A * B, ((S1, 1),))


def test_beyond_the_bound_only_the_generators_are_taken_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(factors, "LARGEST", 3)
    whole = RING.mul(S2, RING.mul(A * C1 + B * S1, A * S1 - B))
    found = factored(RING, [whole])
    assert not found.complete
    assert [p for p, _ in found.factors if p == S2]
    assert product(found) == whole


_terms = st.sampled_from([C1, S1, C2, S2, A, B, D, RING.one])
_polys = st.lists(st.tuples(st.integers(-3, 3), _terms, _terms), min_size=1, max_size=3).map(
    lambda parts: RING.reduce(sum((k * x * y for k, x, y in parts), RING.zero))
)


@settings(max_examples=60)
@given(st.lists(_polys.filter(bool), min_size=1, max_size=3))
def test_factors_always_multiply_to_what_was_given(polys: list[Poly]) -> None:
    whole = RING.one
    for poly in polys:
        whole = RING.mul(whole, poly)
    if whole:
        assert product(factored(RING, [whole])) == whole


def test_blocks_multiply_to_the_determinant_with_its_sign() -> None:
    generator = random.Random(1)
    for _ in range(30):
        size = generator.randrange(2, 6)
        rows = [
            [RING.number(generator.choice((0, 0, 0, 1, 2, -3))) * generator.choice((A, B, C1)) for _ in range(size)]
            for _ in range(size)
        ]
        total = RING.one
        for block in block_determinants(RING, rows):
            total = RING.mul(total, block)
        assert total == determinant(RING, rows)
        assert expansion(rows) > 0 or total == 0


def test_a_determinant_of_numbers_agrees() -> None:
    rows = [[2, 0, 1], [0, 3, 5], [7, 1, 1]]
    assert determinant(RING, [[RING.number(value) for value in row] for row in rows]) == -25
    assert determinant_of_numbers(rows) == PRIME - 25
    assert determinant_of_numbers([[0, 1], [1, 0]]) == PRIME - 1
    assert determinant_of_numbers([[1, 2], [2, 4]]) == 0


def test_the_kernel_is_taken_to_zero_and_complete() -> None:
    rows = [[1, 2, 3, 4], [2, 4, 6, 8], [0, 1, 1, 1]]
    basis = kernel(rows)
    assert len(basis) == 2
    assert all(dot(row, vector) == 0 for vector in basis for row in rows)


@given(st.lists(st.integers(0, PRIME - 1), min_size=1, max_size=5, unique=True))
def test_roots_are_found(wanted: list[int]) -> None:
    poly = [1]
    for root in wanted:
        poly = [(low - root * high) % PRIME for low, high in zip([0, *poly], [*poly, 0], strict=True)]
    assert roots(poly) == sorted(wanted)


def test_a_polynomial_without_roots_has_none() -> None:
    square = next(k for k in range(2, 50) if pow(k, (PRIME - 1) // 2, PRIME) == PRIME - 1)
    assert roots([-square, 0, 1]) == []
    assert roots([5]) == roots([]) == roots([0, 0]) == []
    assert roots([0, 0, 1]) == [0]
