"""A posture that shows an arm well, where nobody names one: bent at every joint, above its base, nothing hidden.

At home most arms are stretched or folded. Of postures at whole steps of 15 degrees, the same at every call, the one
is taken that is furthest from a singular one and from lying on itself.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.skeleton import Linkage

_TRIES = 600
_STEP = math.radians(15)
_STEPS_OF_SLIDE = 20
_SLIDE = (0.5, 1.0)
"""A slide without limits is drawn out by this share of the arm's size."""


def general_posture(arm: Linkage, held: Mapping[str, float] | None = None) -> Floats:
    """Joint values (n,), radians and the unit of length, inside the limits; joints that are ``held`` at their value.

    >>> from kinsym.robot import load
    >>> from kinsym.skeleton import linkage
    >>> q = general_posture(linkage(load("puma560")))
    >>> bool(abs(q[4]) > 0.2)  # the wrist is bent
    True
    """
    import numpy as np

    generator = random.Random(0)
    tries = np.array([[_drawn(arm, i, generator) for i in range(len(arm.kinds))] for _ in range(_TRIES)])
    for name, value in (held or {}).items():
        tries[:, arm.variables.index(name)] = value
    result: Floats = tries[int(np.argmax(_worth(arm, tries)))]
    return result


def _drawn(arm: Linkage, i: int, generator: random.Random) -> float:
    low, high = (float(limit) for limit in arm.limits[i])
    if arm.kinds[i] == "R":
        low, high = max(low, -math.pi), min(high, math.pi)
        first, last = math.ceil(low / _STEP + 1e-9), math.floor(high / _STEP - 1e-9)
        steps = [step for step in range(first, last + 1) if step % 12]
        return generator.choice(steps) * _STEP if steps else (low + high) / 2.0
    if not math.isfinite(low) or not math.isfinite(high):
        low = low if math.isfinite(low) else min(_SLIDE[0] * arm.size, high - arm.size)
        high = high if math.isfinite(high) else max(_SLIDE[1] * arm.size, low + arm.size)
    return low + (high - low) * generator.randint(1, _STEPS_OF_SLIDE - 1) / _STEPS_OF_SLIDE


def _worth(arm: Linkage, q: Floats) -> Floats:
    """How well postures (k, n) show the arm, (k,)."""
    import numpy as np

    posture = arm.at(q)
    tip = posture.frames[:, -1, :3, 3]
    z, points = posture.joints[..., :3, 2], posture.joints[..., :3, 3]
    turning = np.array([kind == "R" for kind in arm.kinds])[:, None]
    speed = np.where(turning, np.cross(z, tip[:, None] - points), z) / np.where(turning, arm.size, 1.0)
    columns = np.concatenate([speed, np.where(turning, z, 0.0)], axis=-1)
    sizes = np.linalg.svd(columns, compute_uv=False)[:, : min(len(arm.kinds), 6)]
    # The arm's manipulability (Yoshikawa 1985), of an arm in a plane without the motions that it never makes.
    manipulable = np.exp(np.log(np.maximum(sizes, 1e-9)).mean(axis=-1))
    corners = posture.path - posture.path[:, :1]
    up = 2 if arm.plane is None else arm.plane[1]
    lowest = corners[..., up].min(axis=-1) / arm.size
    apart = _clearance(corners) / arm.size
    forward = tip[:, 0] / arm.size
    worth: Floats = manipulable * (0.3 + np.minimum(apart, 0.3)) + np.minimum(lowest, 0.0) + 0.05 * forward
    return worth


def _clearance(corners: Floats) -> Floats:
    """The least distance between the middles of links that are no neighbours, (k,)."""
    import numpy as np

    middles = (corners[:, 1:] + corners[:, :-1]) / 2.0
    lengths = np.linalg.norm(np.diff(corners, axis=1), axis=-1)
    gaps = np.linalg.norm(middles[:, :, None] - middles[:, None], axis=-1)
    long = lengths > 0.05 * lengths.max(axis=-1, keepdims=True)
    count = middles.shape[1]
    apart = np.abs(np.subtract.outer(np.arange(count), np.arange(count))) > 1
    gaps = np.where(apart & long[:, :, None] & long[:, None], gaps, gaps.max(initial=0.0))
    least: Floats = gaps.min(axis=(1, 2))
    return least
