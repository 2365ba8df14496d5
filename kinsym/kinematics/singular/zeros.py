"""Random postures at which a polynomial of an arm vanishes, modulo the prime.

One angle, or one length, is solved for: its cosine and sine are rational in the tangent of half of it, so the
polynomial becomes one in a single unknown, and its roots in the field are exact.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction

from kinsym.algebra.field import PRIME, Point, circle_point, inverse, turn
from kinsym.algebra.ring import Kind, Poly
from kinsym.algebra.roots import roots
from kinsym.algebra.tree import ZERO, Num, Pi, Sym, Tree, mul
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.angle_sums import Edges, path, spanning_trees
from kinsym.kinematics.singular.posture import Posture, posture

#: About every second try has a root in the field.
TRIES = 40
#: Cosine and sine of 0, pi/2, pi and -pi/2.
QUARTERS: tuple[Point, ...] = ((1, 0), (0, 1), (PRIME - 1, 0), (0, PRIME - 1))


@dataclass(frozen=True)
class Part:
    """A part of the set on which a polynomial vanishes.

    Where the polynomial is one cosine or sine its zeros are two angles, and ``quarters`` times pi/2 is this one;
    ``variable`` is then the name of the angle, or of the prismatic variable that is zero.
    """

    poly: Poly
    variable: str = ""
    quarters: int = 0

    @property
    def relation(self) -> tuple[Tree, str, Tree] | None:
        """``theta5 = pi`` or ``d3 = 0``, None where the part is not the value of a joint."""
        if not self.variable:
            return None
        half = Num(Fraction(-1 if self.quarters == 3 else self.quarters, 2))
        return Sym(self.variable), "=", mul(half, Pi()) if self.quarters else ZERO


Zero = tuple[Part, ...]
"""Parts that meet; all but the last of them are given values of a joint."""


def parts(chain: Chain, poly: Poly) -> tuple[Part, ...]:
    """The parts of a factor's zeros: ``s5 = 0`` is theta5 = 0 and theta5 = pi."""
    ring = chain.ring
    for angle in chain.angles.values():
        for name, turns in ((angle.sine, (0, 2)), (angle.cosine, (1, 3))):
            if name in ring and poly == ring[name]:
                return tuple(Part(poly, angle.name, quarters) for quarters in turns)
    for joint in chain.joints:
        if joint.kind == "P" and poly == ring[joint.variable]:
            return (Part(poly, joint.variable),)
    return (Part(poly),)


def postures(chain: Chain, zero: Zero, count: int) -> list[Posture]:
    """Random postures at which all parts meet, ``count`` of them or, where the field has no root, fewer."""
    trees = _trees(chain, zero)
    found: list[Posture] = []
    for number in range(TRIES):
        if len(found) == count:
            break
        generator = random.Random(f"zeros {number}")
        values = chain.sample(generator)
        points = {edge: circle_point(generator) for edge in sorted(trees)}
        solved = _solved(chain, zero, values, points, number)
        if solved is not None:
            found.append(posture(chain, solved))
    return found


def somewhere(chain: Chain, count: int) -> list[Posture]:
    """Random postures."""
    return [posture(chain, chain.sample(random.Random(f"somewhere {number}"))) for number in range(count)]


_Edge = tuple[int, int, int]


def _trees(chain: Chain, zero: Zero) -> dict[_Edge, Angle]:
    """Independent angles of every group, those of the polynomials among them."""
    used = {name for part in zero for name in chain.ring.used(part.poly)}
    chosen: dict[_Edge, Angle] = {}
    for group in chain.groups:
        own = {(low, high): angle for (g, low, high), angle in chain.angles.items() if g == group.index}
        wanted = {edge for edge, angle in own.items() if {angle.cosine, angle.sine} & used}
        for edges in spanning_trees(group):
            if wanted <= set(edges):
                chosen |= {(group.index, *edge): own[edge] for edge in edges}
                break
    return chosen


def _solved(
    chain: Chain, zero: Zero, values: dict[str, int], points: dict[_Edge, Point], number: int
) -> dict[str, int] | None:
    """Values of all generators with the polynomials zero, or None if the field has no root."""
    angles = chain.angles
    given = [part for part in zero if part.variable]
    fixed = {part.variable for part in given}
    for part in given:
        if part.variable in values:
            values[part.variable] = 0
        else:
            points[_edges(chain, part.poly, points)[0]] = QUARTERS[part.quarters]
    for edge, (c, s) in points.items():
        values[angles[edge].cosine], values[angles[edge].sine] = c, s
    for part in zero[len(given) :]:
        lengths = [name for name in _lengths(chain, part.poly) if name not in fixed]
        edges = [edge for edge in _edges(chain, part.poly, points) if angles[edge].name not in fixed]
        if not edges and not lengths:
            return None
        unknowns: list[str | _Edge] = [*edges, *lengths]
        unknown = unknowns[number % len(unknowns)]
        if isinstance(unknown, str):
            found = roots(_in_length(chain, part.poly, unknown, values))
            if not found:
                return None
            values[unknown] = found[0]
        else:
            point = _point(roots(_in_angle(chain, part.poly, angles[unknown], values)))
            if point is None:
                return None
            points[unknown] = point
    return {**values, **_intervals(chain, points)}


def _point(tangents: list[int]) -> Point | None:
    """The point of the circle with the first of these tangents of half its angle that has one."""
    for y in tangents:
        if scale := (1 + y * y) % PRIME:
            return (1 - y * y) * inverse(scale) % PRIME, 2 * y * inverse(scale) % PRIME
    return None


def _edges(chain: Chain, poly: Poly, points: dict[_Edge, Point]) -> list[_Edge]:
    """The independent angles that occur in a polynomial."""
    used = set(chain.ring.used(poly))
    return [edge for edge in points if {chain.angles[edge].cosine, chain.angles[edge].sine} & used]


def _lengths(chain: Chain, poly: Poly) -> list[str]:
    """The prismatic variables that occur in a polynomial."""
    ring = chain.ring
    return [name for name in ring.used(poly) if ring.generators[ring.index[name]].kind is Kind.LENGTH]


def _in_length(chain: Chain, poly: Poly, name: str, values: dict[str, int]) -> list[int]:
    by_power = {power: rest for (power,), rest in chain.ring.collect(poly, (name,)).items()}
    zero = chain.ring.zero
    return [chain.ring.evaluate(by_power.get(power, zero), values) for power in range(max(by_power) + 1)]


def _in_angle(chain: Chain, poly: Poly, angle: Angle, values: dict[str, int]) -> list[int]:
    """The polynomial in the tangent of half an angle."""
    ring = chain.ring
    groups = ring.collect(poly, (angle.cosine, angle.sine))
    degree = max(c + s for c, s in groups)
    total = [0] * (2 * degree + 1)
    for (c, s), rest in groups.items():
        term = [ring.evaluate(rest, values)]
        for factor in [[1, 0, -1]] * c + [[0, 2]] * s + [[1, 0, 1]] * (degree - c - s):
            product = [0] * (len(term) + len(factor) - 1)
            for i, left in enumerate(term):
                for j, right in enumerate(factor):
                    product[i + j] += left * right
            term = product
        total = [a + b for a, b in zip(total, term + [0] * (len(total) - len(term)), strict=True)]
    return total


def _intervals(chain: Chain, points: dict[_Edge, Point]) -> dict[str, int]:
    """Cosines and sines of all sums of angles from those of the independent ones."""
    result: dict[str, int] = {}
    for (group, low, high), angle in chain.angles.items():
        edges: Edges = tuple((a, b) for g, a, b in points if g == group)
        total: Point = (1, 0)
        for start, end in path(edges, low, high):
            edge = (group, min(start, end), max(start, end))
            total = turn(total, points[edge], chain.angles[edge].sign * (1 if start < end else -1))
        result[angle.cosine], result[angle.sine] = total[0], total[1] * angle.sign % PRIME
    return result
