"""Curved ways between joint vectors along which the pose does not change.

Next to a singular pose a solution is known only up to a motion that the pose hardly feels, and that motion is a
curve. It is followed in small steps towards the other end: each step goes along the directions in which the pose
hardly moves, and Gauss-Newton corrections of least length bring it back. What lies on another branch is not reached.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.task import closure, residual, rounding, task_jacobian, units
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.robot.model import Task

Floats = NDArray[np.float64]

STEPS = 60
STEP = 0.12
CORRECTIONS = 3
#: Below this share of the largest singular value the pose hardly feels a motion.
SOFT = 1e-6
#: Nearer than this a straight line ends the way.
ARRIVED = 1e-6
POINTS = (0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True)
class Tracer:
    """Follows ways for one robot and one choice of parameters; ``limit`` is the closure a point may have, ``step`` the
    length of a step and ``steps`` how many there are at most.

    Joint vectors are in radians and, those of slides, in sizes of the arm.
    """

    kinematics: TreeKinematics
    task: Task
    limit: float
    revolute: NDArray[np.bool_]
    step: float = STEP
    steps: int = STEPS

    def joined(self, start: Floats, way: Floats, poses: Floats) -> NDArray[np.bool_]:
        """Whether joint vectors (k, n) are joined to ``start + way`` on the poses (k, 4, 4)."""
        end, here = start + way, start
        fine = self.on_pose(start, poses) & self.on_pose(end, poses)
        for _ in range(self.steps):
            left = np.linalg.norm(end - here, axis=-1)
            active = fine & (left > ARRIVED)
            if not active.any():
                break
            moved = self._stepped(here[active], end[active], poses[active])
            nearer = np.linalg.norm(end[active] - moved, axis=-1) < left[active] - ARRIVED * self.step
            here = here.copy()
            here[active] = moved
            fine = fine.copy()
            fine[active] = nearer & self.on_pose(moved, poses[active])
        for t in POINTS:
            fine = fine & self.on_pose(here + t * (end - here), poses)
        return np.asarray(fine & (np.linalg.norm(end - here, axis=-1) <= ARRIVED))

    def on_pose(self, q: Floats, poses: Floats) -> NDArray[np.bool_]:
        """Whether joint vectors (k, n) are on the poses (k, 4, 4) within the limit."""
        q = q * self._units
        reached = self.kinematics.forward(q)
        limit = self.limit + rounding(q, self.revolute, self.kinematics.size)
        return np.asarray(closure(reached, poses, self.task, self.kinematics.size) <= limit)

    def slope(self, q: Floats) -> tuple[Floats, Floats]:
        """The poses (k, 4, 4) of joint vectors (k, n) and the derivatives (k, entries, n) of what the task asks for."""
        q = q * self._units
        reached = self.kinematics.forward(q)
        slope = task_jacobian(self.kinematics.jacobian(q), reached, self.task, self.kinematics.size)
        return reached, slope * self._units

    @property
    def _units(self) -> Floats:
        return units(self.revolute, self.kinematics.size)

    def _stepped(self, q: Floats, end: Floats, poses: Floats) -> Floats:
        """One step towards ``end`` along what the pose hardly feels, and back onto the pose."""
        _, slope = self.slope(q)
        towards = (end - q)[..., None]
        along = (towards - np.linalg.pinv(slope, rcond=SOFT) @ (slope @ towards))[..., 0]
        length = np.linalg.norm(along, axis=-1, keepdims=True)
        q = q + along * np.minimum(1.0, self.step / np.maximum(length, self.step))
        for _ in range(CORRECTIONS):
            reached, slope = self.slope(q)
            error = residual(reached, poses, self.task, self.kinematics.size)[..., None]
            q = q - (np.linalg.pinv(slope, rcond=SOFT) @ error)[..., 0]
        return q
