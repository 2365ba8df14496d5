"""When two joint vectors count as one solution: families and double roots do, branches do not."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from kinsym.check.laws import PATH, Judge
from kinsym.check.poses import PAIR, QUARTER, SINGULAR, UNIFORM, Counts, generator, samples
from kinsym.check.singular import volume_of
from kinsym.check.solvers import Floats
from kinsym.check.task import task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import load


def judge_of(name: str) -> tuple[Derivation, Judge]:
    """The judge of a robot of the gallery, lengths without a value set to 1/2, 3/4, 1 ..."""
    derivation = derive(load(name))
    schedule = build_schedule(derivation)
    given = {p.name: p.value or Fraction(index + 2, 4) for index, p in enumerate(schedule.parameters)}
    revolute = np.array([joint.kind == "R" for joint in schedule.joints])
    return derivation, Judge(TreeKinematics(schedule, given), schedule.task, revolute, float(schedule.tau))


def joined(judge: Judge, start: list[float], end: list[float]) -> bool:
    """Whether two joint vectors count as the same solution of the second one's pose."""
    q, known = np.array([[start]]), np.array([[end]])
    return bool(judge.joined(q, known, judge.kinematics.forward(known[:, 0]))[0, 0])


def test_a_family_is_one_solution() -> None:
    """Spherical wrist with theta5 = 0: only the sum of the outer angles counts, whatever way leads there."""
    _, judge = judge_of("puma560")
    arm = [0.3, -0.8, 0.4]
    assert joined(judge, [*arm, 1.0, 0.0, -0.4], [*arm, -0.6, 0.0, 1.2])
    assert not joined(judge, [*arm, 1.0, 0.0, -0.4], [*arm, -0.6, 0.0, 1.3])


def test_branches_are_different_solutions() -> None:
    """The flipped wrist reaches the same pose and is another solution, near the singular pose as well."""
    _, judge = judge_of("puma560")
    arm = [0.3, -0.8, 0.4]
    for bend in (0.5, 1e-3, 1e-6):
        known = [*arm, 1.0, bend, -0.4]
        flipped = [*arm, 1.0 - np.pi, -bend, -0.4 + np.pi]
        assert float(judge.closures(np.array([[flipped]]), judge.kinematics.forward(np.array([known])))[0, 0]) < PATH
        assert not joined(judge, flipped, known)


def test_a_curved_way_is_found() -> None:
    """Stanford arm with d3 = 0: theta2 is free and the wrist makes up for it along a curve."""
    derivation, judge = judge_of("stanford_paul")
    known = np.array([0.3, 0.9, 0.0, 0.4, 1.1, -0.7])
    pose = judge.kinematics.forward(known[None])
    from kinsym.check.exact_solver import ExactSolver

    exact = ExactSolver(
        build_schedule(derivation),
        {p.name: p.value or Fraction(i + 2, 4) for i, p in enumerate(build_schedule(derivation).parameters)},
    )
    elsewhere, count = exact.inverse(pose, np.zeros((1, 6)))
    assert count[0] > 0
    assert not np.isclose(elsewhere[0, : count[0], 1], 0.9).any()
    assert judge.found(elsewhere, known[None], pose).all()


@pytest.mark.parametrize("name", ["ur5", "scara", "elbow_rrr"])
def test_samples_lie_where_they_are_said_to(name: str) -> None:
    """Singular samples lose volume in proportion to their offset; the same seed gives the same samples."""
    derivation, judge = judge_of(name)
    schedule, size = build_schedule(derivation), judge.kinematics.size

    def volume(q: Floats) -> Floats:
        pose = judge.kinematics.forward(q)
        return volume_of(task_jacobian(judge.kinematics.jacobian(q), pose, schedule.task, size))

    counts = Counts(uniform=50, quarter=40, singular=60, pair=10)
    one, two = (samples(schedule.joints, volume, size, counts, generator("ab" * 8, 0)) for _ in range(2))
    assert np.array_equal(one.q, two.q)
    assert [int(one.of(kind).sum()) for kind in (UNIFORM, QUARTER, SINGULAR, PAIR)] == [50, 40, 60, 10]
    height = volume(one.q)
    usual = np.median(height[one.of(UNIFORM)])
    near = one.of(SINGULAR) & (one.offset < 1e-8)
    assert near.sum() > 10
    assert (height[near] < 1e-6 * max(usual, 1e-3)).all()
    assert (height[one.of(UNIFORM)] > 1e-8).all()
