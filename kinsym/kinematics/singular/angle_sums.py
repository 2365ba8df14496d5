"""Which sums of angles a polynomial is written in.

The angles between the nodes of a group depend on one another: theta23 is theta2 + theta3. A spanning tree of the
nodes is a choice of independent ones, and the same polynomial is short in one and long in another:
``c23*c3 + s23*s3`` is ``c2``.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from itertools import combinations

from kinsym.algebra.ring import Kind, Poly
from kinsym.kinematics.chain import Chain, Group

Edges = tuple[tuple[int, int], ...]
"""A spanning tree of the nodes of one group, each edge (low, high)."""

#: Groups with more nodes than this are only written in sums from one node and in single angles.
MOST_NODES = 4


def spanning_trees(group: Group) -> Iterator[Edges]:
    """The ways to choose independent angles of a group."""
    nodes = range(group.last + 1)
    if len(nodes) > MOST_NODES:
        yield tuple((node, node + 1) for node in nodes[:-1])
        for centre in nodes:
            yield tuple((min(centre, node), max(centre, node)) for node in nodes if node != centre)
        return
    for edges in combinations(list(combinations(nodes, 2)), group.last):
        if len(_distances(edges, 0)) == len(nodes):
            yield edges


def path(edges: Edges, start: int, end: int) -> list[tuple[int, int]]:
    """The steps from one node to another."""
    before = _distances(edges, start)
    steps: list[tuple[int, int]] = []
    while end != start:
        steps.append((before[end], end))
        end = before[end]
    return steps[::-1]


def _distances(edges: Edges, start: int) -> dict[int, int]:
    """For every node that the edges reach, the one before it on the way."""
    before = {start: start}
    queue = deque([start])
    while queue:
        here = queue.popleft()
        for low, high in edges:
            other = high if here == low else low if here == high else here
            if other not in before:
                before[other] = here
                queue.append(other)
    return before


def shortest(chain: Chain, poly: Poly) -> Poly:
    """The same polynomial in the sums of angles in which it has the fewest terms."""
    for group in chain.groups:
        if group.last < 2 or not _used(chain, group, poly):
            continue
        choices = [rewritten(chain, group, edges, poly) for edges in spanning_trees(group)]
        poly = min(choices, key=lambda choice: _length(chain, choice))
    return poly


def rewritten(chain: Chain, group: Group, edges: Edges, poly: Poly) -> Poly:
    """A polynomial in the angles of one spanning tree of a group."""
    ring = chain.ring
    names = _used(chain, group, poly)
    values: dict[str, Poly] = {}
    for (index, low, high), angle in chain.angles.items():
        if not {angle.cosine, angle.sine} & set(names):
            continue
        c, s = ring.one, ring.zero
        for start, end in path(edges, low, high):
            c2, s2 = chain.turn(index, start, end)
            c, s = ring.mul(c, c2) - ring.mul(s, s2), ring.mul(s, c2) + ring.mul(c, s2)
        values[angle.cosine], values[angle.sine] = c, s * angle.sign
    total = ring.zero
    for exponents, rest in ring.collect(poly, names).items():
        term = rest
        for name, exponent in zip(names, exponents, strict=True):
            for _ in range(exponent):
                term = ring.mul(term, values[name])
        total = total + term
    return ring.reduce(total)


def _used(chain: Chain, group: Group, poly: Poly) -> list[str]:
    """The cosines and sines of a group's angles in a polynomial."""
    own = {name for angle in chain.angles.values() if angle.group == group.index for name in (angle.cosine, angle.sine)}
    return [name for name in chain.ring.used(poly) if name in own]


def _length(chain: Chain, poly: Poly) -> tuple[int, int, int, list[str]]:
    ring = chain.ring
    angles = (Kind.COSINE, Kind.SINE)
    names = [name for name in ring.used(poly) if ring.generators[ring.index[name]].kind in angles]
    return len(poly), sum(sum(monomial) for monomial in poly), sum(map(len, names)), names
