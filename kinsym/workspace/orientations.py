"""Orientations to try: those that the arm's task can ask for, evenly spread."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from kinsym.errors import RobotError
from kinsym.inverse.state import COLUMNS
from kinsym.robot.model import Task

if TYPE_CHECKING:
    from kinsym.live import Floats, LiveArm

#: The positive root of x^4 = x + 4, beside the square root of two the constant of the super-Fibonacci spiral.
_PSI = 1.533751168755204288118041


def orientations(arm: LiveArm, count: int) -> Floats:
    """Rotations (count, 3, 3) to ask the arm for: turns about its axis where it moves in a plane, all others spread.

    Raises :class:`RobotError` for a wrist alone, which moves its end about one point.
    """
    import numpy as np

    if count < 1:
        raise RobotError(f"{count} orientations are none", where=arm.robot.name, remedy="Ask for one or more.")
    task = arm.robot.task or Task.POSE
    if "p" not in COLUMNS[task]:
        raise RobotError(
            "this arm turns its end effector about one point and has no workspace of positions",
            where=arm.robot.name,
            remedy="Ask for the workspace of the arm that carries it.",
        )
    if "uvw" not in COLUMNS[task] and task is not Task.POSITION_AXIS:
        return np.eye(3)[None]
    if task in (Task.PLANAR, Task.SCARA):
        return _about_axis(arm, count)
    return spread(count)


def _about_axis(arm: LiveArm, count: int) -> Floats:
    """Turns of the end effector about the arm's axis."""
    import numpy as np

    home = np.zeros(len(arm.module.JOINTS))
    moved = home.copy()
    moved[arm.module.JOINT_TYPES.index("R")] = 1.0
    before, after = arm.fk(home)[:3, :3], arm.fk(moved)[:3, :3]
    turned = after @ before.T
    axis = np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]])
    axis /= np.linalg.norm(axis)
    across = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    angles = (2.0 * math.pi / count) * np.arange(count)[:, None, None]
    # Rodrigues: a turn about a unit axis.
    turns = np.eye(3) + np.sin(angles) * across + (1.0 - np.cos(angles)) * (across @ across)
    result: Floats = turns @ before
    return result


def spread(count: int) -> Floats:
    """Rotations (count, 3, 3) spread evenly over all, the same at every call (super-Fibonacci spiral, Alexa 2022).

    >>> import numpy as np
    >>> R = spread(50)
    >>> bool(np.allclose(R @ R.transpose(0, 2, 1), np.eye(3)))
    True
    """
    import numpy as np

    s = np.arange(count) + 0.5
    r, big = np.sqrt(s / count), np.sqrt(1.0 - s / count)
    alpha, beta = 2.0 * math.pi * s / math.sqrt(2.0), 2.0 * math.pi * s / _PSI
    x, y, z, w = r * np.sin(alpha), r * np.cos(alpha), big * np.sin(beta), big * np.cos(beta)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)
