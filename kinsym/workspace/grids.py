"""Which points a sweep asks for: as far as the arm goes, in one plane or all around it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from kinsym.errors import RobotError
from kinsym.skeleton import Linkage

if TYPE_CHECKING:
    from kinsym.live import Floats

Axis = tuple[float, ...]
"""The coordinates of a grid along one direction."""

_ROOM = 0.05
_POSTURES = 2000
_ROUNDS = 3
_ANGLES = 72
MOST = 2_000_000
"""Points that a sweep may have."""


def window(arm: Linkage) -> tuple[Floats, Floats]:
    """The lowest and the highest x, y, z (3,) that the tip reaches, joints without limits turning all round.

    A slide without limits counts as long as the arm on both sides. Sampled, then climbed joint by joint, so that a
    stretched arm is not missed.
    """
    import numpy as np

    low, high = _ranges(arm)
    q = low + (high - low) * np.random.default_rng(0).random((_POSTURES, len(low)))
    tips = arm.at(q).frames[:, -1, :3, 3]
    bounds = []
    for sign, pick in ((-1.0, np.argmin), (1.0, np.argmax)):
        best = [_climbed(arm, q[int(pick(tips[:, k]))], sign * np.eye(3)[k]) for k in range(3)]
        bounds.append(sign * np.array(best))
    return bounds[0], bounds[1]


def endless(arm: Linkage) -> tuple[str, ...]:
    """The sliding joints without limits: a picture of the workspace ends where its window does."""
    import numpy as np

    pairs = zip(arm.variables, arm.kinds, arm.limits, strict=True)
    return tuple(name for name, kind, limits in pairs if kind == "P" and not np.isfinite(limits).all())


def slice_grid(arm: Linkage, points: int, held: str, value: float) -> tuple[Axis, Axis, Axis]:
    """The coordinates of a plane x, y or z = ``value``, ``points`` of them along its longer side."""
    axes = list(volume_grid(arm, points, without="xyz".index(held)))
    axes["xyz".index(held)] = (float(value),)
    return axes[0], axes[1], axes[2]


def volume_grid(arm: Linkage, points: int, *, without: int | None = None) -> tuple[Axis, Axis, Axis]:
    """The coordinates of the box around the workspace, equally far apart, ``points`` along its longest side.

    Raises :class:`RobotError` for fewer than two points and for more than :data:`MOST` in all.
    """
    import numpy as np

    if points < 2:
        raise RobotError(f"a grid of {points} points along a side is none", remedy="Ask for two or more.")
    low, high = window(arm)
    sides = high - low
    if without is not None:
        sides[without] = 0.0
    room = _ROOM * (float(sides.max()) or 1.0)
    sides = sides + 2.0 * room
    step = float(sides.max()) / (points - 1)
    counts = [max(2, math.ceil(side / step - 1e-9) + 1) for side in sides]
    if without is not None:
        counts[without] = 1
    if math.prod(counts) > MOST:
        raise RobotError(f"{math.prod(counts)} points are too many", remedy=f"At most {MOST} are evaluated.")
    middles = (low + high) / 2.0
    axes = [
        middle + step * (np.arange(count) - (count - 1) / 2.0) for middle, count in zip(middles, counts, strict=True)
    ]
    x, y, z = (tuple(round(float(value), 12) + 0.0 for value in axis) for axis in axes)
    return x, y, z


def _ranges(arm: Linkage) -> tuple[Floats, Floats]:
    import numpy as np

    turning = np.array([kind == "R" for kind in arm.kinds])
    low, high = arm.limits.T
    low = np.where(np.isfinite(low), low, np.where(turning, -math.pi, np.minimum(-arm.size, high - arm.size)))
    high = np.where(np.isfinite(high), high, np.where(turning, math.pi, np.maximum(arm.size, low + arm.size)))
    return low, high


def _climbed(arm: Linkage, q: Floats, direction: Floats) -> float:
    """How far the tip gets along a direction from a posture on, each joint in turn at its best."""
    import numpy as np

    low, high = _ranges(arm)
    best = q.copy()
    height = -math.inf
    for _ in range(_ROUNDS):
        for joint in range(len(best)):
            tries = np.repeat(best[None], _ANGLES + 1, axis=0)
            tries[1:, joint] = np.linspace(low[joint], high[joint], _ANGLES)
            heights = arm.at(tries).frames[:, -1, :3, 3] @ direction
            row = int(np.argmax(heights))
            best, height = tries[row], float(heights[row])
    return height
