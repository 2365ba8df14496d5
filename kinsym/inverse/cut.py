"""One matrix equation of the loop closure, cut twice.

What lies before the first cut and after the second is moved to the left:
``(G_1..G_i)^-1 T (G_k..G_m)^-1 = G_i+1..G_k-1``. This module computes the columns of both sides, the origin of the
inverse equation and the squared distance of the cuts; all are linear in the cosines and sines of each group.
"""

from __future__ import annotations

from functools import cached_property

from kinsym.algebra.ring import Poly, Vector, apply, minus, plus, transpose
from kinsym.inverse.state import State
from kinsym.kinematics.links import Rigid
from kinsym.kinematics.moves import Moves
from kinsym.robot.model import Convention, Robot


def link_letter(robot: Robot) -> str:
    """A for the link transforms of Paul's table; L for the links of the chain where they are cut differently."""
    return "A" if robot.convention is Convention.PAUL else "L"


class Cut:
    """The groups ``first`` to ``stop`` (exclusive) of a state stay on the right."""

    def __init__(self, state: State, first: int, stop: int) -> None:
        self.state, self.first, self.stop = state, first, stop
        self.ring = state.chain.ring
        self.before, self.behind = state.moves[:first], state.moves[stop:]
        whole = stop == len(state.groups)
        last = state.chain.groups[state.first + stop - 1]
        self.trail = Rigid.unit(self.ring) if whole else last.trail
        if whole or first == stop:
            self.inside = state.moves[first:stop]
        else:
            self.inside = (*state.moves[first : stop - 1], Moves(self.ring, last, state.known.turn))

    def __str__(self) -> str:
        return self._words

    @cached_property
    def _words(self) -> str:
        """The equation in words: A1^-1 T_0_6 = A2 A3 A4 A5 A6."""
        state = self.state
        link = link_letter(state.chain.robot)
        groups = state.chain.groups[state.first : state.end]

        def numbers(part: slice) -> list[int]:
            return [number for group in groups[part] for number in state.links(group)]

        left = [f"{link}{i}^-1" for i in reversed(numbers(slice(0, self.first)))]
        right = [f"{link}{i}^-1" for i in reversed(numbers(slice(self.stop, None)))]
        product = " ".join(f"{link}{i}" for i in numbers(slice(self.first, self.stop)))
        return f"{' '.join([*left, state.label, *right])} = {product or '1'}"

    def left_column(self, column: str) -> Vector:
        """Column u, v or w of the left side."""
        if self.behind:
            vector = apply(self.ring, transpose(self.trail.rotation), self._unit(column))
            for move in self.behind:
                vector = move.direction_back(vector)
            vector = self._turned(vector)
        else:
            vector = self.state.pose[column]
        for move in self.before:
            vector = move.direction_back(vector)
        return vector

    def right_column(self, column: str) -> Vector:
        """Column u, v or w of the right side."""
        vector = self._unit(column)
        for move in reversed(self.inside):
            vector = move.direction(vector)
        return vector

    @property
    def skew(self) -> bool:
        """Whether slides after the last revolute axis have turned the last frame away from it."""
        x, y, _ = self._axis()
        return bool(x or y)

    def left_axis(self) -> Vector:
        """The direction of the last revolute axis on the right, from the columns of the left side."""
        columns = [self.left_column(column) for column in "uvw"]
        x, y, z = (self.ring.dot(self._axis(), row) for row in zip(*columns, strict=True))
        return x, y, z

    def right_axis(self) -> Vector:
        """The same from the joints before it; it does not turn about itself."""
        vector = self._unit("w")
        for move in reversed(self.inside[:-1]):
            vector = move.direction(vector)
        return vector

    def _axis(self) -> Vector:
        """The axis of the last group of the right side in the last frame."""
        return self.inside[-1].group.turned[2]

    def left_point(self) -> Vector:
        """Column p of the left side."""
        tip, _ = self._tip()
        point = plus(self._turned(tip), self.state.pose["p"])
        for move in self.before:
            point = move.point_back(point)
        return point

    def right_point(self) -> Vector:
        """Column p of the right side."""
        point = self._origin()
        for move in reversed(self.inside):
            point = move.point(point)
        return point

    def left_origin(self) -> Vector:
        """Column p of the inverse of the left side."""
        ring, pose = self.ring, self.state.pose
        root, _ = self._root()
        away = plus(root, minus(pose["p"]))
        point: Vector = (ring.dot(pose["u"], away), ring.dot(pose["v"], away), ring.dot(pose["w"], away))
        for move in reversed(self.behind):
            point = move.point(point)
        return self.trail.apply(ring, point)

    def right_origin(self) -> Vector:
        """Column p of the inverse of the right side."""
        point = self._origin()
        for move in self.inside:
            point = move.point_back(point)
        return point

    def left_squared(self) -> Poly:
        """The squared length of column p of the left side."""
        ring, p = self.ring, self.state.pose["p"]
        tip, tip_squared = self._tip()
        root, root_squared = self._root()
        turned = self._turned(tip)
        total = tip_squared + root_squared + ring.dot(p, p) + 2 * ring.dot(p, turned)
        return ring.reduce(total - 2 * ring.dot(root, plus(turned, p)))

    def right_squared(self) -> Poly:
        """The squared length of column p of the right side."""
        point, squared = self._origin(), self.ring.zero
        for move in reversed(self.inside):
            squared = move.point_squared(point, squared)
            point = move.point(point)
        return squared

    def _tip(self) -> tuple[Vector, Poly]:
        """The origin of the second cut seen from the end of the arm, and its squared distance."""
        ring = self.ring
        point = self.trail.inverse(ring).translation
        squared = ring.dot(point, point)
        for move in self.behind:
            squared = move.point_back_squared(point, squared)
            point = move.point_back(point)
        return point, squared

    def _root(self) -> tuple[Vector, Poly]:
        """The origin of the first cut seen from the first frame, and its squared distance."""
        point, squared = self._origin(), self.ring.zero
        for move in reversed(self.before):
            squared = move.point_squared(point, squared)
            point = move.point(point)
        return point, squared

    def _turned(self, vector: Vector) -> Vector:
        """A direction in the last frame, seen from the first."""
        if not any(vector):
            return vector
        pose = self.state.pose
        return apply(self.ring, transpose((pose["u"], pose["v"], pose["w"])), vector)

    def _unit(self, column: str) -> Vector:
        zero, one = self.ring.zero, self.ring.one
        return one if column == "u" else zero, one if column == "v" else zero, one if column == "w" else zero

    def _origin(self) -> Vector:
        return self.ring.zero, self.ring.zero, self.ring.zero
