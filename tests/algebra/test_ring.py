"""Normal forms, and the nested form: both mean the polynomial they come from."""

from __future__ import annotations

import random
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from kinsym.algebra.field import PRIME, circle_point, inverse, residue
from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Generator, Kind, Poly, Ring
from kinsym.algebra.tree import Num, Pow, Prod, Sum, Sym, Tree, negative

RING = Ring(
    [
        Generator("c1", Kind.COSINE),
        Generator("s1", Kind.SINE, "c1"),
        Generator("c23", Kind.COSINE),
        Generator("s23", Kind.SINE, "c23"),
        Generator("d3", Kind.LENGTH),
        Generator("p_x", Kind.POSE),
        Generator("root", Kind.CONSTANT, Fraction(2)),
        Generator("a2", Kind.PARAMETER),
    ]
)
SMALL = st.integers(min_value=-3, max_value=3)
TERM = st.tuples(SMALL, st.lists(st.integers(min_value=0, max_value=2), min_size=8, max_size=8))


def polynomial(terms: list[tuple[int, list[int]]]) -> Poly:
    """A polynomial from coefficients and exponents."""
    total = RING.zero
    for coefficient, exponents in terms:
        term = RING.one * coefficient
        for generator, exponent in zip(RING.generators, exponents, strict=True):
            term *= RING[generator.name] ** exponent
        total += term
    return total


@given(st.lists(st.tuples(st.lists(TERM, max_size=3), st.lists(TERM, max_size=3)), max_size=4))
def test_sum_of_products(pairs: list[tuple[list, list]]) -> None:
    """Also where a factor is the one of the ring, which is left out, or zero."""
    left = [RING.one, polynomial([(1, [0] * 7 + [1])]), RING.zero, *(RING.reduce(polynomial(x)) for x, _ in pairs)]
    right = [RING["s1"], RING.one, RING.one, *(RING.reduce(polynomial(y)) for _, y in pairs)]
    expected = RING.zero
    for x, y in zip(left, right, strict=True):
        expected += x * y
    assert RING.dot(left, right) == RING.reduce(expected)
    assert RING.dot([], []) == RING.zero


def test_a_ring_of_numbers_alone() -> None:
    """An arm of slides at right angles has no cosine, no length and no parameter."""
    ring = Ring([])
    assert ring.dot([ring.one, ring.number(2)], [ring.number(3), ring.number(4)]) == ring.number(11)


def point(seed: int) -> dict[str, int]:
    """A random point of the variety."""
    generator = random.Random(seed)
    values = {g.name: generator.randrange(PRIME) for g in RING.generators}
    values["c1"], values["s1"] = circle_point(generator)
    values["c23"], values["s23"] = circle_point(generator)
    values["root"] = pow(ROOT_OF_TWO, 1, PRIME)
    return values


def _root_of_two() -> int:
    from sympy.ntheory import sqrt_mod

    return int(sqrt_mod(2, PRIME))


ROOT_OF_TWO = _root_of_two()


def value(tree: Tree, values: dict[str, int]) -> int:
    """A tree modulo the prime."""
    match tree:
        case Num(number):
            return residue(number)
        case Sym(name):
            return values[name]
        case Sum(terms):
            return sum(value(term, values) for term in terms) % PRIME
        case Prod(factors):
            result = 1
            for factor in factors:
                result = result * value(factor, values) % PRIME
            return result
        case Pow(base, exponent):
            return pow(value(base, values), exponent, PRIME)
        case _:
            raise AssertionError(tree)


@given(st.lists(TERM, max_size=6), st.integers(min_value=0, max_value=9))
def test_reduction_keeps_the_value_and_leaves_no_square(terms: list[tuple[int, list[int]]], seed: int) -> None:
    poly = polynomial(terms)
    reduced = RING.reduce(poly)
    assert RING.evaluate(reduced, point(seed)) == RING.evaluate(poly, point(seed))
    for monomial in reduced:
        assert all(monomial[RING.index[name]] <= 1 for name in ("s1", "s23", "root"))


@given(st.lists(TERM, max_size=6), st.integers(min_value=0, max_value=9))
def test_nested_form_means_the_polynomial(terms: list[tuple[int, list[int]]], seed: int) -> None:
    poly = RING.reduce(polynomial(terms))
    assert value(nested(RING, poly), point(seed)) == RING.evaluate(poly, point(seed))


def test_nested_form_is_the_lectures() -> None:
    c1, s1, c23, s23, d3, p_x, _, a2 = RING.ring.gens
    assert nested(RING, c1 * a2) == Prod((Sym("a2"), Sym("c1")))
    assert nested(RING, c1 * p_x) == Prod((Sym("c1"), Sym("p_x")))
    inner = Sum((Prod((Sym("a2"), Sym("c23"))), Prod((Sym("d3"), Sym("s23")))))
    assert nested(RING, c1 * (a2 * c23 + d3 * s23)) == Prod((Sym("c1"), inner))
    minus = nested(RING, s1 * (s23 - c23) - s1 * s23)
    assert minus == Prod((Num(Fraction(-1)), Sym("s1"), Sym("c23")))


@given(st.lists(TERM, min_size=1, max_size=6))
def test_a_sum_starts_with_a_plus_where_it_can(terms: list[tuple[int, list[int]]]) -> None:
    tree = nested(RING, RING.reduce(polynomial(terms)))
    if isinstance(tree, Sum) and not all(negative(term) for term in tree.terms):
        assert not negative(tree.terms[0])


def test_names_replace_generators() -> None:
    assert nested(RING, RING["p_x"], {"p_x": Sym("p16_x")}) == Sym("p16_x")


def test_half_is_exact() -> None:
    assert RING.evaluate(RING.number(Fraction(1, 2)), {}) == inverse(2)
