"""The poses that laws of one pose at a time are tried on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from kinsym.check.control import WORSE
from kinsym.check.laws import SAME, Judge
from kinsym.check.poses import QUARTER, SINGULAR, UNIFORM, Samples
from kinsym.check.solvers import Floats
from kinsym.emit.schedule import Schedule

ORDINARY_POSES, SPECIAL_POSES = 12, 36
WINDING_POSES, SLOW_POSES = 6, 1


@dataclass(frozen=True, kw_only=True)
class Fineness:
    """A type of numbers, and how finely it tells things apart.

    same    joint values; worse  what the nearest solution costs.
    edge    joint vectors so near to a limit are left out of the comparison.
    chosen  how far the settling of a solution may move a free joint from its reference.
    """

    real: type[np.floating[Any]] = np.float64
    same: float = SAME
    worse: float = WORSE
    edge: float = 1e-9
    chosen: float = 1e-4


@dataclass(frozen=True, kw_only=True)
class Questions:
    """The poses (m, 4, 4) of joint vectors q (m, n) that these laws are tried on, and which are ordinary (m,)."""

    schedule: Schedule
    judge: Judge
    poses: Floats
    q: Floats
    plain: Any
    fine: Fineness = Fineness()

    @property
    def winding(self) -> Any:
        """The joints that whole turns are added to."""
        return self.judge.revolute & self.judge.kinematics.free

    @property
    def ordinary(self) -> Any:
        """The rows of the first ordinary poses; a general solver takes long for each."""
        return np.flatnonzero(self.plain)[: SLOW_POSES if self.schedule.general else WINDING_POSES]

    @property
    def places(self) -> range:
        """The joints of which a value is made wrong."""
        return range(1 if self.schedule.general else self.q.shape[1])


def asked(samples: Samples, *, general: bool) -> tuple[Any, Any]:
    """The rows (m,) of samples that are asked for one at a time, and which of them are ordinary (m,).

    Half of the others are the singular ones and those nearest to them, half lie at all distances from these.
    """
    near = np.flatnonzero(samples.of(QUARTER, SINGULAR))
    near = near[np.argsort(samples.offset[near], kind="stable")]
    ordinary, half = np.flatnonzero(samples.of(UNIFORM)), SPECIAL_POSES // 2
    if general:
        # one pose takes it long, and next to singular ones its last digits depend on how many are asked at once
        ordinary, near = ordinary[:1], near[:4]
    elif len(near) > SPECIAL_POSES:
        # marks end somewhere between the nearest and the farthest
        near = np.concatenate([near[:half], near[half :: (len(near) - half) // half][:half]])
    rows = np.concatenate([ordinary[:ORDINARY_POSES], near])
    return rows, np.arange(len(rows)) < len(rows) - len(near)
