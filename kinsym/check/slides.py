"""The loop of an arm with two sliding joints reduced to one angle, with 50 digits.

The orientation of the loop holds four angles: Rz1 A1 Rz2 A2 Rz3 A3 Rz4 A4 = I. For a first angle the third is one of
two roots, the others follow, and the loop closes if the directions of the slides and what is left of it lie in a plane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from kinsym.check.elimination import Joint, Motion
from kinsym.check.linear import Matrix, Value, Vector, circle_roots
from kinsym.general.plan import Cut

DEGREE = 4


@dataclass(frozen=True)
class _Posture:
    """The loop at one angle and one root: turns as (cosine, sine), directions of the slides, what is left, sin^2."""

    turns: list[tuple[Value, Value]]
    slides: list[Vector]
    rest: Vector
    rho: Value


class SlidingLoop:
    """One loop seen from a joint that turns; ``candidates`` are joint values in the order N0 .. N5 of a cut.

    What is below ``vanished`` at every angle is zero but for the rounding of the pose.
    """

    vanished = 1e-13

    def __init__(self, ctx: Any, cut: Cut, joints: Sequence[Joint], links: Sequence[Motion]) -> None:
        """``joints`` and ``links`` are the robot's, six each; the last link closes the loop."""
        self.ctx = ctx
        numbers = [cut.order[k % 6] for k in range(2, 8)]
        self.joints = [joints[number - 1] for number in numbers]
        self.links = [links[number - 1] for number in numbers]
        turning = [k for k, joint in enumerate(self.joints) if joint.kind == "R"]
        self.between = [self._rotation(start, end) for start, end in zip(turning, (*turning[1:], 6), strict=True)]

    def angles(self) -> list[Value]:
        """The suppressed angles at which the loop closes, or nearly does."""
        return circle_roots(self.ctx, self.closing, DEGREE)

    def closing(self, c: Value, s: Value) -> Value:
        """What vanishes where the loop closes, at a suppressed angle with this cosine and sine."""
        plus, minus = (self._posture(c, s, root) for root in (1, -1))
        return self.ctx.re(plus.rho * _volume(plus) * _volume(minus))

    def candidates(self, angles: list[Value]) -> Iterator[Vector]:
        """Joint values N0 .. N5 near every solution, and near some that are none."""
        ctx = self.ctx
        for theta in angles:
            for root in (1, -1):
                posture = self._posture(ctx.cos(theta), ctx.sin(theta), root)
                turns = [ctx.atan2(ctx.re(s), ctx.re(c)) for c, s in posture.turns]
                lengths = self._lengths(posture)
                if lengths is None:
                    continue
                kinds = [joint.kind for joint in self.joints]
                values = [
                    lengths[kinds[:k].count("P")] if kind == "P" else self.joints[k].sign * turns[kinds[:k].count("R")]
                    for k, kind in enumerate(kinds)
                ]
                yield [*values[4:], *values[:4]]

    def _rotation(self, start: int, end: int) -> Matrix:
        result = self.links[start][0]
        for link in self.links[start + 1 : end]:
            result = _times(result, link[0])
        return result

    def _posture(self, c: Value, s: Value, root: int) -> _Posture:
        """Everything that follows from the first angle; complex where the third angle has no real root."""
        ctx = self.ctx
        A1, A2, A3, A4 = self.between
        first = (c, self.joints[0].sign * s)
        u = _column(_transposed(_times(_turn(*first), A1)), A4[2])
        a = A2[2][0] * A3[0][2] + A2[2][1] * A3[1][2]
        b = A2[2][1] * A3[0][2] - A2[2][0] * A3[1][2]
        e, rr = u[2] - A2[2][2] * A3[2][2], a * a + b * b
        w = root * ctx.sqrt(ctx.mpc(rr - e * e))
        third = _divided(a * e - b * w, b * e + a * w, rr)
        v = _column(_times(A2, _turn(*third)), [row[2] for row in A3])
        rho = u[0] * u[0] + u[1] * u[1]
        second = _divided(v[0] * u[0] + v[1] * u[1], v[0] * u[1] - v[1] * u[0], rho)
        whole = A4
        for angle, rotation in ((first, A1), (second, A2), (third, A3)):
            whole = _times(_times(whole, _turn(*angle)), rotation)
        fourth = (whole[0][0], whole[0][1])
        turns = [first, second, third, fourth]
        R: Matrix = [[int(i == j) for j in range(3)] for i in range(3)]
        rest: Vector = [ctx.zero] * 3
        slides, left = [], list(turns)
        for joint, link in zip(self.joints, self.links, strict=True):
            if joint.kind == "R":
                R = _times(R, _turn(*left.pop(0)))
            else:
                slides.append([joint.sign * row[2] for row in R])
            rest = [p + q for p, q in zip(rest, _column(R, link[1]), strict=True)]
            R = _times(R, link[0])
        return _Posture(turns, slides, rest, rho)

    def _lengths(self, posture: _Posture) -> list[Value] | None:
        """The two lengths by least squares; None where the slides are parallel."""
        ctx = self.ctx
        one, two = ([ctx.re(x) for x in slide] for slide in posture.slides)
        rest = [-ctx.re(x) for x in posture.rest]
        aa, ab, bb = (sum(map(_product, p, q)) for p, q in ((one, one), (one, two), (two, two)))
        ar, br = (sum(map(_product, p, rest)) for p in (one, two))
        size = aa * bb - ab * ab
        return [(ar * bb - br * ab) / size, (br * aa - ar * ab) / size] if size else None


def _divided(c: Value, s: Value, length: Value) -> tuple[Value, Value]:
    """The cosine and sine of an angle of which they are multiples; of 0, which serves, where any angle does."""
    return (c / length, s / length) if length else (1, 0)


def _volume(posture: _Posture) -> Value:
    (a, b, c), (x, y, z) = posture.slides
    p, q, r = posture.rest
    return (b * z - c * y) * p + (c * x - a * z) * q + (a * y - b * x) * r


def _turn(c: Value, s: Value) -> Matrix:
    return [[c, -s, 0], [s, c, 0], [0, 0, 1]]


def _product(x: Value, y: Value) -> Value:
    return x * y


def _times(left: Matrix, right: Matrix) -> Matrix:
    return [[sum(map(_product, row, column)) for column in zip(*right, strict=True)] for row in left]


def _column(matrix: Matrix, vector: Vector) -> Vector:
    return [sum(map(_product, row, vector)) for row in matrix]


def _transposed(matrix: Matrix) -> Matrix:
    return [list(column) for column in zip(*matrix, strict=True)]
