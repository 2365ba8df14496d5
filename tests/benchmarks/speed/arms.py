"""The arms that are timed, as Denavit-Hartenberg tables in numbers, and their kinematics by products of matrices.

Nothing of kinsym is used here: the workers of the peers read this file, and the answers of all are judged by it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_ANGLES = {"0": 0.0, "pi/2": pi / 2, "-pi/2": -pi / 2, "pi/3": pi / 3, "pi": pi}


@dataclass(frozen=True, kw_only=True)
class Row:
    """One row in Paul's convention; of the joint's own cell only the constant part counts."""

    kind: str
    alpha: float
    a: float
    d: float
    theta: float


@dataclass(frozen=True, kw_only=True)
class Arm:
    """A table as ``--dh`` takes it (alpha a d theta) with the values of its lengths."""

    name: str
    title: str
    table: str
    lengths: Mapping[str, float]

    @property
    def cells(self) -> list[list[str]]:
        """The cells of each row."""
        return [row.split() for row in self.table.split(";")]

    @property
    def rows(self) -> list[Row]:
        """The table in numbers."""
        return [
            Row(
                kind="R" if theta.startswith("theta") else "P",
                alpha=_ANGLES[alpha],
                a=self._length(a),
                d=0.0 if d not in ("0", *self._signed) else self._length(d),
                theta=0.0 if theta.startswith("theta") else _ANGLES[theta],
            )
            for alpha, a, d, theta in self.cells
        ]

    def forward(self, q: Floats) -> Floats:
        """(..., n) to (..., 4, 4)."""
        return self.frames(q)[-1]

    def jacobian(self, q: Floats) -> Floats:
        """(..., n) to (..., 6, n): velocity, then angular velocity, in the base."""
        frames = self.frames(q)
        columns = []
        for row, frame in zip(self.rows, frames, strict=False):
            axis, arm = frame[..., :3, 2], frames[-1][..., :3, 3] - frame[..., :3, 3]
            turn = row.kind == "R"
            columns.append(np.concatenate([np.cross(axis, arm) if turn else axis, axis * turn], axis=-1))
        return np.stack(columns, axis=-1)

    def sample(self, count: int, seed: int) -> Floats:
        """Random joint vectors: angles in a whole turn, lengths of 0.1 to 0.6."""
        rng = np.random.default_rng(seed)
        turns = rng.uniform(-pi, pi, (count, len(self.rows)))
        slides = rng.uniform(0.1, 0.6, turns.shape)
        return np.where([row.kind == "R" for row in self.rows], turns, slides)

    @property
    def _signed(self) -> dict[str, float]:
        return {**self.lengths, **{f"-{name}": -value for name, value in self.lengths.items()}}

    def _length(self, cell: str) -> float:
        return 0.0 if cell == "0" else self._signed[cell]

    def frames(self, q: Floats) -> list[Floats]:
        """The frame before each joint, then the last one."""
        frames = [np.broadcast_to(np.eye(4), (*q.shape[:-1], 4, 4))]
        for row, value in zip(self.rows, np.moveaxis(q, -1, 0), strict=True):
            theta = row.theta + value * (row.kind == "R")
            d = row.d + value * (row.kind == "P")
            ca, sa, c, s = np.cos(row.alpha), np.sin(row.alpha), np.cos(theta), np.sin(theta)
            zero, one = np.zeros_like(c), np.ones_like(c)
            entries = [
                [c, -s * ca, s * sa, row.a * c],
                [s, c * ca, -c * sa, row.a * s],
                [zero, sa * one, ca * one, d * one],
                [zero, zero, zero, one],
            ]
            step = np.stack([np.stack(line, axis=-1) for line in entries], axis=-2)
            frames.append(frames[-1] @ step)
        return frames


#: Tables and lengths are those of the gallery (see the sources there); the KUKA's is its screw table written with
#: Denavit-Hartenberg rows, the Jaco's has its offsets left out, so that every library takes it.
ARMS = {
    arm.name: arm
    for arm in (
        Arm(
            name="puma560",
            title="Puma 560",
            table="pi/2 0 0 theta1; 0 a2 0 theta2; -pi/2 a3 d3 theta3;pi/2 0 d4 theta4; -pi/2 0 0 theta5; 0 0 0 theta6",
            lengths={"a2": 0.4318, "a3": 0.0203, "d3": 0.15005, "d4": 0.4318},
        ),
        Arm(
            name="ur5",
            title="UR5",
            table="pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3;pi/2 0 d4 theta4; -pi/2 0 d5 theta5; 0 0 d6 theta6",
            lengths={"d1": 0.089159, "a2": -0.425, "a3": -0.39225, "d4": 0.10915, "d5": 0.09465, "d6": 0.0823},
        ),
        Arm(
            name="kuka_kr6",
            title="KUKA KR 6 R900",
            table="pi/2 a1 d1 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3;"
            "-pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
            lengths={"a1": 0.025, "d1": 0.4, "a2": 0.455, "a3": 0.035, "d4": 0.42, "d6": 0.08},
        ),
        Arm(
            name="stanford",
            title="Stanford arm",
            table="-pi/2 0 d1 theta1; pi/2 0 d2 theta2; 0 0 d3 0;-pi/2 0 0 theta4; pi/2 0 0 theta5; 0 0 0 theta6",
            lengths={"d1": 0.412, "d2": 0.154},
        ),
        Arm(
            name="jaco",
            title="Kinova Jaco (general 6R)",
            table="pi/2 0 d1 theta1; pi a2 0 theta2; pi/2 0 -e2 theta3;"
            "pi/3 0 -d4 theta4; pi/3 0 -d5 theta5; pi 0 -d6 theta6",
            lengths={"d1": 0.2755, "a2": 0.41, "e2": 0.0098, "d4": 0.2502, "d5": 0.0858, "d6": 0.2116},
        ),
    )
}
