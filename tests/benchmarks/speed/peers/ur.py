"""ur-analytic-ik: C++ written by hand for the arms of Universal Robots, called from Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import ur_analytic_ik

from tests.benchmarks.speed.arms import Arm, Floats
from tests.benchmarks.speed.peers import Refused


def solve(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose, and how its answer is read."""
    if arm.name != "ur5":
        raise Refused("the UR5 alone is its kind")
    return ur_analytic_ik.ur5.inverse_kinematics, lambda answer: np.array(answer).reshape(-1, 6)
