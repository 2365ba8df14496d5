"""Newton's method with 50 digits: joint vectors brought onto a pose, and which of them are the same solution."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from kinsym.check.linear import Matrix, Value, Vector

Kinematics = Callable[[Sequence[Value]], list[list[Value]]]

ACCEPTED = 1e-10
REPEATED = 1e-6
HALFWAY = 1e-12
CROWDED = 1e-3
EXACT = 1e-40
STILL = 1e-25
"""A step that short, in radians and units of the arm, has doubled its digits to all 50: the next would change nothing.
A pose in doubles is no exact motion, so that no joint vector comes much nearer to it than 1e-17."""
STEPS = 16
SMALLEST_PIVOT = 1e-12
LONGEST_STEP = 0.5


@dataclass(frozen=True)
class Newton:
    """The joints ``kinds`` with their forward kinematics (three rows of four) and Jacobian (six rows).

    With ``spin`` a turn of the pose about its own z axis does not count. ``accepted`` is how far off its pose a
    solution may be, lengths in units of the arm's.
    """

    ctx: Any
    kinds: str
    forward: Kinematics
    jacobian: Kinematics
    spin: bool = False
    accepted: float = ACCEPTED

    def polished(self, q: Vector, rows: Matrix, length: Value) -> Vector | None:
        """The joint vector brought onto the pose by Newton's method; None if it does not get there."""
        best, closest, moved = q, self.ctx.inf, self.ctx.inf
        for step in range(STEPS):
            reached = self.forward(q)
            off = self.off(reached, rows, length)
            if off < closest:
                best, closest = q, off
            if off < EXACT or moved < STILL or (off > 0.1 and step >= 4) or (off > 1e-3 and step >= 7):
                break
            q, moved = self._stepped(q, reached, rows, length)
        if closest >= self.accepted:
            return None
        return [self._wrapped(value) if kind == "R" else value for value, kind in zip(best, self.kinds, strict=True)]

    def off(self, reached: Matrix, rows: Matrix, length: Value) -> Value:
        """The largest difference of the entries that count, lengths in units of the arm's."""
        return max(
            abs(a - b) / (length if j == 3 else 1)
            for row, other in zip(reached, rows, strict=True)
            for j, (a, b) in enumerate(zip(row, other, strict=True))
            if j >= 2 or not self.spin
        )

    def _stepped(self, q: Vector, reached: Matrix, rows: Matrix, length: Value) -> tuple[Vector, Value]:
        """One Newton step, no longer than half a radian, and its length.

        Motions that the pose does not feel are left alone.
        """
        return self.advanced(q, _least(self.ctx, *self.linearised(q, reached, rows, length)), length)

    def linearised(self, q: Vector, reached: Matrix, rows: Matrix, length: Value) -> tuple[Matrix, Vector]:
        """The Jacobian and the twist that is missing of the pose, lengths in units of the arm's."""
        ctx = self.ctx
        units = [unit for _, unit in self.in_units(q, length)]
        slope = [[entry * unit for entry, unit in zip(row, units, strict=True)] for row in self.jacobian(q)]
        slope = [[entry / length for entry in row] for row in slope[:3]] + slope[3:]
        error = [(rows[i][3] - reached[i][3]) / length for i in range(3)]
        if self.spin:
            axis, aim = [row[2] for row in reached], [row[2] for row in rows]
            error += _cross(axis, aim)
            along = [ctx.fdot(axis, column) for column in zip(*slope[3:], strict=True)]
            slope[3:] = [
                [a - n * b for a, b in zip(row, along, strict=True)] for n, row in zip(axis, slope[3:], strict=True)
            ]
        else:
            turns = [_cross([row[j] for row in reached], [row[j] for row in rows]) for j in range(3)]
            error += [ctx.fsum(parts) / 2 for parts in zip(*turns, strict=True)]
        return slope, error

    def advanced(self, q: Vector, step: Vector, length: Value) -> tuple[Vector, Value]:
        """The joints after a step that is given in units of the arm's, half a radian of it at most, and its length."""
        size = self.ctx.norm(step)
        share = min(1, LONGEST_STEP / size) if size else 1
        units = [unit for _, unit in self.in_units(q, length)]
        return [value + share * move * unit for value, move, unit in zip(q, step, units, strict=True)], share * size

    def in_units(self, q: Vector, length: Value) -> list[tuple[Value, Value]]:
        return [(value, length if kind == "P" else 1) for value, kind in zip(q, self.kinds, strict=True)]

    def _wrapped(self, angle: Value) -> Value:
        ctx = self.ctx
        return angle - 2 * ctx.pi * ctx.ceil((angle - ctx.pi) / (2 * ctx.pi))

    def same(self, left: Vector, right: Vector, rows: Matrix, length: Value) -> bool:
        """Whether two solutions are one: they agree, or are near and halfway between them is as good a place."""
        gaps = [
            a - b if kind == "P" else self._wrapped(a - b) for a, b, kind in zip(left, right, self.kinds, strict=True)
        ]
        widest = max(abs(gap) / unit for gap, unit in self.in_units(gaps, length))
        if widest < REPEATED or widest > CROWDED:
            return bool(widest < REPEATED)
        halfway = [b + gap / 2 for b, gap in zip(right, gaps, strict=True)]
        worst = max(self.off(self.forward(q), rows, length) for q in (left, right))
        return bool(self.off(self.forward(halfway), rows, length) < max(HALFWAY, 4 * worst))


def _least(ctx: Any, rows: Matrix, right: Vector) -> Vector:
    """The solution of a linear system, zero along what its matrix does not see (complete pivoting)."""
    rows = [[*row, value] for row, value in zip(rows, right, strict=True)]
    columns = len(rows[0]) - 1
    order = list(range(columns))
    rank = 0
    for k in range(columns):
        i, j = max(
            ((i, j) for i in range(k, len(rows)) for j in range(k, columns)), key=lambda p: abs(rows[p[0]][p[1]])
        )
        if abs(rows[i][j]) <= SMALLEST_PIVOT * abs(rows[0][0] if k else 0) or not rows[i][j]:
            break
        rows[k], rows[i] = rows[i], rows[k]
        order[k], order[j] = order[j], order[k]
        for row in rows:
            row[k], row[j] = row[j], row[k]
        for row in rows[k + 1 :]:
            factor = row[k] / rows[k][k]
            for n in range(k, columns + 1):
                row[n] -= factor * rows[k][n]
        rank = k + 1
    x = [ctx.zero] * columns
    for k in range(rank - 1, -1, -1):
        x[k] = (rows[k][columns] - ctx.fdot(rows[k][k + 1 : rank], x[k + 1 : rank])) / rows[k][k]
    result = [ctx.zero] * columns
    for place, value in zip(order, x, strict=True):
        result[place] = value
    return result


def _cross(left: Vector, right: Vector) -> Vector:
    (a, b, c), (x, y, z) = left, right
    return [b * z - c * y, c * x - a * z, a * y - b * x]
