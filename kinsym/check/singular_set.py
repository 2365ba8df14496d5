"""Does the singular set hold? det J of the generated Jacobian against the product, and J at the zeros of each factor.

The factors were proved modulo the prime; here the numbers of the generated code are held to them, and a zero is found
by bisection along one joint, as somebody would who only had the code.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.algebra.tree import Sym, Tree, symbols
from kinsym.check.evaluate import Compiled, Program, compiled, floating
from kinsym.check.ledger import Ledger
from kinsym.check.solvers import Solver
from kinsym.check.task import task_jacobian
from kinsym.check.walk import AT_THE_ORIGIN
from kinsym.emit.schedule import Schedule, SingularPoses
from kinsym.kinematics.singular import Condition
from kinsym.robot.model import Task

Floats = NDArray[np.float64]

DETERMINANT_LAW = "det J is the product of its factors"
ZERO_LAW = "J loses a motion where a factor is zero"

DETERMINANT_LIMIT = 1e-10
#: The smallest singular value of J at a zero, against the largest.
ZERO_LIMIT = 1e-9
ZEROS = 6
GRID = 48
HALVINGS = 60


def hold_singular_set(
    ledger: Ledger, target: Solver, schedule: Schedule, parameters: Mapping[str, Fraction], starts: Floats
) -> None:
    """Both laws on one target; ``starts`` are joint vectors (m, n)."""
    if schedule.singular is None:
        return
    numbers = SingularNumbers(schedule, schedule.singular, parameters)
    errors = numbers.determinant_errors(starts, numbers.moving(target.jacobian(starts)), target.forward(starts))
    if errors.size:
        ledger.judge(DETERMINANT_LAW, target.name, errors, DETERMINANT_LIMIT)
    size = numbers.size
    reach = np.array([np.pi if joint.kind == "R" else max(size, 1.0) for joint in schedule.joints])
    zeros = list(numbers.zeros(starts, reach))
    if zeros:
        q = np.stack(zeros)
        left = smallest(numbers.moving(target.jacobian(q)), target.forward(q), schedule.task, size)
        ledger.judge(ZERO_LAW, target.name, left, ZERO_LIMIT)


class SingularNumbers:
    """The singular set of a schedule for one choice of parameters, in float64."""

    def __init__(self, schedule: Schedule, poses: SingularPoses, parameters: Mapping[str, Fraction]) -> None:
        self._numbers = floating()
        self._task = schedule.task
        self._set = poses.set
        self._joints = [joint.name for joint in schedule.joints]
        self._moving = [place for place, name in enumerate(self._joints) if name not in schedule.locked]
        held = {item.name for item in schedule.held}
        self._free = [place for place, name in enumerate(self._joints) if name not in held]
        self._held = Program(schedule.held, (), self._numbers)
        given: dict[str, Any] = {name: value.numerator / value.denominator for name, value in parameters.items()}
        self._given = Program(schedule.constants, (), self._numbers).names(given)
        self._angles = Program(poses.angles, (), self._numbers)
        self._sums = {item.name: item.value for item in (*poses.angles, *schedule.held)}
        self.size = float(Program((), (schedule.size,), self._numbers)({**AT_THE_ORIGIN, **self._given})[0])

    def moving(self, jacobian: Floats) -> Floats:
        """The columns (..., 6, k) of joints that no lock holds."""
        return jacobian[..., self._moving]

    def determinant_errors(self, q: Floats, jacobian: Floats, poses: Floats) -> Floats:
        """|det J - product| against the product of the lengths of J's columns, shape (m,); empty where J is not square.

        ``q`` (m, n), ``jacobian`` (m, 6, k) of the joints that move, ``poses`` (m, 4, 4).
        """
        if not self._set.square:
            return np.empty(0)
        matrix = _square(jacobian, poses, self._task)
        product = compiled(self._set.determinant, self._numbers)(self._names(q))
        scale = np.prod(np.linalg.norm(matrix, axis=-2), axis=-1)
        return np.asarray(np.abs(np.linalg.det(matrix) - product) / np.maximum(scale, np.finfo(float).tiny))

    def zeros(self, starts: Floats, reach: Floats) -> Iterator[Floats]:
        """Joint vectors at which a condition holds, each found from one of the ``starts`` (m, n)."""
        for condition in self._set.listed:
            if not condition.whole:
                continue
            found = 0
            for start in starts:
                joints = self._zero(condition, start, reach)
                if joints is not None:
                    yield joints
                    found += 1
                if found == ZEROS:
                    break

    def _names(self, q: Floats) -> dict[str, Any]:
        values = {name: q[..., place] for place, name in enumerate(self._joints)}
        return self._angles.names(self._held.names({**self._given, **values}))

    def _zero(self, condition: Condition, start: Floats, reach: Floats) -> Floats | None:
        """The start with joints moved so that every expression of the condition vanishes, one after the other."""
        q, moved = start.copy(), set[int]()
        for value in sorted(condition.values, key=lambda value: len(self._movers(value))):
            function = compiled(value, self._numbers)
            places = [place for place in self._movers(value) if place not in moved]
            for place in places[::-1]:
                root = self._root(function, q, place, float(reach[place]))
                if root is not None:
                    q[place] = root
                    moved |= set(self._movers(value))
                    break
            else:
                return None
        return q

    def _movers(self, value: Tree) -> list[int]:
        """The joints that an expression depends on and that stand at no value of the table; an input takes any."""
        names = {name for symbol in symbols(value) for name in symbols(self._sums.get(symbol, Sym(symbol)))}
        return [place for place in self._free if self._joints[place] in names]

    def _root(self, function: Compiled, q: Floats, place: int, reach: float) -> float | None:
        """A sign change of an expression along one joint, halved until nothing is left of it."""

        def at(x: Floats) -> Floats:
            line = np.repeat(q[None], len(x), axis=0)
            line[:, place] = x
            return np.asarray(function(self._names(line)) + np.zeros(len(x)))

        grid = np.linspace(-reach, reach, GRID)
        height = at(grid)
        changes = np.flatnonzero(np.sign(height[:-1]) * np.sign(height[1:]) < 0)
        if not changes.size:
            return None
        low, high = grid[changes[0]], grid[changes[0] + 1]
        rising = height[changes[0]] < 0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            below = (at(np.array([middle]))[0] < 0) == rising
            low, high = (middle, high) if below else (low, middle)
        return float((low + high) / 2)


def smallest(jacobian: Floats, pose: Floats, task: Task, size: float) -> Floats:
    """The smallest singular value of the task's Jacobian against the largest."""
    values = np.linalg.svd(task_jacobian(jacobian, pose, task, size), compute_uv=False)
    return np.asarray(values[..., -1] / np.maximum(values[..., 0], np.finfo(float).tiny))


def _square(jacobian: Floats, poses: Floats, task: Task) -> Floats:
    """The rows of J that the task's determinant has; for position and one axis the turn about it as last column."""
    if task is Task.POSITION_AXIS:
        about = np.concatenate([np.zeros_like(poses[:, :3, 2]), poses[:, :3, 2]], axis=-1)
        return np.concatenate([jacobian, about[..., None]], axis=-1)
    rows = jacobian[:, :3] if task is Task.POSITION else jacobian[:, 3:] if task is Task.ORIENTATION else jacobian
    return np.asarray(rows[:, _ROWS[task]] if task in _ROWS else rows[:, _alive(rows)])


_ROWS = {Task.PLANAR: [0, 1, 5], Task.SCARA: [0, 1, 2, 5]}


def _alive(rows: Floats) -> list[int]:
    """The rows that are not zero at every posture, as many as there are columns."""
    height = np.abs(rows).max(axis=(0, 2))
    return sorted(np.argsort(-height, kind="stable")[: rows.shape[2]].tolist())
