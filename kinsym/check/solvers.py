"""One face for the three answers that must agree: the exact walk, the generated NumPy module, the compiled C.

All three take batches. ``inverse`` returns the solutions packed to the left, (m, S, n) with NaN behind them, and
how many there are, (m,). A locked joint that is an input stands where the reference joint vector has it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from kinsym.emit.schedule import Schedule

Floats = NDArray[np.float64]
Solutions = tuple[Floats, NDArray[np.intp]]


class Solver(Protocol):
    """Forward kinematics, Jacobian and inverse kinematics for one choice of parameters."""

    name: str

    def forward(self, q: Floats) -> Floats:
        """(m, n) joint vectors to (m, 4, 4) poses."""

    def jacobian(self, q: Floats) -> Floats:
        """(m, n) joint vectors to (m, 6, n)."""

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        """(m, 4, 4) poses and (m, n) references, which hold locked inputs, to packed solutions and their numbers."""

    def refuses(self, pose: Floats) -> bool:
        """Whether a single (4, 4) array is told to be no pose."""


def as_float(value: Fraction) -> float:
    """The nearest double."""
    return value.numerator / value.denominator


def inputs_of(schedule: Schedule) -> list[tuple[int, str]]:
    """Column and name of every locked joint that is an input."""
    return [(column, joint.name) for column, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]
