"""Two branches of an arm with more equations than joints that settle as one solution: it is returned once."""

from __future__ import annotations

from functools import cache

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline
from kinsym.robot.model import Task
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import run

#: A made-up arm in Paul's convention, asked for a whole pose; its roots never meet. Slide 4 is vertical if
#: theta3 = pi/2, and next to that the second branch, which the pose excludes, is moved onto the first.
ARM = "0 0.426 0.478 theta1; -pi/2 0.188 0.562 theta2; -pi/2 -0.213 0.507 theta3; -pi/2 0 d4 pi/2; 0 0.149 0.169 theta5"


@cache
def schedule() -> Schedule:
    """The schedule of the arm."""
    return build_schedule(derive(from_inline(ARM, convention="paul", name="vertical"), task=Task.POSE))


def poses() -> np.ndarray:
    """Poses (N, 4, 4) beside theta3 = pi/2, entries near zero as little known as the others."""
    rng = np.random.Generator(np.random.PCG64(10))
    q = rng.uniform(-1.5, 1.5, (400, 5))
    q[:, 2] = np.pi / 2 + 1e-8 * rng.uniform(1.0, 3.0, 400)
    return np.asarray(np.round(run(schedule()).fk(q) * 2.0**53) / 2.0**53)


def nearest(solutions: np.ndarray) -> float:
    """How near two of the solutions (N, 2, 5) of one pose are, in the joint that differs most."""
    gap = np.abs(solutions[:, 0] - solutions[:, 1]).max(axis=-1)
    return float(np.nanmin(gap, initial=np.inf))


def test_it_is_returned_once() -> None:
    solutions, valid = run(schedule()).ik_batch(poses())
    assert valid.any(axis=1).all()
    assert nearest(solutions) > 1e-7


@needs_compiler
def test_it_is_returned_once_in_c() -> None:
    solutions, count = CSolver(CLibrary(schedule()).library, schedule(), {}).inverse(poses(), np.zeros((400, 5)))
    assert (count > 0).all()
    assert nearest(solutions) > 1e-7
