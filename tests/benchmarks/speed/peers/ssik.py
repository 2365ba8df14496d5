"""ssik (Personal Robotics Lab): subproblems and Raghavan and Roth's elimination, compiled, called from Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import ssik

from tests.benchmarks.speed.arms import Arm, Floats
from tests.benchmarks.speed.peers import Refused


def solve(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose, and how its answer is read. The arm is given by its axes at zero."""
    if any(row.kind != "R" for row in arm.rows):
        raise Refused("revolute joints alone")
    frames = arm.frames(np.zeros(len(arm.rows)))
    axes = [frame[:3, 2].tolist() for frame in frames[:-1]]
    points = np.array([np.zeros(3), *(frame[:3, 3] for frame in frames)])
    robot = ssik.Manipulator.from_axes(axes, np.diff(points, axis=0).tolist())
    turn = np.eye(4)
    turn[:3, :3] = frames[-1][:3, :3].T
    return lambda pose: robot.solve(pose @ turn, respect_limits=False), _read


def _read(answer: Any) -> Floats:
    return np.array([list(found.q) for found in answer]).reshape(-1, 6)
