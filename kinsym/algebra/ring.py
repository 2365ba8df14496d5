"""The polynomial ring of one arm.

Inside kinsym everything is a polynomial over the rationals in the cosines and sines of joint angles and of their sums,
the prismatic variables, the twelve entries of the pose, the constants of the table and the parameters. The ring
knows which generators square to something simpler (s^2 = 1 - c^2, sqrt(2)^2 = 2) and reduces to normal form.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Any, TypeAlias

from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from kinsym.algebra.field import PRIME, residue

Poly: TypeAlias = Any
"""A ``sympy.polys.rings.PolyElement``; SymPy's annotations do not cover its arithmetic."""
Vector = tuple[Poly, Poly, Poly]
Rotation = tuple[Vector, Vector, Vector]

POSE_ENTRIES = tuple(f"{column}_{row}" for column in "uvwp" for row in "xyz")


class Kind(Enum):
    """What a generator stands for."""

    COSINE = "cosine of a joint angle"
    SINE = "sine of a joint angle"
    LENGTH = "prismatic variable"
    POSE = "entry of the pose"
    CONSTANT = "constant"
    PARAMETER = "parameter"


@dataclass(frozen=True)
class Generator:
    """A generator; ``square`` is what its square reduces to: a number, or the name of the cosine it belongs to."""

    name: str
    kind: Kind
    square: Fraction | str | None = None


class Ring:
    """Polynomials over the rationals in named generators, reduced to normal form.

    >>> ring = Ring([Generator("c1", Kind.COSINE), Generator("s1", Kind.SINE, "c1")])
    >>> ring.reduce(ring["c1"] ** 2 + ring["s1"] ** 2)
    1
    """

    def __init__(self, generators: Iterable[Generator]) -> None:
        self.generators = tuple(generators)
        self.ring = PolyRing([g.name for g in self.generators], QQ, lex)
        self._names = [g.name for g in self.generators]
        self.index = {name: i for i, name in enumerate(self._names)}
        self.zero: Poly = self.ring.zero
        self.one: Poly = self.ring.one
        self._squares: dict[int, Poly] = {}
        for position, generator in enumerate(self.generators):
            if isinstance(generator.square, str):
                self._squares[position] = self.one - self[generator.square] ** 2
            elif generator.square is not None:
                self._squares[position] = self.number(generator.square)

    def __getitem__(self, name: str) -> Poly:
        return self.ring.gens[self.index[name]]

    def __contains__(self, name: str) -> bool:
        return name in self.index

    def number(self, value: Fraction | int) -> Poly:
        """A constant polynomial."""
        value = Fraction(value)
        return self.ring.ground_new(QQ(value.numerator, value.denominator))

    def reduce(self, poly: Poly) -> Poly:
        """The normal form: no generator with a known square occurs to a power above one."""
        squares = self._squares
        while squares and poly and max(map(max, poly)) > 1:
            result = self.ring.zero
            changed = False
            for monomial, coefficient in poly.items():
                high = () if max(monomial) < 2 else [i for i in squares if monomial[i] > 1]
                if not high:
                    _add_term(result, monomial, coefficient)
                    continue
                changed = True
                rest = list(monomial)
                factor = self.one
                for i in high:
                    rest[i] = monomial[i] % 2
                    factor *= squares[i] ** (monomial[i] // 2)
                for shifted, product in factor.mul_term((tuple(rest), coefficient)).items():
                    _add_term(result, shifted, product)
            if not changed:
                break
            poly = result
        return poly

    def mul(self, left: Poly, right: Poly) -> Poly:
        """The reduced product."""
        if not left or not right:
            return self.zero
        return self.reduce(left * right)

    def dot(self, left: Sequence[Poly], right: Sequence[Poly]) -> Poly:
        """The reduced sum of products."""
        total = None
        for x, y in zip(left, right, strict=True):
            if x and y:
                product = y if x is self.one else x if y is self.one else x * y
                total = product if total is None else total + product
        return self.zero if total is None else self.reduce(total)

    def used(self, poly: Poly) -> tuple[str, ...]:
        """The names of the generators that occur, in the order of the ring."""
        return tuple(self._names[i] for i, exponents in enumerate(zip(*poly, strict=True)) if any(exponents))

    def collect(self, poly: Poly, names: Sequence[str]) -> dict[tuple[int, ...], Poly]:
        """The coefficients of the monomials in some generators; keys are exponents in the order of ``names``."""
        positions = [self.index[name] for name in names]
        parts: dict[tuple[int, ...], Poly] = {}
        for monomial, coefficient in poly.terms():
            key = tuple(monomial[i] for i in positions)
            rest = list(monomial)
            for i in positions:
                rest[i] = 0
            part = parts.get(key)
            if part is None:
                part = parts[key] = self.ring.zero
            part[tuple(rest)] = coefficient
        return parts

    def evaluate(self, poly: Poly, values: Mapping[str, int]) -> int:
        """The value modulo PRIME; ``values`` holds every generator that occurs."""
        total = 0
        for monomial, coefficient in poly.items():
            term = residue(fraction(coefficient))
            for i, exponent in enumerate(monomial):
                if exponent:
                    value = values[self.generators[i].name]
                    term = term * (value if exponent == 1 else pow(value, exponent, PRIME)) % PRIME
            total += term
        return total % PRIME

    def is_constant(self, poly: Poly) -> bool:
        """Whether only constants of the table and parameters occur."""
        kinds = {Kind.CONSTANT, Kind.PARAMETER}
        return all(self.generators[self.index[name]].kind in kinds for name in self.used(poly))


def _add_term(poly: Poly, monomial: tuple[int, ...], coefficient: Any) -> None:
    """Add one term in place."""
    total = poly.get(monomial, 0) + coefficient
    if total:
        poly[monomial] = total
    else:
        poly.pop(monomial, None)


def fraction(coefficient: object) -> Fraction:
    """A coefficient as a Fraction, whichever library holds it."""
    return Fraction(int(coefficient.numerator), int(coefficient.denominator))  # type: ignore[attr-defined]


def matmul(ring: Ring, left: Rotation, right: Rotation) -> Rotation:
    """The product of two 3x3 matrices."""
    columns = tuple(zip(*right, strict=True))
    return tuple(tuple(ring.dot(row, column) for column in columns) for row in left)  # type: ignore[return-value]


def apply(ring: Ring, matrix: Rotation, vector: Vector) -> Vector:
    """A matrix times a column."""
    return tuple(ring.dot(row, vector) for row in matrix)


def transpose(matrix: Rotation) -> Rotation:
    """The transpose."""
    return tuple(zip(*matrix, strict=True))  # type: ignore[return-value]


def plus(left: Vector, right: Vector) -> Vector:
    """The sum of two columns."""
    return left[0] + right[0], left[1] + right[1], left[2] + right[2]


def minus(vector: Vector) -> Vector:
    """The opposite column."""
    return -vector[0], -vector[1], -vector[2]


def identity(ring: Ring) -> Rotation:
    """The unit matrix."""
    one, zero = ring.one, ring.zero
    return (one, zero, zero), (zero, one, zero), (zero, zero, one)
