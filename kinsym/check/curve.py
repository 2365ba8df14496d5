"""The whole curve of joint vectors on which a pose hardly changes, followed both ways from one of them.

Next to a pose at which the arm can move without moving its tool such a curve is closed, and the way to another point of
it may begin in the direction that leads away from that point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.poses import wrapped
from kinsym.check.task import residual
from kinsym.check.tracing import SOFT, Tracer

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

STEP = 0.1
#: So many steps lead round the longest curves: two turns of three joints.
AROUND = 240
#: After so many steps a curve may be back where it began.
LEAST = 5
CORRECTIONS = 4


@dataclass(frozen=True)
class Curve:
    """Follows curves for the arm, the task and the limit of a tracer, which takes the last step."""

    tracer: Tracer

    def joined(self, start: Floats, end: Floats, poses: Floats) -> Mask:
        """Whether curves from (k, n) joint vectors lead to ``end`` on the poses (k, 4, 4)."""
        found = np.zeros(len(start), dtype=bool)
        there = self.tracer.on_pose(start, poses) & self.tracer.on_pose(end, poses)
        rows = np.flatnonzero(there & self._soft(start) & self._soft(end))
        for sign in (1.0, -1.0):
            rows = rows[~found[rows]]
            if rows.size:
                found[rows] = self._leads(start[rows], end[rows], poses[rows], sign)
        return found

    def _leads(self, start: Floats, end: Floats, poses: Floats, sign: float) -> Mask:
        """Whether the curve that begins in the one or the other direction leads to the end."""
        found, active, here = np.zeros(len(start), dtype=bool), np.ones(len(start), dtype=bool), start.copy()
        ahead = sign * self._weakest(here)[1]
        for step in range(AROUND):
            rows = np.flatnonzero(active)
            if not rows.size:
                break
            here[rows] = self._stepped(here[rows], ahead[rows], poses[rows])
            active[rows] = self.tracer.on_pose(here[rows], poses[rows])
            along = self._weakest(here[rows])[1]
            ahead[rows] = along * np.where((along * ahead[rows]).sum(axis=1) < 0, -1.0, 1.0)[:, None]
            way, back = (wrapped(point[rows] - here[rows], self.tracer.revolute) for point in (end, start))
            near = np.linalg.norm(way, axis=1) <= 2 * STEP
            if step >= LEAST:
                active[rows] &= np.linalg.norm(back, axis=1) > STEP
            if near.any():
                there = rows[near]
                found[there] = self.tracer.joined(here[there], way[near], poses[there])
                active &= ~found
        return found

    def _stepped(self, q: Floats, ahead: Floats, poses: Floats) -> Floats:
        """A step along the curve, and back onto it across what the pose hardly feels."""
        q = q + STEP * ahead
        for _ in range(CORRECTIONS):
            reached, slope = self.tracer.slope(q)
            error = residual(reached, poses, self.tracer.task, self.tracer.kinematics.size)[..., None]
            q = q - (np.linalg.pinv(slope, rcond=SOFT) @ error)[..., 0]
        return q

    def _soft(self, q: Floats) -> Mask:
        """Whether there is a motion that the pose hardly feels."""
        return self._weakest(q)[0] <= SOFT

    def _weakest(self, q: Floats) -> tuple[Floats, Floats]:
        """The least singular value, as a share of the largest, and the motion that belongs to it."""
        free = self.tracer.kinematics.free
        _, values, motions = np.linalg.svd(self.tracer.slope(q)[1][..., free])
        weakest = np.zeros(q.shape)
        weakest[:, free] = motions[:, -1]
        return values[:, -1] / values[:, 0], weakest
