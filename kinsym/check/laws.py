"""The laws that every answer must keep, whatever the robot and the language.

Two joint vectors count as the same solution when a way between them stays on the pose: then they are one double
root, or two members of the family of a free joint. Different branches are never joined so. It is the one notion of
sameness that holds at singular poses, where angles are known far worse than the pose.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.curve import Curve
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Solutions
from kinsym.check.task import closure, rounding, units
from kinsym.check.tracing import Tracer
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.robot.model import Task

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

CLOSURE = 1e-9
#: Closure allowed on a way between two vectors that count as one solution.
PATH = 1e-11
FORWARD = 1e-12
SAME = 1e-8
COPY = 1e-7
POINTS = (0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True)
class Judge:
    """Measures solutions against poses, for one robot and one choice of parameters."""

    kinematics: TreeKinematics
    task: Task
    revolute: Mask
    tau: float
    #: Closure allowed on a way; wider where a task has more equations than joints, which then cannot all be met.
    path: float = PATH

    def closures(self, q: Floats, poses: Floats) -> Floats:
        """(m, S, n) solutions of (m, 4, 4) poses to their closure (m, S); NaN where there is none."""
        with np.errstate(invalid="ignore"):
            reached = self.kinematics.forward(q)
            return closure(reached, poses[:, None], self.task, self.kinematics.size)

    def joined(self, start: Floats, end: Floats, poses: Floats, *, one_is_enough: bool = False) -> Mask:
        """Whether ways from (m, S, n) to (m, 1 or S, n) stay on the poses: (m, S).

        Vectors that are the same within :data:`SAME` are joined. Straight lines are tried first, then the nearest way,
        then the whole curve on which the pose hardly changes. With ``one_is_enough`` the search is over in rows that
        have a way.
        """
        limit, unit = self.path + 4 * self.tau, units(self.revolute, self.kinematics.size)
        with np.errstate(invalid="ignore"):
            way = wrapped(end - start, self.revolute)
            steps = [start + t * way for t in POINTS]
            hidden = [rounding(q, self.revolute, self.kinematics.size) for q in steps]
            near = [self.closures(q, poses) <= limit + more for q, more in zip(steps, hidden, strict=True)]
            straight = np.asarray(np.all(near, axis=0) | (np.abs(way) <= SAME * unit).all(axis=-1))
        open_ = ~straight & np.isfinite(way).all(axis=-1)
        if one_is_enough:
            open_ &= ~straight.any(axis=1, keepdims=True)
        if open_.any():
            rows = np.nonzero(open_)[0]
            tracer = Tracer(self.kinematics, self.task, limit, self.revolute)
            straight[open_] = tracer.joined(start[open_] / unit, way[open_] / unit, poses[rows])
        open_ &= ~straight
        if one_is_enough:
            open_ &= ~straight.any(axis=1, keepdims=True)
        if open_.any():
            rows = np.nonzero(open_)[0]
            ends = start[open_] / unit, (start + way)[open_] / unit
            straight[open_] = Curve(tracer).joined(*ends, poses[rows])
        return straight

    def found(self, solutions: Floats, known: Floats, poses: Floats) -> Mask:
        """Whether the known joint vectors (m, n) are among the solutions (m, S, n): (m,)."""
        return np.asarray(self.joined(solutions, known[:, None], poses, one_is_enough=True).any(axis=1))

    def copies(self, solutions: Floats) -> int:
        """Pairs of solutions of one pose closer than :data:`COPY` in every joint."""
        most = solutions.shape[1]
        total = 0
        with np.errstate(invalid="ignore"):
            for i in range(most):
                gap = np.abs(wrapped(solutions[:, i + 1 :] - solutions[:, i : i + 1], self.revolute))
                total += int(np.count_nonzero(np.all(gap < COPY, axis=-1)))
        return total

    def agreement(self, left: Solutions, right: Solutions, poses: Floats) -> tuple[Mask, Mask]:
        """Compare two answers: where they are the same in the same order, and where at least the same sets.

        Solutions are the same within :data:`SAME` or when they are joined. Answers that agree as sets only lie
        at the edge of a tolerance band: one merges a double root, the other does not.
        """
        (a, count_a), (b, count_b) = left, right
        width = max(a.shape[1], b.shape[1])
        a, b = _padded(a, width), _padded(b, width)
        with np.errstate(invalid="ignore"):
            near = np.all(
                np.abs(wrapped(b - a, self.revolute)) <= SAME * np.where(self.revolute, 1.0, self._reach), axis=-1
            )
        missing = np.isnan(a).any(axis=-1) & np.isnan(b).any(axis=-1)
        same: Mask = np.asarray((count_a == count_b) & np.all(near | missing, axis=-1))
        rows = np.flatnonzero((count_a == count_b) & ~same)
        if rows.size:
            fine: Mask = np.asarray(near | missing)
            same[rows] = np.all(fine[rows] | self.joined(a[rows], b[rows], poses[rows]), axis=-1)
        sets: Mask = same.copy()
        for row in np.flatnonzero(~same):
            sets[row] = self.covers(a[row], b[row], poses[row]) and self.covers(b[row], a[row], poses[row])
        return same, sets

    @property
    def _reach(self) -> float:
        return max(self.kinematics.size, 1e-300) if self.kinematics.size > 0 else 1.0

    def covers(self, some: Floats, all_: Floats, pose: Floats) -> bool:
        """Whether each solution of one answer (k, n) is, or is joined to, one of another answer (l, n)."""
        some = some[~np.isnan(some).any(axis=-1)]
        if not len(some):
            return True
        start = np.broadcast_to(all_[None], (len(some), *all_.shape))
        poses = np.broadcast_to(pose, (len(some), 4, 4))
        ways = self.joined(np.ascontiguousarray(start), some[:, None], poses, one_is_enough=True)
        return bool(ways.any(axis=1).all())


def _padded(q: Floats, width: int) -> Floats:
    if q.shape[1] == width:
        return q
    return np.concatenate([q, np.full((len(q), width - q.shape[1], q.shape[2]), np.nan)], axis=1)


def outward(poses: Floats, size: float) -> Floats:
    """The same orientations at positions far beyond any reach of revolute joints."""
    position = poses[:, :3, 3]
    length = np.linalg.norm(position, axis=1, keepdims=True)
    direction = np.where(length > 0, position / np.where(length > 0, length, 1.0), np.array([0.6, 0.0, 0.8]))
    moved = poses.copy()
    moved[:, :3, 3] = direction * (100.0 * max(size, float(length.max(initial=0.0)), 1e-3))
    return moved


def malformed(pose: Floats) -> dict[str, Floats]:
    """Arrays (4, 4) that are no poses, each made from one that is."""
    cases: dict[str, Floats] = {}

    def case(name: str, row: int | slice, column: int | slice, value: float, factor: float = 0.0) -> None:
        changed = pose.copy()
        changed[row, column] = changed[row, column] * factor + value
        cases[name] = changed

    first = slice(0, 3)
    case("NaN in the rotation", 0, 0, np.nan)
    case("NaN in the position", 1, 3, np.nan)
    case("infinite position", 2, 3, np.inf)
    case("huge position", 0, 3, 1e200)
    case("reflection", first, 2, 0.0, -1.0)
    case("zero rotation", first, first, 0.0)
    case("rotation scaled by 1.01", first, first, 0.0, 1.01)
    case("bottom row 0 0 0 2", 3, 3, 2.0)
    case("bottom row 1e-3 0 0 1", 3, 0, 1e-3)
    case("NaN in the bottom row", 3, 1, np.nan)
    case("all zero", slice(0, 4), slice(0, 4), 0.0)
    return cases
