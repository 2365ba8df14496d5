"""Whether a solver finds the joint vectors that poses were made from, for the made-up arms of the coverage."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.laws import PATH, Judge
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Solver
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot.model import Robot
from tests.benchmarks.coverage.arms import arm
from tests.benchmarks.coverage.measure import parameters
from tests.emit.built import CLibrary
from tests.general.arms import run

Arm = tuple[str, int] | tuple[str, int, int]
"""The class of an arm, its number and, if that is not 1, the seed."""


def robot(made_up: Arm) -> Robot:
    """The arm itself."""
    name, number, *seeds = made_up
    return arm(name, number, *(seeds or [1]))


@cache
def schedule(made_up: Arm) -> Schedule:
    """Its schedule."""
    return build_schedule(derive(robot(made_up)))


def values(made_up: Arm) -> dict[str, Fraction]:
    """Its parameters."""
    return parameters(robot(made_up))


def in_c(made_up: Arm) -> Solver:
    """Its generated C."""
    return CSolver(CLibrary(schedule(made_up)).library, schedule(made_up), values(made_up))


def in_numpy(made_up: Arm) -> Solver:
    """Its generated module."""
    return NumpySolver(run(schedule(made_up)), schedule(made_up), values(made_up))


def exactly(made_up: Arm) -> Solver:
    """The exact walk."""
    return ExactSolver(schedule(made_up), values(made_up))


def lost(made_up: Arm, solver: Solver, q: np.ndarray, reference: np.ndarray) -> list[int]:
    """The rows of joint vectors (k, 6) that a solver loses, or at whose poses an answer is off by 1e-12 and more."""
    kinematics = TreeKinematics(schedule(made_up), values(made_up))
    judge = Judge(kinematics, schedule(made_up).task, np.ones(6, dtype=bool), float(schedule(made_up).tau), PATH)
    poses = kinematics.forward(q)
    solutions, _ = solver.inverse(poses, reference)
    on_it = np.nan_to_num(judge.closures(solutions, poses)).max(axis=1) < 1e-12
    return np.flatnonzero(~(judge.found(solutions, q, poses) & on_it)).tolist()
