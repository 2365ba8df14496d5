"""The generated NumPy of arms without a closed form."""

from __future__ import annotations

import ast
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.source.numpy_source import numpy_source
from kinsym.general.arm import six_joints
from kinsym.general.ranks import usable
from kinsym.robot import from_inline
from tests.general.arms import COBOTS, derived, joint_vectors, misses, module, nearest, random_table, run

PAIRS = ("slide12", "slide24", "slide36", "slide56")
ARMS = ["random1", "random2", *COBOTS, *(f"slide{number}" for number in range(1, 7)), *PAIRS]


@pytest.mark.parametrize("name", ARMS)
def test_finds_what_the_pose_was_made_from_and_reaches_it(name: str) -> None:
    arm = module(name)
    q = joint_vectors(arm, 100, seed=3)
    poses = arm.fk(q)
    solutions, valid = arm.ik_batch(poses)
    assert nearest(arm, solutions, q).max() < 1e-6
    assert misses(arm, poses, solutions, valid).max() < 1e-12
    assert np.isnan(solutions[~valid]).all()
    assert not (valid.sum(axis=1) % 2).any()


@pytest.mark.parametrize("name", ["random3", "xarm6", "crx10ia", "slide3"])
def test_no_other_way_round_the_loop_finds_more(name: str) -> None:
    derivation = derived(name)
    arm, plan = six_joints(derivation.chain), derivation.general
    assert arm is not None
    assert plan is not None
    others = [cut for cut in usable(arm) if cut not in plan.cuts]
    solver = module(name)
    poses = solver.fk(joint_vectors(solver, 40, seed=4))
    best = solver.ik_batch(poses)[0]
    for first, second in zip(others[::5], others[1::5], strict=False):
        other = run(build_schedule(replace(derivation, general=replace(plan, cuts=(first, second)))))
        found, valid = other.ik_batch(poses)
        for column in range(found.shape[1]):
            rows = valid[:, column]
            assert nearest(solver, best[rows], found[rows, column]).max(initial=0.0) < 1e-6


@pytest.mark.parametrize("name", COBOTS)
@pytest.mark.parametrize("joint", [1, 2, 3, 4])
@pytest.mark.parametrize("turn", [0.0, np.pi, np.pi / 2])
def test_solutions_that_share_an_angle_by_symmetry_are_found(name: str, joint: int, turn: float) -> None:
    """Poses of a cobot in its own plane: several solutions have the same theta1, and theta4 = 0 or pi."""
    arm = module(name)
    q = joint_vectors(arm, 30, seed=5)
    q[:, joint] = turn
    poses = arm.fk(q)
    solutions, _ = arm.ik_batch(poses)
    regular = np.linalg.svd(arm.jacobian(q), compute_uv=False)[:, -1] > 1e-3
    assert regular.any()
    assert nearest(arm, solutions[regular], q[regular]).max() < 1e-6


@pytest.mark.parametrize("name", ["random1", "slide3", "slide24", "five1"])
def test_every_name_is_given_once(name: str) -> None:
    """The parts of a module are put together from files that do not know each other's names."""
    (text,) = numpy_source(build_schedule(derived(name))).values()
    names = Counter(item.name for item in ast.parse(text).body if isinstance(item, ast.FunctionDef | ast.ClassDef))
    assert names
    assert set(names.values()) == {1}


@pytest.mark.parametrize("name", ["random1", "slide24"])
def test_limits_and_windings_of_a_solver(name: str) -> None:
    arm = module(name)
    (q,) = joint_vectors(arm, 1, seed=9)
    near = arm.nearest(arm.fk(q), q, limits=np.stack([q - 4.0, q + 4.0], axis=1))
    assert np.abs(near - q).max() < 1e-6


def test_five_joints_reach_a_position_and_an_axis() -> None:
    """The turn of the tool about its axis, which the pose has and the task does not ask for, changes nothing."""
    arm = module("five1")
    assert (arm.TASK, arm.JOINTS[-1], arm.MAX_SOLUTIONS) == ("position_axis", "theta5", 16)
    q = joint_vectors(arm, 60, seed=12)
    poses = arm.fk(q)
    spun = poses.copy()
    spun[:, :3, 0], spun[:, :3, 1] = poses[:, :3, 1], -poses[:, :3, 0]
    for given in (poses, spun):
        solutions, valid = arm.ik_batch(given)
        assert nearest(arm, solutions, q).max() < 1e-6
        gap = arm.fk(np.where(valid[..., None], solutions, 0.0)) - given[:, None]
        assert np.abs(gap[..., 2:])[valid].max() < 1e-12


@pytest.mark.parametrize("slides", ["PRPRPR", "PRPRRP", "RPRPRP"])
def test_three_slides_apart_have_a_closed_form(slides: str) -> None:
    """No equation holds one length alone: two are solved for two of them."""
    cells = ("pi/2 0.3 0.1", "0.7 0.25 0.12", "-1.1 0.2 -0.15", "0.9 0.15 0.3", "1.3 0.1 0.1", "0.4 0.05 0.2")
    rows = [
        f"{cell} theta{k}" if kind == "R" else f"{cell.rpartition(' ')[0]} d{k} 0"
        for k, (kind, cell) in enumerate(zip(slides, cells, strict=True), start=1)
    ]
    derivation = derive(from_inline("; ".join(rows), convention="paul", name="three"))
    assert derivation.plan is not None
    arm = run(build_schedule(derivation))
    q = joint_vectors(arm, 50, seed=13)
    assert nearest(arm, arm.ik_batch(arm.fk(q))[0], q).max() < 1e-9


def test_solutions_are_sorted_by_the_first_joint() -> None:
    arm = module("random1")
    solutions, valid = arm.ik_batch(arm.fk(joint_vectors(arm, 50, seed=6)))
    first = np.where(valid, solutions[..., 0], np.inf)
    assert (np.diff(np.where(np.isinf(first), 9.0, first), axis=1) > -1e-6).all()
    assert (valid[:, :-1] | ~valid[:, 1:]).all()


def test_poses_out_of_reach_have_no_solution() -> None:
    arm = module("random1")
    poses = arm.fk(joint_vectors(arm, 20, seed=7))
    for far in (10.0, 1e6, 1e140):
        poses[:, :3, 3] = far
        assert not arm.ik_batch(poses)[1].any()


def test_what_is_no_pose_is_refused() -> None:
    arm = module("random1")
    pose = arm.fk(np.zeros(6))
    for row, column, value in ((0, 0, np.nan), (1, 3, np.inf), (3, 3, 2.0), (0, 0, 5.0)):
        wrong = pose.copy()
        wrong[row, column] = value
        with pytest.raises(ValueError, match="pose 0 is no rigid motion"):
            arm.ik(wrong)
    with pytest.raises(ValueError, match="shape"):
        arm.ik(pose[:3])
    with pytest.raises(ValueError, match="reference joint vector must be finite"):
        arm.ik(pose, reference=[np.nan] * 6)


def test_any_shape_of_a_batch() -> None:
    arm = module("slide2")
    q = joint_vectors(arm, 6, seed=8)
    poses = arm.fk(q)
    solutions, valid = arm.ik_batch(poses.reshape(2, 3, 4, 4))
    assert solutions.shape == (2, 3, 16, 6)
    assert valid.shape == (2, 3, 16)
    single = arm.ik(poses[4], reference=q[4])
    assert np.allclose(single, solutions[1, 1][valid[1, 1]], atol=1e-9)
    assert arm.ik_batch(np.zeros((0, 4, 4)))[0].shape == (0, 16, 6)


def test_lengths_can_be_given_at_run_time_in_any_unit() -> None:
    cells = [row.split() for row in random_table(9).split("; ")]
    table = "; ".join(f"{row[0]} a{k} {row[2]}*unit {row[3]}" for k, row in enumerate(cells, start=1))
    arm = run(build_schedule(derive(from_inline(table, convention="paul", name="lengths"))))
    for unit in (1.0, 1000.0):
        lengths = {f"a{k}": (0.1 + 0.05 * k) * unit for k in range(1, 7)} | {"unit": unit}
        q = joint_vectors(arm, 30, seed=10)
        solutions, _ = arm.ik_batch(arm.fk(q, **lengths), **lengths)
        assert nearest(arm, solutions, q).max() < 1e-6
    with pytest.raises(ValueError, match="the parameter a1 must be a finite number"):
        arm.ik(np.eye(4), **(lengths | {"a1": np.nan}))
    with pytest.raises(TypeError, match="a1"):
        arm.ik(np.eye(4), unit=1.0)
