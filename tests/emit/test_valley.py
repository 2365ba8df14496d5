"""Marked roots from which the pose is reached only along a curve on which it hardly changes.

At these poses two borders cross: the root that a border merged leaves the next angle up to half a radian from where it
belongs, while the distance to the pose changes by 1e-8 and less on the way.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.laws import PATH, Judge
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Solver
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from tests.benchmarks.coverage.arms import arm
from tests.benchmarks.coverage.measure import parameters
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import run

#: Made-up arms by class and number, the joint that is moved, where the arm is singular and how far from there: the
#: wrist on axis 2, and axes 3 and 5 in line beside a border of theta1.
ARMS = {
    "wrist_on_axis_2": (
        ("three axes meet, 4-6", 18),
        (2, -2.0311308013378460),
        (2.8e-7, -1.8e-8, 5.6e-10),
        [3.0681155264115336, -2.001853474008702, 0.0, 1.233929731683188, 0.7433566468344303, 0.1444556533654126],
    ),
    "axes_in_line": (
        ("7R locked, spherical ends", 7),
        (2, 0.0),
        (-2.09e-9, -2.6e-10),
        [-2.66968266123358, 2.142303538866217, 0.0, -1.923500936841139, 2.775543386210246, -1.402001609689345],
    ),
}


@cache
def schedule(name: str) -> Schedule:
    """The schedule of an arm."""
    return build_schedule(derive(arm(*ARMS[name][0], seed=1)))


def values(name: str) -> dict[str, Fraction]:
    """Its parameters."""
    return parameters(arm(*ARMS[name][0], seed=1))


def lost_by(name: str, solver: Solver) -> list[float]:
    """The distances at which a solver loses the joint vector that the pose was made from, or misses the pose."""
    _, (joint, zero), distances, joints = ARMS[name]
    q = np.tile(joints, (len(distances), 1))
    q[:, joint] = zero + np.array(distances)
    kinematics = TreeKinematics(schedule(name), values(name))
    judge = Judge(kinematics, schedule(name).task, np.ones(6, dtype=bool), float(schedule(name).tau), PATH)
    poses = kinematics.forward(q)
    solutions, _ = solver.inverse(poses, q)
    on_it = np.nan_to_num(judge.closures(solutions, poses)).max(axis=1) < 1e-12
    return np.array(distances)[~(judge.found(solutions, q, poses) & on_it)].tolist()


@pytest.mark.parametrize("name", ARMS)
def test_the_module_reaches_them(name: str) -> None:
    assert not lost_by(name, NumpySolver(run(schedule(name)), schedule(name), values(name)))


@needs_compiler
@pytest.mark.parametrize("name", ARMS)
def test_the_c_reaches_them(name: str) -> None:
    assert not lost_by(name, CSolver(CLibrary(schedule(name)).library, schedule(name), values(name)))


def test_the_exact_walk_reaches_them() -> None:
    assert not lost_by("wrist_on_axis_2", ExactSolver(schedule("wrist_on_axis_2"), values("wrist_on_axis_2")))
