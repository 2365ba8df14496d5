"""The constants of a table as generators of the ring.

Cells hold lengths and angles. A length becomes a polynomial in the parameters; what is no polynomial (sqrt(2), pi)
becomes a named constant. An angle that is a multiple of pi/2 is exact; any other twist or offset gets a cosine and a
sine of its own, as Pieper's equations in the lecture need (c alpha1, s alpha1).
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType

from sympy import Add, Expr, Integer, Mul, Rational, Symbol, cos, factorint, pi, sin, sqrt
from sympy.ntheory import sqrt_mod

from kinsym.algebra.field import PRIME, Point, angle_point, circle_point, turn
from kinsym.algebra.ring import Generator, Kind, Poly, Ring, fraction
from kinsym.robot.expressions import symbol


@dataclass
class Constants:
    """Collects the constants of a table first, then turns cells into polynomials of the finished ring."""

    parameters: list[str]
    derived: dict[Expr, str] = field(default_factory=dict)
    angles: dict[Expr, str] = field(default_factory=dict)
    entries: dict[str, tuple[Ring, Poly]] = field(default_factory=dict)

    def note_length(self, cell: Expr) -> None:
        """Register whatever a length cell needs."""
        for term in Add.make_args(cell.expand()):
            for factor in _factors(term):
                angle = _angle_of(factor)
                if angle is not None:
                    self.note_angle(angle, f"angle{len(self.angles) + 1}")
                elif not _polynomial(factor) and factor not in self.derived:
                    self.derived[factor] = f"const{len(self.derived) + 1}"

    def note_angle(self, cell: Expr, name: str) -> None:
        """Register the cosine and sine of an angle cell under a name such as ``alpha1``."""
        generic, _, _ = split_angle(cell)
        if generic != 0 and generic not in self.angles:
            text = str(generic)
            chosen = text if isinstance(generic, Symbol) else name
            taken = set(self.angles.values())
            while chosen in taken:
                chosen += "_"
            self.angles[generic] = chosen

    def note_held(self, cell: Expr, label: str) -> None:
        """Register the cosine and sine of a locked joint under the label of its angle: c3, s3, signs and all."""
        if split_angle(cell)[0] != 0:
            self.angles.setdefault(cell, label)

    def note_entry(self, ring: Ring, poly: Poly, name: str) -> None:
        """Give an entry of the base or of the tool a name of its own if it is more than a number or a parameter."""
        if len(poly) > 1 or (poly and not poly.is_ground and ring.used(poly)[0] not in self.parameters):
            self.entries[name] = ring, poly

    def generators(self) -> list[Generator]:
        """The generators of everything registered, then the parameters that occur as lengths."""
        result: list[Generator] = []
        for name in self.angles.values():
            result.append(Generator("c" + name, Kind.CONSTANT))
            result.append(Generator("s" + name, Kind.CONSTANT, "c" + name))
        for expression, name in self.derived.items():
            # SymPy takes fractions out of a root: sqrt(2/3) is sqrt(6)/3
            squared = expression**2
            square = Fraction(int(squared)) if isinstance(squared, Integer) else None
            result.append(Generator(name, Kind.CONSTANT, square))
        result.extend(Generator(name, Kind.CONSTANT) for name in self.entries)
        result.extend(Generator(name, Kind.PARAMETER) for name in self.parameters)
        return result

    def length(self, ring: Ring, cell: Expr) -> Poly:
        """A length cell as a polynomial."""
        total = ring.zero
        for term in Add.make_args(cell.expand()):
            product = ring.one
            for factor in _factors(term):
                product *= self._factor(ring, factor)
            total += product
        return ring.reduce(total)

    def _factor(self, ring: Ring, factor: Expr) -> Poly:
        if factor in self.derived:
            return ring[self.derived[factor]]
        if isinstance(factor, Rational):
            return ring.number(Fraction(int(factor.p), int(factor.q)))
        if isinstance(factor, Symbol):
            return ring[factor.name]
        base, exponent = factor.as_base_exp()
        angle = _angle_of(factor)
        if angle is not None:
            return self.angle(ring, angle)[isinstance(base, sin)] ** int(exponent)
        return ring[base.name] ** int(exponent)

    def angle(self, ring: Ring, cell: Expr) -> tuple[Poly, Poly]:
        """The cosine and sine of an angle cell."""
        generic, sign, quarters = split_angle(cell)
        if generic == 0:
            c, s = ring.one, ring.zero
        else:
            name = self.angles[generic]
            c, s = ring["c" + name], ring["s" + name] * sign
        for _ in range(quarters):
            c, s = -s, c
        return c, s

    def held(self, ring: Ring, cell: Expr) -> tuple[Poly, Poly]:
        """The cosine and sine of a locked joint."""
        if split_angle(cell)[0] == 0:
            return self.angle(ring, cell)
        return ring["c" + self.angles[cell]], ring["s" + self.angles[cell]]

    def formulas(self) -> list[tuple[str, Expr]]:
        """Each constant with its expression over the parameters, in an order that can be computed."""
        result: list[tuple[str, Expr]] = []
        for expression, name in self.angles.items():
            result += [("c" + name, cos(expression, evaluate=False)), ("s" + name, sin(expression, evaluate=False))]
        result.extend((name, expression) for expression, name in self.derived.items())
        result.extend((name, self.expression(ring, poly)) for name, (ring, poly) in self.entries.items())
        return result

    def expression(self, ring: Ring, poly: Poly) -> Expr:
        """A polynomial in constants and parameters as a cell."""
        cells: dict[str, Expr] = {name: expression for expression, name in self.derived.items()}
        for expression, name in self.angles.items():
            cells["c" + name], cells["s" + name] = cos(expression), sin(expression)
        cells |= {name: self.expression(*entry) for name, entry in self.entries.items() if name in ring}
        terms = []
        for monomial, coefficient in poly.terms():
            value = fraction(coefficient)
            factors = [
                (cells[g.name] if g.name in cells else symbol(g.name)) ** exponent
                for g, exponent in zip(ring.generators, monomial, strict=True)
                if exponent
            ]
            terms.append(Mul(Rational(value.numerator, value.denominator), *factors))
        return Add(*terms)

    def sample(self, generator: random.Random, given: Mapping[str, int] = MappingProxyType({})) -> dict[str, int]:
        """Values modulo the prime: as given, exact where the field holds them, random points otherwise.

        ``given`` may hold parameters, and the cosine and the sine of an angle.
        """
        values = {name: given.get(name, generator.randrange(1, PRIME)) for name in self.parameters}
        for expression, name in self.angles.items():
            c, s = _angle_value(expression, generator)
            values["c" + name], values["s" + name] = given.get("c" + name, c), given.get("s" + name, s)
        for expression, name in self.derived.items():
            values[name] = _derived_value(expression, generator)
        for name, (ring, poly) in self.entries.items():
            values[name] = ring.evaluate(poly, values)
        return values


def _factors(term: Expr) -> Iterator[Expr]:
    """The factors of a term; the root of a product of primes as the roots of these, so that one relation holds each."""
    for factor in Mul.make_args(term):
        base, exponent = factor.as_base_exp()
        if isinstance(base, Integer) and base > 1 and exponent == Rational(1, 2):
            for prime, power in sorted(factorint(base).items()):
                yield sqrt(prime) ** power
        else:
            yield factor


def _angle_of(factor: Expr) -> Expr | None:
    """The angle of a power of a cosine or sine."""
    base, exponent = factor.as_base_exp()
    if isinstance(base, (cos, sin)) and isinstance(exponent, Integer) and int(exponent) > 0:
        return base.args[0]
    return None


def _polynomial(factor: Expr) -> bool:
    if isinstance(factor, (Rational, Symbol)):
        return True
    base, exponent = factor.as_base_exp()
    return isinstance(base, Symbol) and isinstance(exponent, Integer) and int(exponent) > 0


def split_angle(cell: Expr) -> tuple[Expr, int, int]:
    """An angle as ``sign * generic + quarters * pi/2`` with generic 0 or of canonical sign.

    >>> split_angle(pi / 2 - Symbol("b"))
    (b, -1, 1)
    """
    expanded = cell.expand()
    turns = expanded.coeff(pi) if expanded.has(pi) else Integer(0)
    rest = expanded - turns * pi
    if not isinstance(turns, Rational):
        return _canonical(expanded, 0)
    quarters = int((2 * turns) // 1)
    remainder = (turns - Rational(quarters, 2)) * pi
    return _canonical(rest + remainder, quarters % 4)


def _canonical(generic: Expr, quarters: int) -> tuple[Expr, int, int]:
    if generic.could_extract_minus_sign():
        return -generic, -1, quarters
    return generic, 1, quarters


def _derived_value(expression: Expr, generator: random.Random) -> int:
    """A derived constant: the root of a number where the field has it, else any value."""
    squared = expression**2
    root = sqrt_mod(int(squared), PRIME) if isinstance(squared, Integer) else None
    return generator.randrange(1, PRIME) if root is None else int(root)


def _angle_value(expression: Expr, generator: random.Random) -> Point:
    """A point of the circle for an angle; multiples of pi/2520 are exact, sums follow from their terms."""
    total: Point = (1, 0)
    for term in Add.make_args(expression):
        multiple = term / pi
        exact = None
        if isinstance(multiple, Rational):
            exact = angle_point(Fraction(int(multiple.p), int(multiple.q)))
        total = turn(total, exact if exact is not None else circle_point(generator))
    return total
