"""A joint that is free within bounds: the reference may put it where the other joints cannot follow.

With theta3 = 0 axes 2, 4, 5 and 6 are parallel, and the links between them a crank that does not go all the way round.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from kinsym.check.solvers import Solver
from kinsym.check.tree_kinematics import TreeKinematics
from tests.emit.built import needs_compiler
from tests.emit.made_from import Arm, exactly, in_c, in_numpy, lost, schedule, values

ARM: Arm = ("three axes parallel, 4-6", 4, 77)


def joint_vectors(count: int) -> np.ndarray:
    """Vectors with theta3 = 0, and beside."""
    q = np.random.Generator(np.random.PCG64(1)).uniform(-3.0, 3.0, (count, 6))
    q[:, 2] = np.resize([0.0, 1e-15, 3e-15, 1e-14, 1e-13], count)
    return q


def unanswered(solver: Callable[[Arm], Solver], q: np.ndarray, reference: np.ndarray) -> int:
    """How many of the poses of joint vectors (k, 6) have no solution, or one that is off."""
    arm = TreeKinematics(schedule(ARM), values(ARM))
    poses = arm.forward(q)
    solutions, count = solver(ARM).inverse(poses, reference)
    off = np.abs(arm.forward(np.nan_to_num(solutions)) - poses[:, None]).max(axis=(2, 3)) / max(1.0, arm.size)
    there = np.arange(solutions.shape[1]) < count[:, None]
    return int(((count == 0) | (there & (off > 1e-12)).any(axis=1)).sum())


@needs_compiler
@pytest.mark.parametrize("solver", [in_c, in_numpy])
def test_every_pose_is_answered(solver: Callable[[Arm], Solver]) -> None:
    q = joint_vectors(200)
    assert unanswered(solver, q, np.zeros(q.shape)) == 0


def test_every_pose_is_answered_with_fifty_digits() -> None:
    q = np.array(
        [
            [0.07092975, 2.70278218, 0.0, 2.69189668, -1.12901129, -0.46004131],
            [-1.7927808, 2.92931341, 0.0, -0.84127844, 0.84908154, -0.71411076],
        ]
    )
    assert unanswered(exactly, q, np.zeros(q.shape)) == 0


@needs_compiler
@pytest.mark.parametrize("solver", [in_c, in_numpy])
def test_a_reference_that_fits_is_taken(solver: Callable[[Arm], Solver]) -> None:
    q = joint_vectors(40)
    assert not lost(ARM, solver(ARM), q, q)
