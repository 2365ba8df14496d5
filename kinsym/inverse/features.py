"""Geometric quantities whose sign tells the branches of an arm apart: shoulder, elbow, wrist, the sign of a slide.

Each is a polynomial in the posture, so a branch can be held against it at random postures modulo the prime. Shoulder
and elbow are those of C. S. G. Lee and M. Ziegler, A geometric approach in solving the inverse kinematics of PUMA
robots, IEEE Transactions on Aerospace and Electronic Systems 20(6), 1984.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import Numbers, cross, difference, dot
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.meaning import crossing
from kinsym.kinematics.singular.posture import Posture

SHOULDER = ("shoulder right", "shoulder left")
ELBOW = ("elbow up", "elbow down")
"""On the left shoulder these two change places."""

Point = Callable[[Posture], Numbers]


@dataclass(frozen=True)
class Feature:
    """Words for the two signs of a geometric quantity, positive first, and a sentence that says what they mean."""

    words: tuple[str, str]
    meaning: str
    value: Callable[[Posture], int]


class Features:
    """The features of one arm; ``chain`` holds the joints that are solved for, and they are called by its numbers."""

    def __init__(self, chain: Chain, postures: list[Posture]) -> None:
        self._chain, self._postures = chain, postures
        kinds = postures[0].kinds
        self._turning = [joint for joint, kind in enumerate(kinds) if kind == "R"]

    def of(self, variables: tuple[str, ...], *, sided: bool) -> Iterator[Feature]:
        """The features that a step for these joints can be about; ``sided`` tells that the shoulder has been named."""
        own = [place for place, joint in enumerate(self._chain.joints) if joint.variable in variables]
        if own == self._turning[:1]:
            yield from self._shoulder(own[0])
        if len(own) == 1 and own[0] in self._turning:
            yield from self._elbow(own[0], sided)
        yield from self._flips()
        for joint in self._chain.joints:
            if joint.kind == "P":
                name = joint.variable
                meaning = f"{name} > 0 and {name} < 0: the sign of {name}"
                yield Feature((f"{name} > 0", f"{name} < 0"), meaning, partial(_length, name=name))

    def _shoulder(self, first: int) -> Iterator[Feature]:
        """On which side of the first axis the arm reaches."""
        second = self._second
        if second is None:
            return
        for words, point in self._points():
            yield Feature(
                SHOULDER,
                f"{SHOULDER[0]}: seen from axis {self._number(first)} towards {words}, axis {self._number(first)} "
                f"upward, axis {self._number(second)} points to the right",
                partial(_reach, first=first, second=second, point=point),
            )

    def _elbow(self, joint: int, sided: bool) -> Iterator[Feature]:
        """On which side of the way from the base to the tip of two links the joint between them lies."""
        second, first, own = self._second, self._number(self._turning[0]), self._number(joint)
        for (base, start), (tip, end) in product(self._points(joint, -1), self._points(joint, 1)):
            side = partial(_side, joint=joint, start=start, end=end)
            if sided and second is not None and self._parallel(joint, second):
                yield Feature(
                    ELBOW,
                    f"{ELBOW[0]}: seen with axis {first} upward and the side of axis {first} that the arm reaches to "
                    f"on the right, axis {own} lies to the left of the way from {base} to {tip}, which is above it "
                    "wherever it leads to the right",
                    partial(_side_about, joint=joint, other=second, side=side),
                )
            else:
                meaning = f"elbow left: seen against axis {own}, it lies to the left of the way from {base} to {tip}"
                yield Feature(("elbow left", "elbow right"), meaning, side)

    def _flips(self) -> Iterator[Feature]:
        """Whether the middle one of three axes turns the third out of the first by a positive angle."""
        for name, triple in (("wrist", self._turning[-3:]), ("shoulder", self._turning[:3])):
            if len(triple) == 3:
                i, j, k = map(self._number, triple)
                yield Feature(
                    (f"{name} not flipped", f"{name} flipped"),
                    f"{name} not flipped: about axis {j}, axis {k} is less than half a turn ahead of axis {i}",
                    partial(_flip, triple=triple),
                )

    def _points(self, joint: int | None = None, way: int = 0) -> Iterator[tuple[str, Point]]:
        """Points of the arm with their names; with a joint, those before it (way -1) or behind it (way 1)."""
        kept = [k for k in self._turning if joint is None or (k - joint) * way > 0]
        for k in kept:
            if joint is not None and abs(k - joint) == 1 and self._parallel(k, joint):
                yield f"axis {self._number(k)}", partial(_on_axis, joint=k)
        for k in reversed(kept):
            if k + 1 in kept and all(crossing(posture, k, k + 1) for posture in self._postures):
                words = f"the point where axes {self._number(k)} and {self._number(k + 1)} meet"
                yield words, partial(_meeting, joint=k)
        if way >= 0:
            yield "the end point", _end

    @property
    def _second(self) -> int | None:
        """The first joint whose axis is not parallel to the first one."""
        return next((k for k in self._turning if not self._parallel(self._turning[0], k)), None)

    def _parallel(self, i: int, j: int) -> bool:
        return not any(any(cross(posture.axes[i], posture.axes[j])) for posture in self._postures)

    def _number(self, joint: int) -> int:
        return self._chain.numbers[joint]


def _length(posture: Posture, name: str) -> int:
    return posture.values[name]


def _reach(posture: Posture, first: int, second: int, point: Point) -> int:
    """How far a point lies from an axis, across the second one."""
    across = cross(posture.axes[first], posture.axes[second])
    return dot(across, difference(point(posture), posture.points[first]))


def _side(posture: Posture, joint: int, start: Point, end: Point) -> int:
    """Twice the area of the triangle of two points and a joint, about the joint's axis."""
    base = start(posture)
    area = cross(difference(end(posture), base), difference(posture.points[joint], base))
    return dot(area, posture.axes[joint])


def _side_about(posture: Posture, joint: int, other: int, side: Callable[[Posture], int]) -> int:
    """The same about a parallel axis."""
    return side(posture) * dot(posture.axes[joint], posture.axes[other]) % PRIME


def _flip(posture: Posture, triple: list[int]) -> int:
    i, j, k = triple
    return dot(cross(posture.axes[i], posture.axes[k]), posture.axes[j])


def _on_axis(posture: Posture, joint: int) -> Numbers:
    return posture.points[joint]


def _meeting(posture: Posture, joint: int) -> Numbers:
    return crossing(posture, joint, joint + 1) or posture.points[joint]


def _end(posture: Posture) -> Numbers:
    return posture.end
