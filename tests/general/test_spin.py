"""Five joints without a closed form that place a point and a direction; the turn about it is a sixth, left out."""

from __future__ import annotations

from functools import cache
from types import ModuleType

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline
from kinsym.robot.model import Task
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import joint_vectors, misses, nearest, random_table, run

#: The prismatic joints of made-up arms with five joints.
ARMS = {"turning": (), "slide2": (2,), "slides13": (1, 3)}


@cache
def schedule(name: str) -> Schedule:
    """The schedule of an arm that is asked for a position and an axis."""
    table = random_table(31, slides=ARMS[name]).rpartition("; ")[0]
    derivation = derive(from_inline(table, convention="paul", name=name), task=Task.POSITION_AXIS)
    assert derivation.plan is None
    return build_schedule(derivation)


@cache
def module(name: str) -> ModuleType:
    """The generated module."""
    return run(schedule(name))


@pytest.mark.parametrize("name", ARMS)
def test_finds_what_the_pose_was_made_from_and_reaches_it(name: str) -> None:
    arm = module(name)
    q = joint_vectors(arm, 100, seed=3)
    poses = arm.fk(q)
    solutions, valid = arm.ik_batch(poses)
    assert nearest(arm, solutions, q).max() < 1e-9
    assert misses(arm, poses, solutions, valid)[..., :3, 2:].max() < 1e-12
    assert np.isnan(solutions[~valid]).all()


@pytest.mark.parametrize("name", ARMS)
def test_no_pose_no_solution(name: str) -> None:
    solutions, valid = module(name).ik_batch(np.zeros((0, 4, 4)))
    assert solutions.shape[::2] == (0, 5)
    assert valid.shape[0] == 0


@needs_compiler
@pytest.mark.parametrize("name", ARMS)
def test_the_c_finds_the_same(name: str) -> None:
    arm = module(name)
    q = joint_vectors(arm, 50, seed=12)
    poses = arm.fk(q)
    found, count = CSolver(CLibrary(schedule(name)).library, schedule(name), {}).inverse(poses, q)
    solutions, valid = arm.ik_batch(poses)
    assert (count == valid.sum(axis=1)).all()
    assert np.allclose(found, solutions, rtol=0, atol=1e-9, equal_nan=True)
