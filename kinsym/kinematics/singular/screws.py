"""The joint screws of a chain, seen from where they are sparse.

The determinant of a Jacobian is the same in every frame and for every point of the end effector that is followed:
turning the frame multiplies it by the determinant of a rotation, moving the point adds angular rows to linear ones. So
it is written in a frame in the middle of the arm, at a point that many axes pass through (for a spherical wrist its
centre). There most entries are zero, and the angles of a group all count from the node next to that frame, so that
they are independent of one another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kinsym.algebra.ring import Poly, Ring, Vector, apply, minus, plus, transpose
from kinsym.kinematics.chain import Chain, Group
from kinsym.kinematics.moves import Moves


@dataclass(frozen=True)
class Screw:
    """A joint's motion: its axis through ``point`` along ``direction``; a prismatic joint has no point."""

    direction: Vector
    point: Vector | None


@dataclass(frozen=True)
class View:
    """The joints, the end effector's point and its direction w, seen from a frame between two groups."""

    screws: tuple[Screw, ...]
    end: Vector
    approach: Vector

    @property
    def points(self) -> list[Vector]:
        """The points of the axes and the end effector's, each once."""
        return list(dict.fromkeys([*(s.point for s in self.screws if s.point is not None), self.end]))

    @property
    def terms(self) -> int:
        """How much there is to write."""
        vectors = [vector for screw in self.screws for vector in (screw.direction, screw.point) if vector is not None]
        return sum(len(entry) for vector in vectors for entry in vector)


def views(chain: Chain) -> Iterator[View]:
    """The chain from the frame before every group and from the one after the last."""
    for cut in range(len(chain.groups) + 1):
        yield _view(chain, cut)


def columns(ring: Ring, screws: tuple[Screw, ...], point: Vector) -> list[tuple[Poly, ...]]:
    """The Jacobian's columns: the velocity that each joint gives to a point, and its angular velocity."""
    zero = ring.zero
    return [
        (*screw.direction, zero, zero, zero)
        if screw.point is None
        else (*cross(ring, screw.direction, plus(point, minus(screw.point))), *screw.direction)
        for screw in screws
    ]


def cross(ring: Ring, left: Vector, right: Vector) -> Vector:
    """The vector product."""
    (a, b, c), (x, y, z) = left, right
    return ring.dot((b, -c), (z, y)), ring.dot((c, -a), (x, z)), ring.dot((a, -b), (y, x))


def _view(chain: Chain, cut: int) -> View:
    ring = chain.ring
    zero, one = ring.zero, ring.one
    whole = [Moves(ring, group.whole(ring), chain.turn) for group in chain.groups]
    screws = []
    for group in chain.groups:
        for position in group.joints:
            behind = group.index < cut
            direction, point = _within(chain, group, position, behind=behind)
            for move in whole[group.index + 1 : cut]:
                direction, point = move.direction_back(direction), move.point_back(point)
            for move in reversed(whole[cut : group.index]):
                direction, point = move.direction(direction), move.point(point)
            screws.append(Screw(direction, point if chain.joints[position].kind == "R" else None))
    end: Vector = (zero, zero, zero)
    approach: Vector = (zero, zero, one)
    for move in reversed(whole[cut:]):
        end, approach = move.point(end), move.direction(approach)
    return View(tuple(screws), end, approach)


def _within(chain: Chain, group: Group, position: int, *, behind: bool) -> tuple[Vector, Vector]:
    """Axis and point of a joint, seen from after its group if that lies ``behind``, else from before it."""
    ring = chain.ring
    zero = ring.zero
    full = group.whole(ring)
    start = full.last if behind else 0
    move = Moves(ring, full, chain.turn)
    direction: Vector = (zero, zero, ring.one * chain.joints[position].sign)
    point: Vector = (zero, zero, zero)
    parts = chain.groups_before(position)
    if parts and parts[-1].index == group.index:
        part = parts[-1].whole(ring)
        direction = move.rotated(start, part.last, apply(ring, part.turned, direction))
        for node, arm in enumerate(part.arms):
            point = plus(point, move.rotated(start, node, arm))
    if behind:
        back = transpose(full.turned)
        return apply(ring, back, direction), apply(ring, back, plus(point, minus(move.back_reach)))
    return direction, point
