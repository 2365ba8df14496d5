"""Random postures at which a polynomial of an arm vanishes, modulo the prime.

One angle, or one length, is solved for: its cosine and sine are rational in the tangent of half of it, so the
polynomial becomes one in a single unknown, and its roots in the field are exact.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

from kinsym.algebra.field import PRIME, Point, circle_point, inverse, turn
from kinsym.algebra.ring import Kind, Poly
from kinsym.algebra.roots import roots
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.posture import Posture, posture
from kinsym.kinematics.trees import Edges, path, spanning_trees

#: About every second try has a root in the field.
TRIES = 40


@dataclass(frozen=True)
class Part:
    """A part of the set on which a polynomial vanishes.

    Where the polynomial is one cosine or sine its zeros are two angles, and ``quarters`` times pi/2 is this one;
    ``variable`` is then the name of the angle, or of the prismatic variable that is zero.
    """

    poly: Poly
    variable: str = ""
    quarters: int = 0


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


def postures(chain: Chain, part: Part, count: int) -> list[Posture]:
    """Random postures of a part, ``count`` of them or, where the field has no root, fewer."""
    trees = _trees(chain, part.poly)
    found: list[Posture] = []
    for number in range(TRIES):
        if len(found) == count:
            break
        generator = random.Random(f"zeros {number}")
        values = chain.sample(generator)
        points = {edge: circle_point(generator) for edge in sorted(trees)}
        solved = _solved(chain, part, values, points, number)
        if solved is not None:
            found.append(posture(chain, solved))
    return found


def somewhere(chain: Chain, count: int) -> list[Posture]:
    """Random postures."""
    return [posture(chain, chain.sample(random.Random(f"somewhere {number}"))) for number in range(count)]


_Edge = tuple[int, int, int]


def _trees(chain: Chain, poly: Poly) -> dict[_Edge, Angle]:
    """Independent angles of every group, those of a polynomial among them."""
    used = set(chain.ring.used(poly))
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
    chain: Chain, part: Part, values: dict[str, int], points: dict[_Edge, Point], number: int
) -> dict[str, int] | None:
    """Values of all generators with the polynomial zero, or None if the field has no root."""
    ring, angles = chain.ring, chain.angles
    used = ring.used(part.poly)
    edges = [edge for edge in points if {angles[edge].cosine, angles[edge].sine} & set(used)]
    lengths = [name for name in used if ring.generators[ring.index[name]].kind is Kind.LENGTH]
    if part.variable in values:
        values[part.variable] = 0
    elif part.variable:
        (edge,) = edges
        points[edge] = ((1, 0), (0, 1), (PRIME - 1, 0), (0, PRIME - 1))[part.quarters]
    else:
        unknown = [*edges, *lengths][number % (len(edges) + len(lengths))]
        for edge, (c, s) in points.items():
            values[angles[edge].cosine], values[angles[edge].sine] = c, s
        if isinstance(unknown, str):
            found = roots(_in_length(chain, part.poly, unknown, values))
            if not found:
                return None
            values[unknown] = found[0]
        else:
            angle = angles[unknown]
            for y in roots(_in_angle(chain, part.poly, angle, values)):
                if scale := (1 + y * y) % PRIME:
                    points[unknown] = ((1 - y * y) * inverse(scale) % PRIME, 2 * y * inverse(scale) % PRIME)
                    break
            else:
                return None
    return {**values, **_intervals(chain, points)}


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
