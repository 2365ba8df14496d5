"""The exact walk with the face of the other answers."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import numpy as np

from kinsym.check.solvers import Floats, Solutions
from kinsym.check.walk import ExactWalk
from kinsym.emit.schedule import Schedule


class ExactSolver:
    """The exact walk, its answers rounded to float64."""

    name = "exact walk"

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.walk = ExactWalk(schedule, parameters)
        self._shape = (schedule.maximum, len(schedule.joints))
        self._revolute = np.array([joint.kind == "R" for joint in schedule.joints])

    def forward(self, q: Floats) -> Floats:
        poses = np.zeros((len(q), 4, 4))
        poses[:, 3, 3] = 1.0
        for row, joints in enumerate(q):
            poses[row, :3] = self.walk.forward(joints.tolist())
        return poses

    def jacobian(self, q: Floats) -> Floats:
        return np.array([self.walk.jacobian(joints.tolist()) for joints in q], dtype=np.float64)

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        q = np.full((len(poses), *self._shape), np.nan)
        count = np.zeros(len(poses), dtype=np.intp)
        for row, pose in enumerate(poses):
            found = self.walk.inverse(pose.tolist(), reference[row].tolist()) or []
            count[row] = len(found)
            if found:
                q[row, : len(found)] = found
        # the nearest double of an angle just above -pi is -pi itself
        return np.where(self._revolute & (q == -np.pi), np.pi, q), count

    def refuses(self, pose: Floats) -> bool:
        return self.walk.inverse(pose.tolist()) is None
