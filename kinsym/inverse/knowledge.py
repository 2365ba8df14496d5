"""What is known of the joints while the derivation runs.

The angles between the nodes of a group form a graph: solving the angle between two nodes joins them, and every angle
inside a connected part is a sum of solved ones. An unknown angle is therefore a pair of parts, and theta23 stands for
theta2 as soon as theta3 is known.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

from kinsym.algebra.ring import Poly
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain, Group

Edge = tuple[int, int, int]
"""(group, low node, high node)."""


@dataclass(frozen=True)
class Knowledge:
    """Solved angles as edges between nodes, and solved prismatic variables."""

    chain: Chain
    edges: frozenset[Edge] = frozenset()
    lengths: frozenset[str] = frozenset()

    def with_angle(self, edge: Edge) -> Knowledge:
        """After an angle has been solved."""
        return replace(self, edges=self.edges | {edge})

    def with_length(self, variable: str) -> Knowledge:
        """After a prismatic variable has been solved."""
        return replace(self, lengths=self.lengths | {variable})

    def representative(self, group: int, node: int) -> int:
        """The lowest node of the connected part a node belongs to."""
        return min(self._part(group, node))

    def _part(self, group: int, node: int) -> set[int]:
        part, todo = {node}, [node]
        while todo:
            here = todo.pop()
            for g, low, high in self.edges:
                if g == group and here in (low, high):
                    other = high if here == low else low
                    if other not in part:
                        part.add(other)
                        todo.append(other)
        return part

    def path(self, group: int, start: int, end: int) -> list[tuple[int, int]]:
        """The solved angles that lead from one node to another, as (from, to) pairs."""
        before: dict[int, int] = {start: start}
        queue = deque([start])
        while queue and end not in before:
            here = queue.popleft()
            for g, low, high in sorted(self.edges):
                if g == group and here in (low, high):
                    other = high if here == low else low
                    if other not in before:
                        before[other] = here
                        queue.append(other)
        steps: list[tuple[int, int]] = []
        while end != start:
            steps.append((before[end], end))
            end = before[end]
        return steps[::-1]

    def knows(self, angle: Angle) -> bool:
        """Whether an angle follows from what has been solved."""
        return self.representative(angle.group, angle.low) == self.representative(angle.group, angle.high)

    def turn(self, group: int, start: int, end: int) -> tuple[Poly, Poly]:
        """Cosine and sine between two nodes, in known angles and the one unknown angle between their parts."""
        chain, ring = self.chain, self.chain.ring
        a, b = self.representative(group, start), self.representative(group, end)
        if a == b:
            return chain.turn(group, start, end)
        c, s = chain.turn(group, a, b)
        for left, right in ((b, end), (start, a)):
            if left != right:
                c2, s2 = chain.turn(group, left, right)
                c, s = ring.mul(c, c2) - ring.mul(s, s2), ring.mul(s, c2) + ring.mul(c, s2)
        return c, s

    def solved(self, group: Group) -> bool:
        """Whether every joint of a group is known."""
        part = self._part(group.index, 0)
        joints = [self.chain.joints[p] for p in group.joints]
        return len(part) == group.last + 1 and all(j.kind == "R" or j.variable in self.lengths for j in joints)

    def unknowns(self) -> tuple[str, ...]:
        """The joint variables that are still unknown, in order."""
        result: list[str] = []
        for group in self.chain.groups:
            node = 0
            for position in group.joints:
                joint = self.chain.joints[position]
                if joint.kind == "P":
                    if joint.variable not in self.lengths:
                        result.append(joint.variable)
                    continue
                node += 1
                if self.representative(group.index, node - 1) != self.representative(group.index, node):
                    result.append(joint.variable)
        return tuple(result)
