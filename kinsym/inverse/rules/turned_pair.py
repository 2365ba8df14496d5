"""Two equations that state one vector, turned by an unknown angle: how such pairs are found and compared.

``a c + b s`` is a component of the vector (a, b) turned by the angle of (c, s). Two of them state the whole turned
vector if their (a, b) keep their angle and the ratio of their lengths whatever the other unknowns are. That is tested
at two points modulo the prime that share the constants, then proved in the ring.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.ring import Kind, Poly, Ring
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

CONSTANTS = (Kind.CONSTANT, Kind.PARAMETER)

Line = tuple[Poly, Poly, Poly]
"""``p c_y + q s_y + r``; where the other unknown is a length, ``p + q d + r d^2``."""
Eliminant = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Side:
    """X or Y: ``rest / scale``; ``weights`` are the factors and units of the pool's equations in it."""

    rest: Line
    scale: Poly
    weights: tuple[tuple[Poly, int], ...]


@dataclass(frozen=True)
class Pair:
    """``k1 c + k2 s = X`` and ``k1 s - k2 c = Y`` for the angle that is turned; the other is an angle or a length."""

    turned: Angle
    other: Angle | str
    k1: Line
    k2: Line
    sides: tuple[Side, Side]
    equations: tuple[PoolEquation, PoolEquation]

    @property
    def terms(self) -> int:
        """The number of terms of everything that the step computes with."""
        parts = [*self.k1, *self.k2]
        for side in self.sides:
            parts += [*side.rest, side.scale, *(weight for weight, _ in side.weights)]
        return sum(map(len, parts))


@dataclass(frozen=True)
class Form:
    """An equation ``a c + b s + rest = 0``; ``values`` are (a, b) at two points with the same constants."""

    line: Line
    equation: PoolEquation
    values: tuple[tuple[int, int], tuple[int, int]]


def shared_points(state: State) -> tuple[dict[str, int], dict[str, int]]:
    """Two random points modulo the prime that share the constants and parameters."""
    first, second = state.samples[:2]
    constants = [g.name for g in state.chain.ring.generators if g.kind in CONSTANTS]
    return first, {**second, **{name: first[name] for name in constants}}


def turned_form(
    state: State, equation: PoolEquation, turned: Angle, points: tuple[dict[str, int], dict[str, int]]
) -> Form | None:
    """An equation by the cosine and sine of the turned angle, or None if it is not linear in them or lacks them."""
    ring = state.chain.ring
    line = _linear(ring, equation.poly, turned)
    if line is None:
        return None
    first, second = ((ring.evaluate(line[0], point), ring.evaluate(line[1], point)) for point in points)
    return Form(line, equation, (first, second)) if any(first) and any(second) else None


def promising(first: Form, second: Form) -> bool:
    """Whether the two vectors keep their angle and the ratio of their lengths from point to point."""
    ratios = set()
    for (a1, b1), (a2, b2) in zip(first.values, second.values, strict=True):
        squared = (a2 * a2 + b2 * b2) % PRIME
        if not squared:
            return False
        scale = inverse(squared)
        ratios.add(((a1 * a2 + b1 * b2) * scale % PRIME, (a1 * b2 - b1 * a2) * scale % PRIME))
    return len(ratios) == 1


def turned_pair(state: State, turned: Angle, other: Angle | str, one: Form, two: Form) -> Pair | None:
    """The two equations as a turned vector, or None if they are none."""
    ring = state.chain.ring
    first, second = one.equation, two.equation
    (a1, b1, rest1), (a2, b2, rest2) = one.line, two.line
    # Less of the second so that the two vectors are orthogonal: r without the part of z that d1 brings in.
    weights = [(ring.one, first.unit)]
    if along := ring.dot((a1, b1), (a2, b2)):
        ratio = _ratio(ring, along, ring.dot((a2, b2), (a2, b2)))
        if ratio is None:
            return None
        above, below = ratio
        weights = [(below, first.unit), (above, second.unit)]
        a1, b1, rest1 = (ring.mul(below, x) - ring.mul(above, y) for x, y in zip(one.line, two.line, strict=True))
    ratio = _ratio(ring, b2, a1) if a1 else _ratio(ring, -a2, b1)
    if ratio is None:
        return None
    above, below = ratio
    if ring.mul(below, b2) != ring.mul(above, a1) or ring.mul(below, a2) != -ring.mul(above, b1):
        return None
    k1, k2, scale = a1, b1, ring.one
    (quotient1, remainder1), (quotient2, remainder2) = a1.div(below), b1.div(below)
    if not remainder1 and not remainder2:
        # Both left sides are constants times the same vector, as 2 a1 and s alpha1 in Pieper's.
        k1, k2, scale, below = quotient1, quotient2, below, ring.one
    if state.vanishes(k1) and state.vanishes(k2):
        return None
    lines = [_line(ring, poly, other) for poly in (k1, k2, -rest1, -ring.mul(below, rest2))]
    l1, l2, r1, r2 = lines
    if l1 is None or l2 is None or r1 is None or r2 is None:
        return None
    sides = (Side(r1, scale, tuple(weights)), Side(r2, above, ((below, second.unit),)))
    return Pair(turned, other, l1, l2, sides, (first, second))


def _line(ring: Ring, poly: Poly, unknown: Angle | str) -> Line | None:
    """A polynomial in the other unknown, or None if its degree is too high."""
    if isinstance(unknown, Angle):
        return _linear(ring, poly, unknown)
    parts = ring.collect(poly, (unknown,))
    if not set(parts) <= {(0,), (1,), (2,)}:
        return None
    return parts.get((0,), ring.zero), parts.get((1,), ring.zero), parts.get((2,), ring.zero)


def _linear(ring: Ring, poly: Poly, angle: Angle) -> Line | None:
    """A polynomial as ``a c + b s + e``, or None if it is not linear in them."""
    parts = ring.collect(poly, (angle.cosine, angle.sine))
    if not set(parts) <= {(1, 0), (0, 1), (0, 0)}:
        return None
    return parts.get((1, 0), ring.zero), parts.get((0, 1), ring.zero), parts.get((0, 0), ring.zero)


def _ratio(ring: Ring, above: Poly, below: Poly) -> tuple[Poly, Poly] | None:
    """The constants n and d with above/below = n/d if there are any; the caller tests that it is so everywhere."""
    if not above or not below:
        return None
    used = dict.fromkeys((*ring.used(above), *ring.used(below)))
    varying = [name for name in used if ring.generators[ring.index[name]].kind not in CONSTANTS]
    parts, others = ring.collect(below, varying), ring.collect(above, varying)
    key = max(parts)
    if key not in others:
        return None
    n, d = others[key].cancel(parts[key])
    return n, d


def eliminant_of(state: State, pair: Pair) -> Eliminant:
    """X^2 + Y^2 - k1^2 - k2^2 up to a factor: its coefficients of c^2, c s, c, s, 1 at the random points."""
    lines = (*(side.rest for side in pair.sides), pair.k1, pair.k2)
    values = [[state.values(part) for part in line] for line in lines]
    scales = zip(*(state.values(side.scale) for side in pair.sides), strict=True)
    result = []
    for point, (m1, m2) in enumerate(scales):
        weights = (m2 * m2, m1 * m1, -m1 * m1 * m2 * m2, -m1 * m1 * m2 * m2)
        total = [0, 0, 0, 0, 0]
        for weight, line in zip(weights, values, strict=True):
            p, q, r = (part[point] for part in line)
            for place, product in enumerate((p * p - q * q, 2 * p * q, 2 * p * r, 2 * q * r, q * q + r * r)):
                total[place] += weight * product
        result.append(tuple(coefficient % PRIME for coefficient in total))
    return tuple(result)


def proportional(first: Eliminant, second: Eliminant) -> bool:
    """Whether two eliminations say the same of the other angle."""
    return all(
        (a * d - b * c) % PRIME == 0
        for one, two in zip(first, second, strict=True)
        for (a, c), (b, d) in combinations(list(zip(one, two, strict=True)), 2)
    )


def own_vector(ring: Ring, pair: Pair) -> bool:
    """Whether k1 and k2 depend on the other angle and not on the pose."""
    parts = (*pair.k1, *pair.k2)
    kinds = {ring.generators[ring.index[name]].kind for part in parts for name in ring.used(part)}
    return Kind.POSE not in kinds and any((*pair.k1[:2], *pair.k2[:2]))
