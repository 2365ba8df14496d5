"""Slides that are divided by next to nothing: two are nearly parallel, and the angle before has lost its digits."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.evaluate import exact
from kinsym.check.marks import Mark
from kinsym.check.settle import Goal, Settler, Solution
from kinsym.check.solvers import Solver
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.check.walk import ExactWalk
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline
from tests.emit.built import CLibrary, needs_compiler
from tests.emit.made_from import Arm, exactly, in_c, in_numpy, values
from tests.emit.made_from import schedule as made_up
from tests.general.arms import closures, run

#: A made-up arm in Paul's convention: with theta3 = 0 slides 1 and 5 are parallel, axes 2 and 4 as well.
ARM = "0 0.562 d1 0; pi/2 0 0 theta2; -pi/2 0 0.555 theta3; 0 0 0.237 theta4; pi/2 0 d5 pi/2; 0 -0.442 d6 pi/2"


@cache
def schedule() -> Schedule:
    """The schedule of the arm."""
    return build_schedule(derive(from_inline(ARM, convention="paul", name="slides")))


def joint_vectors() -> np.ndarray:
    """Vectors with theta3 = 0, and ever farther beside."""
    rng = np.random.Generator(np.random.PCG64(7))
    q = rng.uniform(-1.5, 1.5, (140, 6))
    q[:, 2] = np.tile([0.0, *10.0 ** -np.arange(3.0, 16.0)], 10) * rng.uniform(1.0, 3.0, 140)
    return q


def poses(q: np.ndarray) -> np.ndarray:
    """Their poses (N, 4, 4), entries near zero as little known as the others."""
    return np.asarray(np.round(run(schedule()).fk(q) * 2.0**53) / 2.0**53)


def test_every_pose_is_reached() -> None:
    q = joint_vectors()
    off = closures(run(schedule()), q, run(schedule()).ik_batch(poses(q), reference=q)[0])
    assert np.nanmin(off, axis=1).max() < 1e-9


@needs_compiler
def test_every_pose_is_reached_in_c() -> None:
    q = joint_vectors()
    solutions, _ = CSolver(CLibrary(schedule()).library, schedule(), {}).inverse(poses(q), q)
    assert np.nanmin(closures(run(schedule()), q, solutions), axis=1).max() < 1e-9


def test_a_vector_with_far_slides_is_settled_with_fifty_digits() -> None:
    ctx, numbers = exact()
    walk, arm = ExactWalk(schedule(), {}), schedule()
    settler = Settler(
        ctx,
        joints=arm.joints,
        task=arm.task,
        forward=walk.forward,
        jacobian=walk.jacobian,
        wrap=numbers.functions["wrap"],
    )
    target = [ctx.mpf(value) for value in ("0.05", "0.66", "1e-13", "1.8", "0.6", "-1.2")]
    far = [value + change for value, change in zip(target, (10**11, 0.001, 0, -0.001, -(10**11), 0.5), strict=True)]
    goal = Goal(walk.forward(target), walk.size, 4 * ctx.mpf(2) ** -46)
    (found,) = settler.settle(Solution(0, far), 0, Mark.SOFT, goal)
    assert max(abs(value) for value in found.q) < 100
    gap = [
        a - b
        for left, right in zip(walk.forward(found.q), goal.rows, strict=True)
        for a, b in zip(left, right, strict=True)
    ]
    assert max(map(abs, gap)) < 1e-12


SLIDES: Arm = ("three slides anywhere", 1, 77)
FAR = np.array(
    [
        [2.3785658363930127, 0.35605081715660974, -0.2443861742580738, -1.825092469056955, np.pi, -0.14841640419257704],
        [-0.3993018, 0.6629881483120713, 1.1429244, 0.28857010433926966, -2.7404695599553304e-09, 1.8007637],
        [0.7027587619, -1.507225332, -2.747684545, -1.56920244, 0.0, -2.531404824],
        [-2.2741038852, -3.1415926533198424, 1.2624322160, -1.7339871443748796, 2.964970291175057, 2.8330275629],
    ]
)
"""Poses whose other solutions have slides of 10^7 to 10^9 times the arm: doubles cannot tell whether they reach it."""


@needs_compiler
@pytest.mark.parametrize("solver", [in_c, in_numpy, exactly])
def test_what_rounding_cannot_tell_is_no_solution(solver: Callable[[Arm], Solver]) -> None:
    kinematics = TreeKinematics(made_up(SLIDES), values(SLIDES))
    poses = kinematics.forward(FAR)
    solutions, count = solver(SLIDES).inverse(poses, FAR)
    off = np.abs(kinematics.forward(np.nan_to_num(solutions)) - poses[:, None]).max(axis=(2, 3)) / kinematics.size
    there = np.arange(solutions.shape[1]) < count[:, None]
    assert (count >= 1).all()
    assert off[there].max() < 1e-9
    assert np.abs(solutions[there]).max() < 1e8
