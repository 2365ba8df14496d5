"""The square matrix of a task whose determinant a singular set factors."""

from __future__ import annotations

from kinsym.kinematics.singular.posture import Posture
from kinsym.robot.model import Task

ROWS = {Task.PLANAR: (0, 1, 5), Task.SCARA: (0, 1, 2, 5)}


def square(task: Task, posture: Posture) -> list[list[int]]:
    """The rows of J that the task tells; for position and one axis the turn about it is the sixth column."""
    if task is Task.POSITION_AXIS:
        about = (0, 0, 0, *posture.approach)
        return [[*row, w] for row, w in zip(posture.jacobian(Task.POSE), about, strict=True)]
    rows = posture.jacobian(task)
    return [rows[k] for k in ROWS[task]] if task in ROWS else [row for row in rows if any(row)]
