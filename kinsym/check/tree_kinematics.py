"""Forward kinematics and Jacobian read from the trees of a schedule, for many joint vectors at once."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from kinsym.check.evaluate import Program, floating
from kinsym.check.solvers import Floats, as_float
from kinsym.check.walk import AT_THE_ORIGIN
from kinsym.emit.schedule import Schedule


class TreeKinematics:
    """The forward kinematics and the Jacobian of a schedule in vectorised float64, read from the trees."""

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        numbers = floating()
        self._names = [joint.name for joint in schedule.joints]
        self.free = np.array([name not in schedule.locked for name in self._names])
        given: dict[str, Any] = {name: as_float(value) for name, value in parameters.items()}
        constants = Program(schedule.constants, (), numbers)
        self._given = constants.names(given)
        self._forward = Program(schedule.forward.definitions, schedule.forward.outputs, numbers)
        self._jacobian = Program(schedule.jacobian.definitions, schedule.jacobian.outputs, numbers)
        self.size = float(Program((), (schedule.size,), numbers)({**AT_THE_ORIGIN, **self._given})[0])

    def forward(self, q: Floats) -> Floats:
        """(..., n) to (..., 4, 4)."""
        pose = np.zeros((*q.shape[:-1], 4, 4))
        pose[..., 3, 3] = 1.0
        for position, value in enumerate(self._forward(self._with(q))):
            pose[..., position // 4, position % 4] = value
        return pose

    def jacobian(self, q: Floats) -> Floats:
        """(..., n) to (..., 6, n); a locked joint does not move, so its column is zero."""
        n = len(self._names)
        result = np.zeros((*q.shape[:-1], 6, n))
        for position, value in enumerate(self._jacobian(self._with(q))):
            result[..., position // n, position % n] = value
        result[..., ~self.free] = 0.0
        return result

    def _with(self, q: Floats) -> dict[str, Any]:
        return {**self._given, **{name: q[..., column] for column, name in enumerate(self._names)}}
