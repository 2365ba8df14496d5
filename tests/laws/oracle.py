"""Forward kinematics as a product of the table's matrices in floats, and what follows from it. Nothing of kinsym's
derivation takes part.

Lecture: Paul's link Rz(theta) Tz(d) Tx(a) Rx(alpha), Craig's Rx(alpha) Tx(a) Rz(theta) Tz(d) (sections 3.2.2, 3.2.3).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tests.laws.tables import Cell, Frame, Table

#: The columns of the pose that a task asks for.
COLUMNS = {
    "pose": "uvwp",
    "position": "p",
    "orientation": "uvw",
    "planar": "uvwp",
    "scara": "uvwp",
    "position_axis": "wp",
}
STARTS, ITERATIONS = 60, 50
#: Functions of analytic cells have an exact derivative in the imaginary part: W. Squire and G. Trapp, Using complex
#: variables to estimate derivatives of real functions, SIAM Review 40 (1998).
STEP = 1e-30


class Oracle:
    """A table with the ``values`` of its parameters."""

    def __init__(self, table: Table, values: Mapping[str, float]) -> None:
        self.table, self.values = table, {"": 1.0, "pi": np.pi, **values}
        self.revolute = np.array([kind == "R" for kind in table.kinds])

    def number(self, cell: Cell) -> float:
        """A cell in floats."""
        return float(cell.number) * self.values[cell.unit]

    def frame(self, frame: Frame | None) -> np.ndarray:
        """A base or tool as a matrix, Rz(yaw) Ry(pitch) Rx(roll)."""
        result = np.eye(4)
        if frame is not None:
            roll, pitch, yaw = (self.number(cell) for cell in frame.rpy)
            result = turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)
            result[:3, 3] = [self.number(cell) for cell in frame.xyz]
        return result

    def fk(self, q: np.ndarray) -> np.ndarray:
        """Poses (..., 4, 4) of joint vectors (..., n), real or complex."""
        pose = self.frame(self.table.base)
        for column, row in enumerate(self.table.rows):
            value = row.sign * q[..., column]
            theta, d = self.number(row.theta), self.number(row.d)
            about_z = (
                turn(2, theta + value) if row.kind == "R" else turn(2, theta) + np.zeros_like(value)[..., None, None]
            )
            about_z[..., 2, 3] = d + (value if row.kind == "P" else 0.0)
            about_x = turn(0, self.number(row.alpha))
            about_x[0, 3] = self.number(row.a)
            pose = pose @ (about_z @ about_x if self.table.convention == "paul" else about_x @ about_z)
        if self.table.convention == "craig":
            alpha, a = self.table.last
            last = turn(0, self.number(alpha))
            last[0, 3] = self.number(a)
            pose = pose @ last
        return np.asarray(pose @ self.frame(self.table.tool))

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """The derivative (..., 6, n) of the pose, exact up to rounding: velocity of the origin, angular velocity."""
        R = self.fk(q)[..., :3, :3]
        columns = []
        for unit in np.eye(len(self.revolute)):
            slope = self.fk(q + STEP * 1j * unit).imag / STEP
            spin = slope[..., :3, :3] @ np.swapaxes(R, -1, -2)
            turned = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=-1)
            columns.append(np.concatenate([slope[..., :3, 3], turned], axis=-1))
        return np.stack(columns, axis=-1)

    def away(self, q: np.ndarray, pose: np.ndarray, task: str) -> np.ndarray:
        """What is missing to a pose in the entries of the task, a row for each joint vector."""
        columns = ["uvwp".index(letter) for letter in COLUMNS[task]]
        difference = (self.fk(q) - pose)[..., :3, columns]
        return np.asarray(difference.reshape(*difference.shape[:-2], -1))

    def apart(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """The largest difference of joint vectors, angles modulo a turn."""
        difference = first - second
        turned = (difference + np.pi) % (2.0 * np.pi) - np.pi
        return np.asarray(np.abs(np.where(self.revolute, turned, difference)).max(axis=-1))

    def search(self, pose: np.ndarray, task: str, rng: np.random.Generator) -> np.ndarray:
        """Joint vectors that reach a pose: damped least squares from random starts."""
        n = len(self.revolute)
        reach = max(1.0, float(np.abs(pose[:3, 3]).max()))
        q = rng.uniform(-np.pi, np.pi, (STARTS, n)) * np.where(self.revolute, 1.0, reach)
        damping, away = np.full(STARTS, 1e-2), self.away(q, pose, task)
        for _ in range(ITERATIONS):
            J = np.stack([self.away(q + STEP * 1j * unit, pose, task).imag / STEP for unit in np.eye(n)], axis=-1)
            normal = np.einsum("nij,nik->njk", J, J) + damping[:, None, None] * np.eye(n)
            step = np.linalg.solve(normal, np.einsum("nij,ni->nj", J, away)[..., None])[..., 0]
            trial = self.away(q - step, pose, task)
            better = np.square(trial).sum(axis=1) < np.square(away).sum(axis=1)
            q, away = np.where(better[:, None], q - step, q), np.where(better[:, None], trial, away)
            damping = np.clip(np.where(better, 0.2 * damping, 4.0 * damping), 1e-14, 1e6)
        return np.asarray(q[np.abs(away).max(axis=1) < 1e-9])


def turn(axis: int, angle: float | np.ndarray) -> np.ndarray:
    """The turn about a coordinate axis, (..., 4, 4)."""
    angle = np.asarray(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    result = np.zeros((*angle.shape, 4, 4), dtype=np.result_type(angle, float))
    result[..., axis, axis] = result[..., 3, 3] = 1.0
    result[..., i, i] = result[..., j, j] = np.cos(angle)
    result[..., i, j], result[..., j, i] = -np.sin(angle), np.sin(angle)
    return result
