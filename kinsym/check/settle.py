"""Marked solutions of the exact walk, made sure of by the forward kinematics.

Next to a singular pose a closed form answers with what the equation would give on the singularity: with two roots in
one, with a root in doubt, with an angle that is known to a few digits. What of this is true the pose decides. A vector
that misses it is moved there by the Levenberg-Marquardt method, damped by the distance that is left: that converges
fast also where the Jacobian loses rank (Yamashita and Fukushima, 2001, for the damping by the square of the residual).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from kinsym.check.marks import Mark
from kinsym.check.task import ENTRIES, POSITION
from kinsym.emit.schedule import JointName
from kinsym.robot.model import Task

Value = Any
Vector = list[Value]
Matrix = list[list[Value]]

#: A vector this many tau from the pose is on it.
ON_THE_POSE = 4
#: A root that is not in doubt was found if it is polished to this distance; the pose itself may be off by the rest.
POLISHED = 1e-9
#: One in doubt must come as near as this.
CERTAIN = 1e-12
#: By this share of its length a slide that is drawn out far hides a distance from doubles.
ROUNDING = 2**-50
#: Two vectors as near in every joint, in radians or sizes of the arm, are one if one of them was in doubt, and if one
#: of them was moved.
ALIKE = 1e-3
MOVED = 1e-6

STARTS = 4
#: How far a free joint is turned from start to start, in radians or sizes of the arm.
TURN = 1.5
PASSES = 40
#: Half the digits: what the normal equations, which square the damping, can still tell.
NEAREST = 1e-25
LEAST_DAMPING = 1e-20
#: The least damping of steps that lead back onto the curve along which the pose hardly feels a motion, and how many.
STEADY = 1e-7
BACK = 4
#: Slides that are drawn out so far, in sizes of the arm, leave doubles no digits for the rest: nothing is reached.
FAR = 1e9
#: So many passes in a row that gain less than this share of the distance have met a least one that is not zero. Few
#: are too few: where the Jacobian nearly loses rank the damping falls from pass to pass before anything is gained.
IDLE = 10
LEAST_GAIN = 1e-6


class Goal(NamedTuple):
    """A pose (three rows of four), the size of the arm (1 if it has none) and the distance that counts as none."""

    rows: Sequence[Sequence[Value]]
    size: Value
    reach: Value


class Solution(NamedTuple):
    """A joint vector, its place among all branches, and how near another one must be to be the same (0: none is)."""

    branch: int
    q: Vector
    alike: float = 0


class Settler:
    """Settles the solutions of one arm; ``forward`` and ``jacobian`` are its exact kinematics.

    A joint in ``locked`` keeps its value. With ``gate`` the arm reaches few poses, and a solution has to come nearer:
    the size of the goal, which has the coordinates of the pose in it, is up to four times the arm's.
    """

    def __init__(
        self,
        ctx: Any,
        *,
        joints: Sequence[JointName],
        task: Task,
        forward: Callable[[Vector], Matrix],
        jacobian: Callable[[Vector], Matrix],
        wrap: Callable[[Value], Value],
        locked: Sequence[str] = (),
        gate: bool = False,
    ) -> None:
        self._ctx, self._forward, self._jacobian, self._wrap = ctx, forward, jacobian, wrap
        self._enough = POLISHED / 4 if gate else POLISHED
        self._names = [joint.name for joint in joints]
        self._slides = [joint.kind == "P" for joint in joints]
        self._moves = [joint.name not in locked for joint in joints]
        self._entries = ENTRIES[task]

    def settle(self, given: Solution, twin: int, mark: Mark, goal: Goal, free: Sequence[str] = ()) -> list[Solution]:
        """The solutions that a marked vector stands for: none, itself or what it became, or two.

        Two where roots met that had to be parted; the second, on branch ``twin``, is the first one's mirror image.
        ``free`` are the joints that took their values from the reference.
        """
        start = given.q
        left = self._distance(self._differences(self._forward(start), goal)) + self._rounding(start, goal)
        if left <= goal.reach:
            return [given]
        q, left = self._polished(start, goal, free if Mark.DOUBTFUL in mark else ())
        if left > max(goal.reach, CERTAIN if Mark.DOUBTFUL in mark else self._enough):
            return []
        found = [given._replace(q=self._in_range(q), alike=max(given.alike, MOVED))]
        if Mark.BORDER in mark:
            mirrored, left = self._polish([2 * a - b for a, b in zip(start, q, strict=True)], goal)
            if left <= goal.reach:
                found.append(Solution(twin, self._in_range(mirrored), ALIKE))
        return found

    def without_copies(self, found: Sequence[Solution], size: Value) -> list[Solution]:
        """The solutions less those that turned out to be another one."""
        kept: list[Solution] = []
        for number, solution in enumerate(found):
            surer = [other for other in found[number + 1 :] if other.alike < solution.alike]
            if not any(self._alike(solution, other, size) for other in (*kept, *surer)):
                kept.append(solution)
        return kept

    def _alike(self, solution: Solution, other: Solution, size: Value) -> bool:
        return solution.alike > 0 and all(
            abs(a - b) <= solution.alike * size if slides else abs(self._wrap(a - b)) <= solution.alike
            for a, b, slides in zip(solution.q, other.q, self._slides, strict=True)
        )

    def _in_range(self, q: Vector) -> Vector:
        turns = (moves and not slides for moves, slides in zip(self._moves, self._slides, strict=True))
        return [self._wrap(value) if turning else value for value, turning in zip(q, turns, strict=True)]

    def _polished(self, start: Vector, goal: Goal, free: Sequence[str]) -> tuple[Vector, Value]:
        """The vector that the pose is reached from, from ``start`` or beside it, with the distance that is left.

        Where two borders cross the distance is stationary, and only a start beside it gets away; where the reference
        put a ``free`` joint so that the others cannot follow, it is turned as well. A slide that was divided by next to
        nothing is far off; the last start, the only one if it is FAR, has none longer than the arm.
        """
        ctx, inside = self._ctx, self._drawn_in(start, goal)
        if any(abs(a - b) > FAR * goal.size for a, b in zip(start, inside, strict=True)):
            return self._polish(inside, goal)
        best, least = self._polish(start, goal)
        for trial in range(1, STARTS):
            if least <= goal.reach:
                break
            aside = least ** (ctx.mpf(1) / (1 + trial))
            away = [
                aside * ctx.cos(1 + number) + (TURN * trial if name in free else 0)
                for number, name in enumerate(self._names)
            ]
            q, left = self._polish(self._moved(start, away, goal), goal)
            if left < least:
                best, least = q, left
        if least > goal.reach and inside != start:
            q, left = self._polish(inside, goal)
            if left < least:
                best, least = q, left
        return best, least

    def _drawn_in(self, q: Vector, goal: Goal) -> Vector:
        """``q`` with the slides no longer than the arm, locked ones as they are."""
        return [
            min(max(value, -goal.size), goal.size) if slides and moves else value
            for value, slides, moves in zip(q, self._slides, self._moves, strict=True)
        ]

    def _polish(self, q: Vector, goal: Goal) -> tuple[Vector, Value]:
        """Least squares from one start: the vector and its distance."""
        ctx = self._ctx
        pose = self._forward(q)
        errors = self._differences(pose, goal)
        left, caution, idle = self._distance(errors), ctx.mpf(1), 0
        slopes: Matrix = []
        for _ in range(PASSES):
            if left <= NEAREST or idle >= IDLE:
                break
            damping = max(left * caution, ctx.mpf(LEAST_DAMPING))
            slopes = slopes or self._slopes(q, pose, goal)
            trial, there, missed = self._led_back(self._moved(q, self._step(slopes, errors, damping), goal), left, goal)
            reached = self._distance(missed)
            idle = 0 if left - reached > LEAST_GAIN * left else idle + 1
            if reached < left:
                q, pose, errors, left, caution, slopes = trial, there, missed, reached, caution / 10, []
            else:
                caution *= 10
        return q, left + self._rounding(q, goal)

    def _led_back(self, q: Vector, left: Value, goal: Goal) -> tuple[Vector, Matrix, Vector]:
        """A vector, its pose and what that misses, brought nearer than ``left`` if it can be.

        The damping leaves alone what the pose hardly feels: a long step in that direction leaves the curve on which
        the pose stays, and is judged by where it leads on the curve.
        """
        there = self._forward(q)
        missed = self._differences(there, goal)
        reached = self._distance(missed)
        for _ in range(BACK if reached > 2 * left else 0):
            if reached < left:
                break
            step = self._step(self._slopes(q, there, goal), missed, max(reached, self._ctx.mpf(STEADY)))
            q = self._moved(q, step, goal)
            there = self._forward(q)
            missed = self._differences(there, goal)
            before, reached = reached, self._distance(missed)
            if reached >= before / 10:
                break
        return q, there, missed

    def _moved(self, q: Vector, step: Vector, goal: Goal) -> Vector:
        """``q`` and a step whose lengths are in sizes of the arm."""
        return [
            value + change * (goal.size if slides else 1) if moves else value
            for value, change, slides, moves in zip(q, step, self._slides, self._moves, strict=True)
        ]

    def _differences(self, pose: Matrix, goal: Goal) -> Vector:
        """What a pose misses of the goal, entry by entry of the task, lengths in sizes of the arm."""
        return [(pose[i][j] - goal.rows[i][j]) / (goal.size if j == POSITION else 1) for i, j in self._entries]

    def _distance(self, differences: Vector) -> Value:
        return self._ctx.sqrt(sum(value * value for value in differences))

    def _rounding(self, q: Vector, goal: Goal) -> Value:
        """What rounding hides of the distance where slides are drawn out far."""
        longest = max((abs(value) for value, slides in zip(q, self._slides, strict=True) if slides), default=0)
        return ROUNDING * longest / goal.size

    def _slopes(self, q: Vector, pose: Matrix, goal: Goal) -> Matrix:
        """The derivatives of the differences, a row for each joint. A column of the rotation moves by omega x it."""
        jacobian = self._jacobian(q)
        slopes = []
        for joint, slides in enumerate(self._slides):
            velocity = [row[joint] for row in jacobian]
            row = []
            for i, j in self._entries:
                if j == POSITION:
                    slope = velocity[i] / goal.size
                else:
                    k, m = (i + 1) % 3, (i + 2) % 3
                    slope = velocity[3 + k] * pose[m][j] - velocity[3 + m] * pose[k][j]
                row.append(slope * (goal.size if slides else 1) if self._moves[joint] else self._ctx.mpf(0))
            slopes.append(row)
        return slopes

    def _step(self, slopes: Matrix, errors: Vector, damping: Value) -> Vector:
        """The step that takes the errors away best, by the damped normal equations."""
        ctx = self._ctx
        square = ctx.matrix(len(slopes))
        for i, left in enumerate(slopes):
            for j, right in enumerate(slopes[: i + 1]):
                square[i, j] = square[j, i] = ctx.fdot(left, right)
            square[i, i] += damping * damping
        side = ctx.matrix([-ctx.fdot(row, errors) for row in slopes])
        return list(ctx.cholesky_solve(square, side))
