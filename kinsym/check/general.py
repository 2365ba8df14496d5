"""All solutions of a six-joint arm without a closed form, with 50 digits: elimination, Newton's method, sifting."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from kinsym.check.elimination import Elimination, Joint, Motion, inverted, product
from kinsym.check.evaluate import Arithmetic, Program
from kinsym.check.linear import Matrix, Value, Vector
from kinsym.check.slides import SlidingLoop
from kinsym.general.plan import Cut, GeneralPlan

Kinematics = Callable[[Sequence[Value]], list[list[Value]]]

ACCEPTED = 1e-10
REPEATED = 1e-6
HALFWAY = 1e-12
CROWDED = 1e-3
BESIDE = 0.01
EXACT = 1e-40
STEPS = 16
SMALLEST_PIVOT = 1e-12
LONGEST_STEP = 0.5


class GeneralOracle:
    """The inverse kinematics of a general plan for one choice of parameters.

    It opens the loop where the generated code looks second, so that the two reductions have nothing in common.
    """

    def __init__(
        self,
        ctx: Any,
        numbers: Arithmetic,
        plan: GeneralPlan,
        given: Mapping[str, Value],
        kinematics: tuple[Kinematics, Kinematics],
    ) -> None:
        self.ctx, self.plan = ctx, plan
        self.forward, self.jacobian = kinematics
        self.kinds = plan.kinds[:5] if plan.virtual else plan.kinds
        entries = [Program((), link.entries, numbers)(given) for link in plan.transforms]
        self._base, *self._links = ((_rows(values[:9]), list(values[9:])) for values in entries)

    def solutions(self, rows: list[list[Value]]) -> list[Vector]:
        """The joint vectors of a pose (three rows of four), sorted as in the generated code."""
        wanted: Motion = [row[:3] for row in rows], [row[3] for row in rows]
        length = self._length(wanted)
        cuts = self.plan.cuts or tuple(Cut.before(number) for number in self.plan.suppressed)
        found, certain = self._found(cuts[-1], wanted, rows, length, [])
        if not certain:
            found, _ = self._found(cuts[0], self._beside(wanted, length), rows, length, found)
        found.sort(key=lambda q: [self.ctx.nint(x / unit * 10**6) for x, unit in self._in_units(q, length)])
        return found[: self.plan.maximum]

    def _closing(self, wanted: Motion) -> Motion:
        ctx = self.ctx
        return product(ctx, product(ctx, self._links[5], inverted(ctx, wanted)), self._base)

    def _length(self, wanted: Motion) -> Value:
        """The unit of length: the mean length of the links, more for a pose that only slides reach."""
        ctx = self.ctx
        mean = ctx.fsum(ctx.norm(link[1]) for link in self._links[:5]) / 5
        return max(mean, ctx.norm(self._closing(wanted)[1]) / 5) or ctx.one

    def _beside(self, wanted: Motion, length: Value) -> Motion:
        """A pose turned and shifted by a hundredth, at which no solutions share an angle by symmetry."""
        c, s = self.ctx.cos(BESIDE), self.ctx.sin(BESIDE)
        zero, one = self.ctx.zero, self.ctx.one
        turn: Motion = [[c, -s, zero], [s, c, zero], [zero, zero, one]], [zero] * 3
        tilt: Motion = [[one, zero, zero], [zero, c, -s], [zero, s, c]], [BESIDE * length, -BESIDE * length / 2, zero]
        return product(self.ctx, product(self.ctx, wanted, turn), tilt)

    def _found(
        self, cut: Cut, posed: Motion, rows: list[list[Value]], length: Value, before: list[Vector]
    ) -> tuple[list[Vector], bool]:
        """The solutions that one cut finds from a pose, with those found before, and whether there can be no more."""
        ctx = self.ctx
        links = [(turn, [t / length for t in shift]) for turn, shift in (*self._links[:5], self._closing(posed))]
        joints = [Joint(kind, sign) for kind, sign in zip(self.plan.kinds, self.plan.signs, strict=True)]
        loop = (SlidingLoop if self.plan.suppressed else Elimination)(ctx, cut, joints, links)
        angles = loop.angles()
        found = list(before)
        for values in loop.candidates(angles):
            q = [ctx.zero] * 6
            for number, value in zip(cut.order, values, strict=True):
                q[number - 1] = value * length if joints[number - 1].kind == "P" else value
            polished = self._polished(q[: len(self.kinds)], rows, length)
            if polished is not None and not any(self._same(polished, other, rows, length) for other in found):
                found.append(polished)
        alone = sorted(q[cut.suppressed - 1] for q in found)
        shared = 3 if cut.bordered else 2
        crowded = any(high - low < CROWDED for low, high in zip(alone, alone[shared - 1 :], strict=False))
        return found, len(angles) == len(found) and not crowded

    def _polished(self, q: Vector, rows: list[list[Value]], length: Value) -> Vector | None:
        """The joint vector brought onto the pose by Newton's method; None if it does not get there."""
        best, closest = q, self.ctx.inf
        for step in range(STEPS):
            reached = self.forward(q)
            off = self._off(reached, rows, length)
            if off < closest:
                best, closest = q, off
            if off < EXACT or (off > 0.1 and step >= 4) or (off > 1e-3 and step >= 7):
                break
            q = self._stepped(q, reached, rows, length)
        if closest >= ACCEPTED:
            return None
        return [self._wrapped(value) if kind == "R" else value for value, kind in zip(best, self.kinds, strict=True)]

    def _off(self, reached: Matrix, rows: Matrix, length: Value) -> Value:
        """The largest difference of the entries that count, lengths in units of the arm's."""
        return max(
            abs(a - b) / (length if j == 3 else 1)
            for row, other in zip(reached, rows, strict=True)
            for j, (a, b) in enumerate(zip(row, other, strict=True))
            if j >= 2 or not self.plan.virtual
        )

    def _stepped(self, q: Vector, reached: Matrix, rows: Matrix, length: Value) -> Vector:
        """One Newton step, no longer than half a radian; motions that the pose does not feel are left alone."""
        ctx = self.ctx
        units = [unit for _, unit in self._in_units(q, length)]
        slope = [[entry * unit for entry, unit in zip(row, units, strict=True)] for row in self.jacobian(q)]
        slope = [[entry / length for entry in row] for row in slope[:3]] + slope[3:]
        error = [(rows[i][3] - reached[i][3]) / length for i in range(3)]
        if self.plan.virtual:
            axis, aim = [row[2] for row in reached], [row[2] for row in rows]
            error += _cross(axis, aim)
            along = [ctx.fdot(axis, column) for column in zip(*slope[3:], strict=True)]
            slope[3:] = [
                [a - n * b for a, b in zip(row, along, strict=True)] for n, row in zip(axis, slope[3:], strict=True)
            ]
        else:
            turns = [_cross([row[j] for row in reached], [row[j] for row in rows]) for j in range(3)]
            error += [ctx.fsum(parts) / 2 for parts in zip(*turns, strict=True)]
        step = _least(ctx, slope, error)
        size = ctx.norm(step)
        share = min(1, LONGEST_STEP / size) if size else 1
        return [value + share * move * unit for value, move, unit in zip(q, step, units, strict=True)]

    def _in_units(self, q: Vector, length: Value) -> list[tuple[Value, Value]]:
        return [(value, length if kind == "P" else 1) for value, kind in zip(q, self.kinds, strict=True)]

    def _wrapped(self, angle: Value) -> Value:
        ctx = self.ctx
        return angle - 2 * ctx.pi * ctx.ceil((angle - ctx.pi) / (2 * ctx.pi))

    def _same(self, left: Vector, right: Vector, rows: list[list[Value]], length: Value) -> bool:
        """Whether two solutions are one: they agree, or are near and halfway between them is as good a place."""
        gaps = [
            a - b if kind == "P" else self._wrapped(a - b) for a, b, kind in zip(left, right, self.kinds, strict=True)
        ]
        widest = max(abs(gap) / unit for gap, unit in self._in_units(gaps, length))
        if widest < REPEATED or widest > CROWDED:
            return bool(widest < REPEATED)
        halfway = [b + gap / 2 for b, gap in zip(right, gaps, strict=True)]
        worst = max(self._off(self.forward(q), rows, length) for q in (left, right))
        return bool(self._off(self.forward(halfway), rows, length) < max(HALFWAY, 4 * worst))


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


def _rows(values: Sequence[Value]) -> Matrix:
    return [list(values[start : start + 3]) for start in (0, 3, 6)]
