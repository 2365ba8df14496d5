"""Time of the generated Python, one pose and many: ``python -m tests.benchmarks.python_speed [NAME ...]``.

Times are of the processor, the least of several rounds, and stand beside what the same machine takes for arithmetic:
for one pose a multiplication and an arc tangent of plain Python, for many an arc tangent of NumPy, an element of an
array that fits in the cache. Every answer that is timed is put through the forward kinematics, and the joint vector
that the pose was made from must be among the solutions; the exit status is 1 if one is not.
"""

from __future__ import annotations

import math
import sys
import time
import types
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.task import closure
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.robot import load
from kinsym.robot.model import Task

Floats = NDArray[np.float64]

ROBOTS = ("puma560", "ur5", "stanford_arm", "kuka_kr6_r900", "fanuc_s900w", "scara", "planar_rr")
SINGLE = 200
MANY = 100_000
ROUNDS = 5
CLOSURE = 1e-9
KNOWN = 1e-6
FAR = 1e9


class Arm:
    """The generated module of a gallery robot; lengths that the table leaves open differ from each other."""

    def __init__(self, name: str) -> None:
        module = types.ModuleType(name)
        (source,) = TARGETS["numpy"](build_schedule(derive(load(name)))).values()
        exec(compile(source, f"{name}.py", "exec"), module.__dict__)
        self.module: Any = module
        given = {name: 0.3 + 0.1 * place for place, name in enumerate(self.module.PARAMETERS)}
        given |= {name: value for name, value in self.module.PARAMETERS.items() if value is not None}
        self.ik, self.ik_batch, self.fk = (
            partial(function, **given) for function in (self.module.ik, self.module.ik_batch, self.module.fk)
        )

    def wrong(self, q: Floats, poses: Floats, known: Floats) -> int:
        """Of how many poses (m, 4, 4) a solution misses the pose or the known joint vector (m, n) is not among them.

        ``q`` (m, S, n) are the solutions, NaN where there is none.
        """
        there = np.isfinite(q).all(axis=-1)
        reached = self.fk(np.where(there[..., None], q, 0.0))
        gap = closure(reached, poses[:, None], Task(self.module.TASK), 1.0)
        missed = (there & ~(gap <= CLOSURE)).any(axis=1)
        away = np.where(there[..., None], q, FAR) - known[:, None]
        turns = np.where(np.array(self.module.JOINT_TYPES) == "R", np.round(away / (2.0 * np.pi)), 0.0)
        away = np.abs(away - 2.0 * np.pi * turns).max(axis=-1)
        lost = ~(np.where(there, away, FAR).min(axis=1) <= KNOWN)
        return int((missed | lost).sum())


def seconds(work: Callable[[], object]) -> float:
    """The least time of a few rounds."""
    best = math.inf
    for _ in range(ROUNDS):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
    return best


def unit_of_python() -> float:
    """Seconds of one multiplication and one arc tangent of plain Python."""

    def work() -> None:
        x = 0.3
        for _ in range(200_000):
            x = math.atan2(0.7 * x, 0.4)

    return seconds(work) / 200_000


def unit_of_numpy() -> float:
    """Seconds of one arc tangent of NumPy in an array of 4096."""
    y, x = np.random.default_rng(1).uniform(-1.0, 1.0, (2, 4096))

    def work() -> None:
        for _ in range(100):
            np.arctan2(y, x)

    return seconds(work) / 409_600


def measure(name: str, python: float, numpy: float) -> int:
    """Print one line; how many answers were wrong."""
    arm = Arm(name)
    known = np.random.default_rng(2).uniform(-3.0, 3.0, (MANY, len(arm.module.JOINTS)))
    poses = arm.fk(known)
    alone = list(poses[:SINGLE])
    one = seconds(lambda: [arm.ik(pose) for pose in alone]) / SINGLE
    many = seconds(lambda: arm.ik_batch(poses)) / MANY
    q, _ = arm.ik_batch(poses)
    single = np.full((SINGLE, *q.shape[1:]), np.nan)
    for row, pose in enumerate(alone):
        found = arm.ik(pose)
        single[row, : len(found)] = found
    bad = arm.wrong(q, poses, known) + arm.wrong(single, poses[:SINGLE], known[:SINGLE])
    print(
        f"{name:<16} {1e6 * one:8.1f} us {one / python:8.0f} {1e6 * many:10.3f} us {many / numpy:8.0f} {bad:8}",
        flush=True,
    )
    return bad


def main() -> None:
    """Print a table."""
    python, numpy = unit_of_python(), unit_of_numpy()
    print(f"plain Python: {1e9 * python:.0f} ns a multiplication and an arc tangent")
    print(f"NumPy {np.__version__}: {1e9 * numpy:.1f} ns an arc tangent\n")
    print(f"{'':<16} {'one pose':>11} {'of these':>8} {'of many':>13} {'of these':>8} {'wrong':>8}")
    sys.exit(1 if sum([measure(name, python, numpy) for name in sys.argv[1:] or ROBOTS]) else 0)


if __name__ == "__main__":
    main()
