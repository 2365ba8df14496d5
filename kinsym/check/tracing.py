"""Curved ways between joint vectors along which the pose does not change.

Next to a singular pose a solution is known only up to a motion that the pose hardly feels, and that motion is a
curve. Its points are found from those of the straight line by Gauss-Newton steps of least length that leave the
directions alone in which the pose hardly moves. A way that jumps is none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.solvers import TreeKinematics
from kinsym.check.task import closure, residual, task_jacobian
from kinsym.robot.model import Task

Floats = NDArray[np.float64]

POINTS = 10
CORRECTIONS = 5
SOFT = 1e-6
LONGEST_STEP = 0.35


@dataclass(frozen=True)
class Tracer:
    """Follows ways for one robot and one choice of parameters; ``limit`` is the closure a point may have."""

    kinematics: TreeKinematics
    task: Task
    limit: float

    def joined(self, start: Floats, way: Floats, poses: Floats) -> NDArray[np.bool_]:
        """Whether (k, n) joint vectors are joined to ``start + way`` on the poses (k, 4, 4)."""
        length = np.linalg.norm(way, axis=-1)
        fine = self._on(start, poses) & self._on(start + way, poses)
        before = start
        for t in np.linspace(0, 1, POINTS + 1)[1:-1]:
            here = self._corrected(start + t * way, poses)
            fine &= self._on(here, poses) & (np.linalg.norm(here - before, axis=-1) <= LONGEST_STEP * length)
            before = here
        return np.asarray(fine & (np.linalg.norm(start + way - before, axis=-1) <= LONGEST_STEP * length))

    def _on(self, q: Floats, poses: Floats) -> NDArray[np.bool_]:
        reached = self.kinematics.forward(q)
        return np.asarray(closure(reached, poses, self.task, self.kinematics.size) <= self.limit)

    def _corrected(self, q: Floats, poses: Floats) -> Floats:
        size = self.kinematics.size
        for _ in range(CORRECTIONS):
            reached = self.kinematics.forward(q)
            slope = task_jacobian(self.kinematics.jacobian(q), reached, self.task, size)
            step = np.linalg.pinv(slope, rcond=SOFT) @ residual(reached, poses, self.task, size)[..., None]
            q = q - step[..., 0]
        return q
