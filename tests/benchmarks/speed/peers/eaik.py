"""EAIK (Ostermeier, Külz, Althoff): subproblem decomposition in C++, called from Python. It takes the table."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from eaik.IK_DH import DhRobot

from tests.benchmarks.speed.arms import Arm, Floats
from tests.benchmarks.speed.peers import Refused


def _robot(arm: Arm) -> Any:
    if any(row.kind != "R" or row.theta for row in arm.rows):
        raise Refused("revolute joints alone")
    robot = DhRobot(*(np.array([getattr(row, name) for row in arm.rows]) for name in ("alpha", "a", "d")))
    if not robot.hasKnownDecomposition():
        raise Refused(f"no decomposition: {robot.getKinematicFamily()}")
    return robot


def solve(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose, and how its answer is read; least squares are no solutions."""
    return _robot(arm).IK, _exact


def batch(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], list[Floats]]]:
    """The call for many poses, in the one thread that everybody has here."""
    robot = _robot(arm)
    return lambda poses: robot.IK_batched(poses, 1), lambda answers: [_exact(answer) for answer in answers]


def _exact(answer: Any) -> Floats:
    kept = [q for q, least_squares in zip(answer.Q, answer.is_LS, strict=True) if not least_squares]
    return np.array(kept).reshape(-1, 6)
