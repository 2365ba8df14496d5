"""An oracle that shares no kinematics with kinsym: product of exponentials, and damped least squares from many starts.

The table gives each joint's axis and one of its points at zero, and the home pose; then T(q) = exp(S1 q1) ...
exp(Sn qn) T(0) (Brockett; Lynch and Park, Modern Robotics, chapter 4). Solutions come from hundreds of random starts by
Levenberg-Marquardt steps whose damping is the residual, which converges quadratically at the end.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from sympy import Expr, Symbol

from kinsym.check.task import residual, task_jacobian
from kinsym.robot.model import Convention, Robot, Task

Floats = NDArray[np.float64]

ITERATIONS = 80
STEP = 0.6
CONVERGED = 1e-11
#: Distance (largest joint, radians or arm sizes) below which two solutions of a random pose are one.
SAME = 1e-5


class Screws:
    """Forward kinematics and Jacobian of a robot by successive screws, in float64 and vectorised.

    ``size`` is the sum of the distances of the link frames, ``revolute`` a mask of the joints, ``free`` one of
    those that no lock holds. ``held`` has the values that the table gives to locked joints, NaN elsewhere.
    """

    def __init__(self, robot: Robot, parameters: Mapping[str, Fraction] | None = None) -> None:
        known = {name: value for name, value in robot.parameters.items() if value is not None}
        self._values = {**known, **(parameters or {})}
        self.revolute = np.array([joint.kind == "R" for joint in robot.moving])
        self.count = len(self.revolute)
        self.free = np.array([joint.variable not in robot.locks for joint in robot.moving])
        locks = [robot.locks.get(joint.variable or "") for joint in robot.moving]
        self.held = np.array([np.nan if cell is None else self._number(cell) for cell in locks])
        self.axes, self.points, self.home = self._screws(robot)
        stations = [np.zeros(3), *self.points[self.revolute], self.home[:3, 3]]
        lengths = [float(np.linalg.norm(b - a)) for a, b in pairwise(stations)]
        self.size = sum(lengths) or 1.0

    def forward(self, q: Floats) -> Floats:
        """(..., n) joint vectors to (..., 4, 4) poses."""
        turn, shift, _, _ = self._along(q)
        pose = np.zeros((*q.shape[:-1], 4, 4))
        pose[..., :3, :3] = turn @ self.home[:3, :3]
        pose[..., :3, 3] = (turn @ self.home[:3, 3]) + shift
        pose[..., 3, 3] = 1.0
        return pose

    def jacobian(self, q: Floats) -> Floats:
        """(..., n) joint vectors to (..., 6, n): linear rows first, for the point that is the origin of T.

        The column of a locked joint is zero, so that steps along the Jacobian leave it where it is.
        """
        turn, shift, axes, points = self._along(q)
        end = (turn @ self.home[:3, 3]) + shift
        swept = np.cross(axes, end[..., None, :] - points)
        linear = np.where(self.revolute[:, None], swept, axes)
        angular = np.where(self.revolute[:, None], axes, 0.0)
        return np.concatenate([linear, angular], axis=-1).swapaxes(-1, -2) * self.free

    def _along(self, q: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """The motion of the last joint, and every axis and its point as moved by the joints before it."""
        shape = q.shape[:-1]
        turn, shift = np.broadcast_to(np.eye(3), (*shape, 3, 3)), np.zeros((*shape, 3))
        axes, points = np.empty((*shape, self.count, 3)), np.empty((*shape, self.count, 3))
        for j in range(self.count):
            axes[..., j, :] = turn @ self.axes[j]
            points[..., j, :] = (turn @ self.points[j]) + shift
            value = q[..., j, None]
            if not self.revolute[j]:
                shift = shift + value * axes[..., j, :]
                continue
            x, y, z = self.axes[j]
            cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            rotation = np.eye(3) + np.sin(value)[..., None] * cross + (1 - np.cos(value))[..., None] * cross @ cross
            shift = shift + ((turn @ (self.points[j] - rotation @ self.points[j])[..., None])[..., 0])
            turn = turn @ rotation
        return turn, shift, axes, points

    def _screws(self, robot: Robot) -> tuple[Floats, Floats, Floats]:
        frame = self._matrix(robot.base)
        axes, points = [], []
        if robot.home is not None:
            for joint in robot.moving:
                axes.append(frame[:3, :3] @ [self._number(cell) for cell in joint.s or ()])
                points.append((frame @ [*(self._number(cell) for cell in joint.s0 or ()), 1.0])[:3])
            home = np.eye(4)
            for column, part in enumerate((robot.home.u0, robot.home.v0, robot.home.w0, robot.home.q0)):
                home[:3, column] = [self._number(cell) for cell in part]
            return np.array(axes), np.array(points), frame @ home @ self._matrix(robot.tool)
        for joint in robot.joints:
            about_x = _about_x(self._number(joint.alpha), self._number(joint.a))
            about_z = _about_z(self._number(joint.theta), self._number(joint.d))
            if robot.convention is Convention.CRAIG:
                frame = frame @ about_x
            if joint.variable is not None:
                sign = self._slope(joint.theta if joint.kind == "R" else joint.d, joint.variable)
                axes.append(frame[:3, 2] * sign)
                points.append(frame[:3, 3].copy())
            frame = frame @ about_z
            if robot.convention is Convention.PAUL:
                frame = frame @ about_x
        return np.array(axes), np.array(points), frame @ self._matrix(robot.tool)

    def _number(self, cell: Expr | None) -> float:
        """The value of a cell with every joint at zero."""
        return self._at(cell, {})

    def _slope(self, cell: Expr | None, variable: str) -> float:
        return self._at(cell, {variable: Fraction(1)}) - self._at(cell, {})

    def _at(self, cell: Expr | None, joint: Mapping[str, Fraction]) -> float:
        if cell is None:
            return 0.0
        given = {**self._values, **joint}
        named: dict[str, Symbol] = {str(symbol): symbol for symbol in cell.free_symbols}
        return float(cell.subs({symbol: float(given.get(name, 0)) for name, symbol in named.items()}))

    def _matrix(self, matrix: tuple[tuple[Expr, ...], ...] | None) -> Floats:
        if matrix is None:
            return np.eye(4)
        return np.array([[self._number(cell) for cell in row] for row in matrix])


def multistart(
    screws: Screws, task: Task, known: Floats, starts: int, rng: np.random.Generator
) -> list[NDArray[np.float64]]:
    """The distinct solutions (k, n) that random starts lead to, for the pose of each joint vector of ``known`` (m, n).

    Locked joints stand where ``known`` has them; nothing else is taken from it.
    """
    poses = screws.forward(known)
    ends = np.where(screws.revolute, np.pi, screws.size)
    q = rng.uniform(-1.0, 1.0, (len(poses), starts, screws.count)) * ends
    q = np.where(screws.free, q, known[:, None]).reshape(-1, screws.count)
    wanted = np.repeat(poses, starts, axis=0)
    owner = np.repeat(np.arange(len(poses)), starts)
    kept: list[tuple[NDArray[np.intp], Floats]] = []
    for _ in range(ITERATIONS):
        reached = screws.forward(q)
        error = residual(reached, wanted, task, screws.size)
        off = np.abs(error).max(axis=-1)
        done = off < CONVERGED
        kept.append((owner[done], q[done]))
        q, wanted, owner, error, reached = q[~done], wanted[~done], owner[~done], error[~done], reached[~done]
        if not len(q):
            break
        slope = task_jacobian(screws.jacobian(q), reached, task, screws.size)
        scaled = slope * np.where(screws.revolute, 1.0, screws.size)
        gradient = (scaled.swapaxes(-1, -2) @ error[..., None])[..., 0]
        damping = 0.1 * (error**2).sum(axis=-1)
        normal = scaled.swapaxes(-1, -2) @ scaled + (damping + 1e-15)[:, None, None] * np.eye(screws.count)
        step = np.linalg.solve(normal, gradient[..., None])[..., 0]
        step *= np.minimum(1.0, STEP / np.maximum(np.abs(step).max(axis=-1, keepdims=True), STEP))
        q = q - step * np.where(screws.revolute, 1.0, screws.size)
    found = np.concatenate([index for index, _ in kept]), np.concatenate([vectors for _, vectors in kept])
    return [distinct(screws, found[1][found[0] == row]) for row in range(len(poses))]


def gaps(screws: Screws, some: Floats, others: Floats) -> Floats:
    """(k, n) and (l, n) joint vectors to their distances (k, l): the largest joint, lengths in arm sizes."""
    difference = np.abs(some[:, None] - others[None])
    turned = np.abs(np.remainder(difference + np.pi, 2 * np.pi) - np.pi)
    return np.asarray(np.where(screws.revolute, turned, difference / screws.size).max(axis=-1, initial=0.0))


def distinct(screws: Screws, q: Floats) -> Floats:
    """The vectors of (k, n) without repetitions."""
    chosen: list[Floats] = []
    left = q
    while len(left):
        chosen.append(left[0])
        left = left[gaps(screws, left, left[:1])[:, 0] > SAME]
    return np.array(chosen).reshape(-1, q.shape[-1])


def _about_z(angle: float, shift: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, shift], [0, 0, 0, 1]])


def _about_x(angle: float, shift: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0, shift], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
