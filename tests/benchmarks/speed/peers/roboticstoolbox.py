"""Robotics Toolbox for Python (Corke): symbolic derivation, its Python solver and the C that it generates.

``python -m tests.benchmarks.speed.peers.roboticstoolbox ARM FOLDER`` derives and writes C in a process of its own, so
that it can be timed as a user would run it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from roboticstoolbox import DHRobot, PrismaticDH, RevoluteDH

from tests.benchmarks.speed.arms import ARMS, Arm, Floats
from tests.benchmarks.speed.peers import Refused

#: A sliding joint must have limits, though nobody asks for them here.
SLIDE = [-1.0, 1.0]


def _robot(arm: Arm) -> DHRobot:
    links = [
        RevoluteDH(alpha=row.alpha, a=row.a, d=row.d, offset=row.theta)
        if row.kind == "R"
        else PrismaticDH(alpha=row.alpha, a=row.a, theta=row.theta, offset=row.d, qlim=SLIDE)
        for row in arm.rows
    ]
    return DHRobot(links, name=arm.name)


def _derived(arm: Arm) -> Any:
    try:
        return _robot(arm).analytic_ik()
    except (ValueError, NotImplementedError) as error:
        raise Refused(str(error)) from error


def solve(arm: Arm) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose, and how its answer is read."""
    solver = _derived(arm)
    return lambda pose: solver.solve(pose, joint_limits=False), lambda answer: np.array(answer.q).reshape(-1, 6)


def generate(arm: Arm, folder: Path) -> None:
    """Write ``ARM_toolbox.c`` with a function of that name."""
    text = _derived(arm).generate("c", f"{arm.name}_toolbox")
    (folder / f"{arm.name}_toolbox.c").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    try:
        generate(ARMS[sys.argv[1]], Path(sys.argv[2]))
    except Refused as why:
        sys.exit(f"refused: {why}")
