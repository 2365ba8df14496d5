"""Which entries of the pose a task asks for, how far off they are, and how they move with the joints."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kinsym.emit.schedule import Schedule
from kinsym.robot.model import Task

Floats = NDArray[np.float64]

POSITION = 3


def _entries(columns: str, rows: str = "xyz") -> tuple[tuple[int, int], ...]:
    return tuple(("xyz".index(row), "uvwp".index(column)) for column in columns for row in rows)


ENTRIES: dict[Task, tuple[tuple[int, int], ...]] = {
    Task.POSE: _entries("uvwp"),
    Task.POSITION: _entries("p"),
    Task.ORIENTATION: _entries("uvw"),
    Task.PLANAR: _entries("p", "xy") + _entries("u", "xy"),
    Task.SCARA: _entries("p") + _entries("u", "xy"),
    Task.POSITION_AXIS: _entries("pw"),
}


def units(revolute: NDArray[np.bool_], size: float) -> Floats:
    """The units of the joints (n,): radians, and the size of the arm for those that slide."""
    return np.where(revolute | (size <= 0), 1.0, size)


def rounding(q: Floats, revolute: NDArray[np.bool_], size: float) -> Floats:
    """How far doubles put the poses of joint vectors (..., n) off whose slides are drawn out, in sizes of the arm."""
    return np.asarray(np.abs(np.where(revolute, 0.0, q / units(revolute, size))).max(axis=-1) * 4 * np.finfo(float).eps)


def closure(reached: Floats, wanted: Floats, task: Task, size: float) -> Floats:
    """Largest difference of the entries the task asks for.

    ``reached`` and ``wanted`` have shape (..., 4, 4); lengths are divided by ``size`` or, for a pose far away, by
    its largest coordinate. Returns shape (...); NaN where an input is NaN.
    """
    far = np.maximum(np.abs(wanted[..., :3, 3]).max(axis=-1), size if size > 0 else 1.0)
    parts = []
    for i, j in ENTRIES[task]:
        difference = np.abs(reached[..., i, j] - wanted[..., i, j])
        parts.append(difference / far if j == POSITION else difference)
    return np.asarray(np.max(np.stack(parts), axis=0), dtype=np.float64)


def residual(reached: Floats, wanted: Floats, task: Task, size: float) -> Floats:
    """The entries the task asks for, reached minus wanted, lengths divided by ``size``: (..., entries)."""
    length = size if size > 0 else 1.0
    parts = [(reached[..., i, j] - wanted[..., i, j]) / (length if j == POSITION else 1.0) for i, j in ENTRIES[task]]
    return np.stack(parts, axis=-1)


def task_jacobian(jacobian: Floats, pose: Floats, task: Task, size: float) -> Floats:
    """The derivative of :func:`residual` by the joints, from (..., 6, n) geometric Jacobians and (..., 4, 4) poses.

    A column of the rotation moves by omega x column.
    """
    linear, angular = jacobian[..., :3, :] / (size if size > 0 else 1.0), jacobian[..., 3:, :]
    turned = {j: np.cross(angular, pose[..., :3, j, None], axisa=-2, axisb=-2, axisc=-2) for j in range(POSITION)}
    rows = [linear[..., i, :] if j == POSITION else turned[j][..., i, :] for i, j in ENTRIES[task]]
    return np.stack(rows, axis=-2)


def sifted(schedule: Schedule) -> bool:
    """Whether the task has more equations than the arm has joints: its poses are met only as well as they are known.

    Poses of planar and SCARA arms are sifted as well, but their equations are as many as their joints.
    """
    return schedule.gate and schedule.task not in (Task.PLANAR, Task.SCARA)
