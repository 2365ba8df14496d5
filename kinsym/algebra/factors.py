"""The factors of a polynomial in cosines, sines, lengths and parameters.

Factors in half angles are unique (:mod:`kinsym.algebra.half_angle`); those of odd degree are joined to the shortest
products that are polynomials in cosines and sines. That the factors multiply to what was given is proved in the ring.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import combinations

from kinsym.algebra.half_angle import HalfAngles, Piece
from kinsym.algebra.ring import Poly, Ring

#: A polynomial with more terms in half angles than this is not factored: its time would not be bounded.
LARGEST = 120


@dataclass(frozen=True)
class Factored:
    """``constant`` times the powers of the ``factors``, which hold a cosine, a sine or a prismatic variable each.

    ``fixed`` are the factors of ``constant``; ``complete`` tells that no factor can be split further.
    """

    constant: Poly
    fixed: tuple[Poly, ...]
    factors: tuple[tuple[Poly, int], ...]
    complete: bool


def factored(ring: Ring, polys: list[Poly]) -> Factored:
    """The factors of a product.

    >>> from kinsym.algebra.ring import Generator, Kind
    >>> ring = Ring([Generator("c1", Kind.COSINE), Generator("s1", Kind.SINE, "c1"), Generator("a", Kind.PARAMETER)])
    >>> c, s, a = ring["c1"], ring["s1"], ring["a"]
    >>> factored(ring, [ring.reduce(2 * a * s * (a * c + s))])
    Factored(constant=2*a, fixed=(a,), factors=((c1*a + s1, 1), (s1, 1)), complete=True)
    """
    counts: Counter[Poly] = Counter()
    complete = True
    constant = ring.one
    for poly in polys:
        monomial, rest = _monomial(ring, poly)
        found = [*monomial]
        if len(rest) > 1:
            pieces = _irreducible(ring, rest)
            complete &= pieces is not None
            found += pieces if pieces is not None else [rest]
        product = ring.one
        for factor in found:
            product = ring.mul(product, factor)
        constant = ring.mul(constant, _quotient(ring, poly, product))
        counts.update(found)
    fixed = [factor for factor in counts if ring.is_constant(factor)]
    for factor in fixed:
        constant = ring.mul(constant, ring.reduce(factor ** counts.pop(factor)))
    return Factored(constant, tuple(fixed), tuple(counts.items()), complete)


def _quotient(ring: Ring, whole: Poly, product: Poly) -> Poly:
    """The number by which a polynomial differs from the product of its factors, as a proof that there is one."""
    number = ring.ring.ground_new(whole.LC / product.LC)
    if whole != product * number:
        raise ArithmeticError("the factors of a polynomial do not multiply to it")
    return number


def _monomial(ring: Ring, poly: Poly) -> tuple[list[Poly], Poly]:
    """The generators that divide every term, repeated, and what is left."""
    common = [min(exponents) for exponents in zip(*poly, strict=True)]
    rest = ring.ring.zero
    for monomial, coefficient in poly.terms():
        rest[tuple(e - low for e, low in zip(monomial, common, strict=True))] = coefficient
    found = [ring[g.name] for g, exponent in zip(ring.generators, common, strict=True) for _ in range(exponent)]
    return found, rest


def _irreducible(ring: Ring, poly: Poly) -> list[Poly] | None:
    half = HalfAngles(ring, poly)
    whole = half.homogeneous(poly)
    if len(whole.poly) > LARGEST:
        return None
    pieces = half.factors(whole)
    even = [piece for piece in pieces if not any(piece.parity)]
    odd = [piece for piece in pieces if any(piece.parity)]
    groups = [[piece] for piece in even] + _joined(half, odd)
    found = [half.back(half.product(group)) for group in groups]
    return [_primitive(ring, factor) for factor in found]


def _joined(half: HalfAngles, odd: list[Piece]) -> list[list[Piece]]:
    """Pieces of odd degree in groups of even degree: the smallest groups, among them the shortest."""
    groups: list[list[Piece]] = []
    size = 2
    while odd:
        choices = []
        for places in combinations(range(len(odd)), size):
            group = [odd[place] for place in places]
            product = half.product(group)
            if not any(product.parity):
                choices.append((len(half.back(product)), places))
        if not choices:
            size += 1
            continue
        _, places = min(choices)
        groups.append([odd[place] for place in places])
        odd = [piece for place, piece in enumerate(odd) if place not in places]
    return groups


def _primitive(ring: Ring, poly: Poly) -> Poly:
    """The polynomial with whole coefficients without a common divisor, the first of them positive."""
    primitive = poly.clear_denoms()[1].primitive()[1]
    return -primitive if primitive.LC < 0 else primitive
