"""Polynomials in cosines and sines as polynomials in the tangents of half the angles, where factors are unique.

Modulo c^2 + s^2 = 1 a polynomial can have several factorisations: s^2 = (1 - c)(1 + c). With x and y the cosine and
sine of half the angle, c = x^2 - y^2, s = 2xy and 1 = x^2 + y^2, it becomes homogeneous in x and y, and those
factor in one way only. Homogeneous factors of even degree are polynomials in c and s again; factors of odd degree
(x, y, x - y) come in pairs: s = 2xy, c = (x - y)(x + y), 1 + c = 2x^2.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from kinsym.algebra.ring import Poly, Ring


@dataclass(frozen=True)
class Piece:
    """An irreducible factor: ``poly`` with x = 1, and its true degree in each angle's x and y."""

    poly: Poly
    degrees: tuple[int, ...]

    @property
    def parity(self) -> tuple[int, ...]:
        """Which angles occur in an odd degree."""
        return tuple(degree % 2 for degree in self.degrees)


class HalfAngles:
    """The half angles of the circles that occur in one polynomial of a ring.

    >>> from kinsym.algebra.ring import Generator, Kind
    >>> ring = Ring([Generator("c1", Kind.COSINE), Generator("s1", Kind.SINE, "c1")])
    >>> half = HalfAngles(ring, ring["s1"])
    >>> whole = half.homogeneous(ring["s1"])
    >>> [piece.degrees for piece in half.factors(whole)], half.back(whole)
    ([(1,), (1,)], 2*s1)
    """

    def __init__(self, ring: Ring, poly: Poly) -> None:
        self._source = ring
        used = set(ring.used(poly))
        pairs = [(g.square, g.name) for g in ring.generators if isinstance(g.square, str)]
        self.circles = [(c, s) for c, s in pairs if c in used or s in used]
        on_circles = {name for pair in self.circles for name in pair}
        self._others = [name for name in ring.used(poly) if name not in on_circles]
        self._ring = PolyRing([f"tan_{c}" for c, _ in self.circles] + self._others, QQ, lex)

    def homogeneous(self, poly: Poly) -> Piece:
        """A polynomial of the ring in half angles."""
        source, ring = self._source, self._ring
        places = [(source.index[c], source.index[s]) for c, s in self.circles]
        others = [source.index[name] for name in self._others]
        high = [max(monomial[i] + monomial[j] for monomial in poly) for i, j in places]
        total = ring.zero
        for monomial, coefficient in poly.terms():
            term = ring.term_new((0,) * len(places) + tuple(monomial[i] for i in others), coefficient)
            for y, (i, j), degree in zip(ring.gens, places, high, strict=False):
                c, s = monomial[i], monomial[j]
                term *= (1 - y**2) ** c * (2 * y) ** s * (1 + y**2) ** (degree - c - s)
            total += term
        return Piece(total, tuple(2 * degree for degree in high))

    def factors(self, whole: Piece) -> list[Piece]:
        """The irreducible factors of a homogeneous polynomial, as often as they divide it; numbers are left out."""
        found = []
        for poly, power in self._irreducible(whole.poly):
            found += [Piece(poly, tuple(poly.degree(place) for place in range(len(self.circles))))] * power
        for place, degree in enumerate(whole.degrees):
            unit = tuple(int(k == place) for k in range(len(self.circles)))
            missing = degree - sum(piece.degrees[place] for piece in found)
            found += [Piece(self._ring.one, unit)] * missing
        return found

    def _irreducible(self, poly: Poly) -> list[tuple[Poly, int]]:
        """The irreducible factors with their powers.

        A polynomial a x + b is irreducible if a and b have no common factor, so most need but a common divisor.
        """
        first = len(self.circles)
        for place in range(first, first + len(self._others)):
            if poly.degree(place) == 1:
                parts = [self._ring.zero, self._ring.zero]
                for monomial, coefficient in poly.terms():
                    rest = (*monomial[:place], 0, *monomial[place + 1 :])
                    parts[monomial[place]][rest] = coefficient
                common = parts[0].gcd(parts[1])
                return [*common.factor_list()[1], (poly.quo(common), 1)]
        return list(poly.factor_list()[1])

    def product(self, pieces: list[Piece]) -> Piece:
        """The product of pieces."""
        poly = self._ring.one
        for piece in pieces:
            poly *= piece.poly
        return Piece(poly, tuple(map(sum, zip(*(piece.degrees for piece in pieces), strict=True))))

    def back(self, piece: Piece) -> Poly:
        """A homogeneous polynomial of even degrees in cosines and sines, up to a positive number."""
        source = self._source
        total = source.zero
        count = len(self.circles)
        for monomial, coefficient in piece.poly.terms():
            term = source.ring.ground_new(coefficient)
            for (c, s), exponent, degree in zip(self.circles, monomial, piece.degrees, strict=False):
                x, y = degree - exponent, exponent
                # x^2 = (1 + c)/2, y^2 = (1 - c)/2, x y = s/2; the halves are left out, there are as many in each term
                term *= (1 + source[c]) ** (x // 2) * (1 - source[c]) ** (y // 2) * (source[s] if x % 2 else source.one)
            for name, exponent in zip(self._others, monomial[count:], strict=True):
                term *= source[name] ** exponent
            total += source.reduce(term)
        return source.reduce(total)
