"""py-opw-kinematics: Rust for industrial arms with a spherical wrist, called from Python.

Its arm stands upright at zero with axes z, y, y, z, y, z, so angles are shifted and turned between it and the table.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Any

import numpy as np
from py_opw_kinematics import KinematicModel, Robot
from scipy.spatial.transform import RigidTransform

from tests.benchmarks.speed.arms import Arm, Floats
from tests.benchmarks.speed.peers import Refused


def solve(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose, a matrix as everybody gets it, and how its answer is read."""
    if arm.name != "kuka_kr6":
        raise Refused("the KUKA alone is its kind")
    size = arm.lengths
    lengths = {"c1": size["d1"], "c2": size["a2"], "c3": size["d4"], "c4": size["d6"]}
    robot = Robot(KinematicModel(a1=size["a1"], a2=-size["a3"], b=0.0, **lengths), degrees=False)
    upright = np.array([0.0, pi / 2, pi / 2, 0.0, 0.0, 0.0])
    frames = arm.frames(upright)
    signs = np.array([frame["xyz".index(x), 2] for x, frame in zip("zyyzyz", frames, strict=False)])
    turn = np.eye(4)
    turn[:3, :3] = frames[-1][:3, :3].T

    def call(pose: Floats) -> Any:
        return robot.inverse(RigidTransform.from_matrix(pose @ turn))

    return call, lambda answer: upright + signs * np.array(answer).reshape(-1, 6)
