"""The elimination with 50 digits gives the same solutions as the generated code."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from kinsym.check.evaluate import exact
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.newton import STEPS, Newton
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import from_inline
from tests.general.arms import derived, joint_vectors, misses, module, nearest, run

ARMS = ["random1", "xarm6", "crx10ia", "slide1", "slide4", "slide25", "five1"]


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("flat", [False, True])
def test_the_same_solutions_with_fifty_digits(name: str, flat: bool) -> None:
    arm = module(name)
    q = joint_vectors(arm, 4, seed=11)
    if flat:
        q[:, 4 if name == "slide4" else 3] = 0.0
    poses = arm.fk(q)
    exact, count = ExactSolver(build_schedule(derived(name)), {}).inverse(poses, q)
    found, valid = arm.ik_batch(poses)
    assert nearest(arm, exact, q).max() < 1e-9
    assert count.tolist() == valid.sum(axis=1).tolist()
    for column in range(found.shape[1]):
        rows = valid[:, column]
        assert nearest(arm, exact[rows], found[rows, column]).max(initial=0.0) < 1e-9


def test_two_slides_where_the_first_angle_tells_nothing() -> None:
    """Two axes are parallel at theta = 0, a sample of what is looked at: any angle serves between them."""
    table = (
        "-pi/2 0.454 d1 0; -pi/2 0.141 -0.553 theta2; pi/2 0 0 theta3; "
        "pi/2 0 0.417 theta4; 0 -0.076 d5 pi/2; 0 0 0 theta6"
    )
    derivation = derive(from_inline(table, convention="paul", name="two_slides"))
    arm = run(build_schedule(derivation))
    q = np.array([[0.3284339716250947, 0.4936093926435424, 0.0, 0.8967474187362211, -2.1e-10, -0.0972089243012052]])
    found, count = ExactSolver(build_schedule(derivation), {}).inverse(arm.fk(q), q)
    assert count[0] >= 1
    assert misses(arm, arm.fk(q), found, np.arange(found.shape[1]) < count[:, None]).max() < 1e-12


def test_nothing_is_a_solution_of_a_pose_out_of_reach() -> None:
    pose = np.eye(4)
    pose[0, 3] = 50.0
    solver = ExactSolver(build_schedule(derived("random1")), {})
    assert solver.inverse(pose[None], np.zeros((1, 6)))[1].tolist() == [0]
    assert solver.refuses(2 * np.eye(4))


def test_newton_ends_when_a_step_changes_nothing() -> None:
    """A pose in doubles is no exact rotation, so that its entries are never met to the last of 50 digits."""
    ctx, _ = exact()
    tried = []

    def turned(q: Sequence[Any]) -> list[list[Any]]:
        tried.append(q)
        c, s = ctx.cos(q[0]), ctx.sin(q[0])
        return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0]]

    newton = Newton(ctx, "R", turned, lambda q: [[0]] * 5 + [[1]])
    c, s = math.cos(0.7), math.sin(0.7)
    found = newton.polished([ctx.mpf(0.6)], [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0]], ctx.one)
    assert found is not None
    assert abs(found[0] - ctx.atan2(s, c)) < 1e-40
    assert 3 < len(tried) < STEPS / 2
