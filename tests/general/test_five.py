"""Five joints without a closed form that are asked for a whole pose, of which they reach few."""

from __future__ import annotations

from functools import cache
from types import ModuleType

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.latex import document
from kinsym.emit.program import build_schedule
from kinsym.emit.text import equations
from kinsym.general.arm import six_joints
from kinsym.general.ranks import usable
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline, lock
from kinsym.robot.model import Robot, Task
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import joint_vectors, misses, nearest, random_robot, random_table, run

#: Made-up arms in Paul's convention, cells alpha a d theta.
TABLES = {
    "skew": random_table(21).rpartition("; ")[0],
    "slide2": random_table(22, slides=(2,)).rpartition("; ")[0],
    "slide5": random_table(23, slides=(5,)).rpartition("; ")[0],
    # Axis 5 is the z axis of the tool.
    "straight": "pi/2 0.2 0.2 theta1; deg(60) 0.3 0.1 theta2; pi/2 0.25 -0.15 theta3; "
    "-pi/2 0.4 0.1 theta4; 0 0 0.25 theta5",
}
ARMS = [*TABLES, "locked"]


def robot(name: str) -> Robot:
    """An arm of :data:`TABLES`, or a six-joint arm of which one joint is given with the pose."""
    if name == "locked":
        return lock(random_robot(24), {"theta3": None})
    return from_inline(TABLES[name], convention="paul", name=name)


@cache
def derived(name: str) -> Derivation:
    """Its derivation for a whole pose."""
    return derive(robot(name), task=Task.POSE)


@cache
def module(name: str) -> ModuleType:
    """The generated module."""
    return run(build_schedule(derived(name)))


def solved(name: str, poses: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All solutions of poses; the joint that is given is taken from the joint vectors."""
    given = {"theta3": q[:, 2]} if name == "locked" else {}
    return module(name).ik_batch(poses, **given)


@pytest.mark.parametrize("name", ARMS)
def test_finds_what_the_pose_was_made_from_and_reaches_it(name: str) -> None:
    assert derived(name).plan is None
    arm = module(name)
    q = joint_vectors(arm, 200, seed=3)
    poses = arm.fk(q)
    solutions, valid = solved(name, poses, q)
    assert nearest(arm, solutions, q).max() < 1e-9
    assert misses(arm, poses, solutions, valid).max() < 1e-12
    assert np.isnan(solutions[~valid]).all()


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-5])
def test_nothing_reaches_a_pose_beside_those_in_reach(name: str, size: float) -> None:
    arm = module(name)
    q = joint_vectors(arm, 50, seed=4)
    poses = arm.fk(q)
    c, s = np.cos(size), np.sin(size)
    poses[:, :3, :3] = poses[:, :3, :3] @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    poses[:, 1, 3] += size
    assert not solved(name, poses, q)[1].any()


@pytest.mark.parametrize("name", ARMS)
def test_postures_at_right_angles(name: str) -> None:
    """Where several joints are straight, axes meet that are skew elsewhere."""
    arm = module(name)
    q = np.random.Generator(np.random.PCG64(5)).integers(-1, 3, (100, len(arm.JOINTS))) * (np.pi / 2)
    solutions, _ = solved(name, arm.fk(q), q)
    assert nearest(arm, solutions, q).max() < 1e-6


@pytest.mark.parametrize("name", ["skew", "slide2", "locked"])
def test_the_same_solutions_with_fifty_digits(name: str) -> None:
    arm = module(name)
    q = joint_vectors(arm, 2, seed=11)
    poses = arm.fk(q)
    exact, count = ExactSolver(build_schedule(derived(name)), {}).inverse(poses, q)
    solutions, valid = solved(name, poses, q)
    assert count.tolist() == valid.sum(axis=1).tolist()
    assert np.allclose(exact, solutions, rtol=0, atol=1e-9, equal_nan=True)
    poses[:, 0, 3] += 1e-6
    assert not ExactSolver(build_schedule(derived(name)), {}).inverse(poses, q)[1].any()


@needs_compiler
@pytest.mark.parametrize("name", ARMS)
def test_the_c_finds_the_same(name: str) -> None:
    schedule, arm = build_schedule(derived(name)), module(name)
    q = joint_vectors(arm, 100, seed=12)
    poses = arm.fk(q)
    solver = CSolver(CLibrary(schedule).library, schedule, {})
    found, count = solver.inverse(poses, q)
    solutions, valid = solved(name, poses, q)
    assert (count == valid.sum(axis=1)).all()
    assert np.allclose(found, solutions, rtol=0, atol=1e-9, equal_nan=True)
    poses[:, 0, 3] += 1e-6
    assert not solver.inverse(poses, q)[1].any()


def test_the_joint_that_is_added_is_in_no_special_place() -> None:
    """About the tool's own axis, which here is axis 5, it would leave no cut to use."""
    chain = build_chain(robot("straight"))
    tilted, spun = six_joints(chain), six_joints(chain, Task.POSITION_AXIS)
    assert tilted is not None
    assert spun is not None
    assert len(usable(tilted)) >= 16
    assert not usable(spun)


def test_the_steps_say_what_joint_is_added() -> None:
    page = " ".join(equations(derived("skew")).split())
    assert "e = (6/7, 2/7, -3/7)" in page
    assert "where phi vanishes the five joints reach it by themselves" in page
    assert "polished once more without the sixth" in page
    text = document(derived("skew"))
    assert r"where $\phi$ vanishes the five joints" in text
    assert r"and $L_{6}$ back" in text
    assert r"within $10^{-9}$ of the pose" in text
