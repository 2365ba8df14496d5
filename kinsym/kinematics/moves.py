"""How a group of parallel axes moves a point or a direction.

Everything is linear in the cosines and sines of the group's partial sums, also the squared length of its translation
(law of cosines), so that no product of two angles of one group ever has to be simplified.
"""

from __future__ import annotations

from functools import cached_property

from kinsym.algebra.ring import Poly, Ring, Vector, apply, minus, plus, transpose
from kinsym.kinematics.chain import Group, TurnOf


class Moves:
    """The moves of one group, its angles given by ``turn`` (unknown generators, known ones, or sums of both)."""

    def __init__(self, ring: Ring, group: Group, turn: TurnOf) -> None:
        self.ring, self.group, self._turn_of = ring, group, turn
        self._turns: dict[tuple[int, int], tuple[Poly, Poly]] = {}

    def rotated(self, start: int, end: int, vector: Vector) -> Vector:
        """A vector turned about z by the angle from one node to another."""
        x, y, z = vector
        if not x and not y:
            return vector
        c, s = self._turn(start, end)
        mul = self.ring.mul
        return mul(c, x) - mul(s, y), mul(s, x) + mul(c, y), z

    def _turn(self, start: int, end: int) -> tuple[Poly, Poly]:
        """Cosine and sine of the angle from one node to another; asked for many vectors, worked out once."""
        if (start, end) not in self._turns:
            self._turns[start, end] = self._turn_of(self.group.index, start, end)
        return self._turns[start, end]

    @cached_property
    def reach(self) -> Vector:
        """The group's translation in the frame before it."""
        total: Vector = (self.ring.zero,) * 3
        for node, arm in enumerate(self.group.arms):
            total = plus(total, self.rotated(0, node, arm))
        return total

    @cached_property
    def back_reach(self) -> Vector:
        """The same translation in the frame after the rotation about z, before the constant turn."""
        total: Vector = (self.ring.zero,) * 3
        for node, arm in enumerate(self.group.arms):
            total = plus(total, self.rotated(self.group.last, node, arm))
        return total

    @cached_property
    def reach_squared(self) -> Poly:
        """The squared length of the translation, by the law of cosines."""
        ring, arms = self.ring, self.group.arms
        total = ring.zero
        for i, first in enumerate(arms):
            total += ring.dot(first, first)
            for j in range(i + 1, len(arms)):
                total += 2 * ring.dot(first, self.rotated(i, j, arms[j]))
        return ring.reduce(total)

    def direction(self, vector: Vector) -> Vector:
        """A direction after the group, seen from before it."""
        return self.rotated(0, self.group.last, apply(self.ring, self.group.turned, vector))

    def point(self, vector: Vector) -> Vector:
        """A point after the group, seen from before it."""
        return plus(self.direction(vector), self.reach)

    def direction_back(self, vector: Vector) -> Vector:
        """A direction before the group, seen from after it."""
        return apply(self.ring, transpose(self.group.turned), self.rotated(self.group.last, 0, vector))

    def point_back(self, vector: Vector) -> Vector:
        """A point before the group, seen from after it."""
        turned = self.rotated(self.group.last, 0, vector)
        return apply(self.ring, transpose(self.group.turned), plus(turned, minus(self.back_reach)))

    def point_squared(self, vector: Vector, squared: Poly) -> Poly:
        """The squared distance from before the group to a point after it, given the same from after the group."""
        ring = self.ring
        inner = apply(ring, self.group.turned, vector)
        return ring.reduce(squared + self.reach_squared + 2 * ring.dot(self.back_reach, inner))

    def point_back_squared(self, vector: Vector, squared: Poly) -> Poly:
        """The squared distance from after the group to a point before it, given the same from before the group."""
        ring = self.ring
        return ring.reduce(squared + self.reach_squared - 2 * ring.dot(self.reach, vector))
