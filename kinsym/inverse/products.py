"""The vectors that the cuts of one state share.

Two cuts that differ by one group differ by one move of every vector, so each is made from its neighbour's and kept.
``first`` and ``stop`` are the groups at which the loop closure is cut, see :class:`kinsym.inverse.cut.Cut`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

from kinsym.algebra.ring import Poly, Vector, apply, minus, plus, transpose
from kinsym.inverse.state import State
from kinsym.kinematics.links import Rigid
from kinsym.kinematics.moves import Moves

P = ParamSpec("P")
R = TypeVar("R")


def _kept(method: Callable[Concatenate[Products, P], R]) -> Callable[Concatenate[Products, P], R]:
    """A method whose results are kept by its arguments."""

    @wraps(method)
    def looked_up(self: Products, /, *arguments: P.args, **names: P.kwargs) -> R:
        key = (method.__name__, *arguments)
        if key not in self.results:
            self.results[key] = method(self, *arguments, **names)
        return self.results[key]  # type: ignore[no-any-return]

    return looked_up


class Products:
    """Vectors of the loop closure of one state, each worked out once."""

    def __init__(self, state: State) -> None:
        self.state, self.ring, self.moves = state, state.chain.ring, state.moves
        self.results: dict[tuple[Any, ...], Any] = {}

    def unit(self, column: str) -> Vector:
        """A unit vector by its letter."""
        zero, one = self.ring.zero, self.ring.one
        return one if column == "u" else zero, one if column == "v" else zero, one if column == "w" else zero

    @property
    def origin(self) -> Vector:
        """The origin of a frame, seen from itself."""
        return self.ring.zero, self.ring.zero, self.ring.zero

    @_kept
    def trail(self, stop: int) -> Rigid:
        """The constant after the last joint before the second cut, which goes to the left."""
        whole = stop == len(self.state.groups)
        return Rigid.unit(self.ring) if whole else self.state.chain.groups[self.state.first + stop - 1].trail

    @_kept
    def inside(self, first: int, stop: int) -> tuple[Moves, ...]:
        """The moves of the groups that stay on the right."""
        if stop == len(self.state.groups) or first == stop:
            return self.moves[first:stop]
        return (*self.moves[first : stop - 1], self._last(stop))

    @_kept
    def _last(self, stop: int) -> Moves:
        """The moves of the last group on the right without its trail."""
        return Moves(self.ring, self.state.chain.groups[self.state.first + stop - 1], self.state.known.turn)

    @_kept
    def left_column(self, first: int, stop: int, column: str) -> Vector:
        """Column u, v or w of the left side."""
        if first:
            return self.moves[first - 1].direction_back(self.left_column(first - 1, stop, column))
        if stop == len(self.moves):
            return self.state.pose[column]
        vector = apply(self.ring, transpose(self.trail(stop).rotation), self.unit(column))
        for move in self.moves[stop:]:
            vector = move.direction_back(vector)
        return self.turned(vector)

    @_kept
    def right_column(self, first: int, stop: int, column: str) -> Vector:
        """Column u, v or w of the right side."""
        if first == stop:
            return self.unit(column)
        return self._move(first, stop).direction(self.right_column(first + 1, stop, column))

    @_kept
    def left_point(self, first: int, stop: int) -> Vector:
        """Column p of the left side."""
        if first:
            return self.moves[first - 1].point_back(self.left_point(first - 1, stop))
        return plus(self.turned_tip(stop), self.state.pose["p"])

    @_kept
    def right_point(self, first: int, stop: int) -> Vector:
        """Column p of the right side."""
        if first == stop:
            return self.origin
        return self._move(first, stop).point(self.right_point(first + 1, stop))

    @_kept
    def right_squared(self, first: int, stop: int) -> Poly:
        """The squared length of column p of the right side."""
        if first == stop:
            return self.ring.zero
        rest = self.right_point(first + 1, stop), self.right_squared(first + 1, stop)
        return self._move(first, stop).point_squared(*rest)

    @_kept
    def left_origin(self, first: int, stop: int) -> Vector:
        """Column p of the inverse of the left side, seen from behind the group before the second cut."""
        if stop < len(self.moves):
            return self.moves[stop].point(self.left_origin(first, stop + 1))
        ring, pose = self.ring, self.state.pose
        away = plus(self.root(first)[0], minus(pose["p"]))
        return ring.dot(pose["u"], away), ring.dot(pose["v"], away), ring.dot(pose["w"], away)

    @_kept
    def right_origin(self, first: int, stop: int) -> Vector:
        """The origin of the first cut after the groups ``first`` to ``stop``, trails included."""
        if first == stop:
            return self.origin
        return self.moves[stop - 1].point_back(self.right_origin(first, stop - 1))

    @_kept
    def tip(self, stop: int) -> tuple[Vector, Poly]:
        """The origin of the second cut seen from the end of the arm, and its squared distance."""
        point = self.trail(stop).inverse(self.ring).translation
        squared = self.ring.dot(point, point)
        for move in self.moves[stop:]:
            squared = move.point_back_squared(point, squared)
            point = move.point_back(point)
        return point, squared

    @_kept
    def turned_tip(self, stop: int) -> Vector:
        """The way from the end of the arm to the second cut, seen from the first frame."""
        return self.turned(self.tip(stop)[0])

    @_kept
    def root(self, first: int) -> tuple[Vector, Poly]:
        """The origin of the first cut seen from the first frame, and its squared distance."""
        point, squared = self.origin, self.ring.zero
        for move in reversed(self.moves[:first]):
            squared = move.point_squared(point, squared)
            point = move.point(point)
        return point, squared

    def turned(self, vector: Vector) -> Vector:
        """A direction in the last frame, seen from the first."""
        if not any(vector):
            return vector
        pose = self.state.pose
        return apply(self.ring, transpose((pose["u"], pose["v"], pose["w"])), vector)

    def _move(self, place: int, stop: int) -> Moves:
        """The moves of one group on the right."""
        return self.inside(place, stop)[0]
