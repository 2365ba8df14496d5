"""Poses at the borders of the workspace, inside and outside by a given depth.

Where the task's Jacobian J loses one rank, with J v = 0 and u J = 0, a motion along v moves the pose only as k t^2 / 2
along u: to one side of the border two solutions lie at v t and -v t, to the other there is none. Where k vanishes the
joints can move without the pose, and there is no border.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.solvers import Floats
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.robot.model import Task

#: Below this share of the largest singular value J has lost a rank, below the second one it may lose two.
LOST, SECOND = 1e-9, 1e-3
#: Borders that curve less than this, in units of the arm, are none.
FLAT = 0.02
STEP = 1e-3

_ROWS = {
    Task.POSE: range(6),
    Task.POSITION: range(3),
    Task.ORIENTATION: range(3, 6),
    Task.PLANAR: (0, 1, 5),
    Task.SCARA: (0, 1, 2, 5),
}


@dataclass(frozen=True, kw_only=True)
class Borders:
    """Postures (m, n) on borders, the motion of the joints that the pose does not feel (m, n), the twist (m, 6) that
    leads out of the workspace, lengths in units of the arm, and how much the border curves (m,)."""

    q: Floats
    along: Floats
    outward: Floats
    bend: Floats

    def inside(self, rows: NDArray[np.intp], depth: Floats) -> Floats:
        """Joint vectors whose poses are inside by ``depth``."""
        return self.q[rows] + self.along[rows] * np.sqrt(2.0 * depth / self.bend[rows])[:, None]


def borders(kinematics: TreeKinematics, task: Task, q: Floats, revolute: NDArray[np.bool_]) -> Borders | None:
    """Those of the singular postures ``q`` (m, n) that lie on a border; None if the task cannot have any."""
    size = kinematics.size if kinematics.size > 0 else 1.0
    pose, jacobian = kinematics.forward(q), kinematics.jacobian(q)[..., kinematics.free]
    basis = _basis(task, pose, jacobian)
    if basis.shape[1] != jacobian.shape[2]:
        return None
    scale, unit = np.array([1.0 / size] * 3 + [1.0] * 3), np.where(revolute, 1.0, size)
    left, height, right = np.linalg.svd(basis @ (scale[:, None] * jacobian * unit[kinematics.free]))
    lost = (height[:, -1] < LOST * height[:, 0]) & (height[:, -2:-1] > SECOND * height[:, :1]).all(axis=1)
    outward = (left[:, None, :, -1] @ basis)[:, 0]
    along = np.zeros_like(q)
    along[:, kinematics.free] = right[:, -1]
    along *= unit
    shift = STEP * along
    bend = (
        (_twist(pose, kinematics.forward(q + shift), size) + _twist(pose, kinematics.forward(q - shift), size))
        * outward
    ).sum(axis=1) / STEP**2
    kept = lost & (np.abs(bend) > FLAT)
    # the workspace lies where the arm can bend to
    outward *= -np.sign(bend)[:, None]
    return Borders(q=q[kept], along=along[kept], outward=outward[kept], bend=np.abs(bend[kept]))


def moved(poses: Floats, twist: Floats, size: float) -> Floats:
    """Poses (m, 4, 4) moved by small twists (m, 6), lengths of these in units of ``size``."""
    result = poses.copy()
    result[:, :3, 3] += (size if size > 0 else 1.0) * twist[:, :3]
    x, y, z = twist[:, 3:].T
    zero = np.zeros_like(x)
    cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    angle = np.linalg.norm(twist[:, 3:], axis=1)[:, None, None]
    per = np.sinc(angle / np.pi)
    turn = per * cross + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (cross @ cross)
    result[:, :3, :3] += turn @ poses[:, :3, :3]
    return result


def _twist(start: Floats, end: Floats, size: float) -> Floats:
    """The small motion (m, 6) from one pose to another, lengths in units of ``size``."""
    turn = end[:, :3, :3] @ start[:, :3, :3].transpose(0, 2, 1)
    spin = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]]) / 2
    return np.concatenate([(end[:, :3, 3] - start[:, :3, 3]) / size, spin.T], axis=1)


def _basis(task: Task, pose: Floats, jacobian: Floats) -> Floats:
    """An orthonormal basis (m, k, 6) of the motions that the task asks for and that some joint can make."""
    if task in _ROWS:
        rows = [row for row in _ROWS[task] if np.abs(jacobian[:, row]).max() > 0.0]
        return np.broadcast_to(np.eye(6)[rows], (len(pose), len(rows), 6))
    basis = np.zeros((len(pose), 5, 6))
    basis[:, :3, :3] = np.eye(3)
    # turns about the tool's own third axis do not count
    basis[:, 3:, 3:] = pose[:, :3, :2].transpose(0, 2, 1)
    return basis
