"""When two joint vectors count as one solution: families and double roots do, branches do not."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from kinsym.check.laws import PATH, Judge
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import PAIR, QUARTER, SINGULAR, UNIFORM, Counts, generator, samples, wrapped
from kinsym.check.singular import volume_of
from kinsym.check.solvers import Floats
from kinsym.check.task import task_jacobian
from kinsym.check.tracing import Tracer
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import load
from tests.benchmarks.coverage.arms import arm
from tests.benchmarks.coverage.measure import parameters
from tests.general.arms import run


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


@pytest.mark.parametrize("unit", [1, 1000])
def test_a_way_on_which_joints_slide_is_found_in_any_unit(unit: int) -> None:
    """With theta2 = -pi/2 axis 1 is parallel to axis 5, and two slides move while they turn against each other."""
    robot = arm("two slides anywhere", 4, seed=77)
    schedule = build_schedule(derive(robot))
    given = {name: value * unit for name, value in parameters(robot).items()}
    slides = np.array([joint.kind == "P" for joint in schedule.joints])
    judge = Judge(TreeKinematics(schedule, given), schedule.task, ~slides, float(schedule.tau))
    known = np.random.Generator(np.random.PCG64(3)).uniform(-1.0, 1.0, (20, 6)) * np.where(slides, unit, 1.0)
    known[:, 1] = -np.pi / 2
    poses = judge.kinematics.forward(known)
    elsewhere, count = NumpySolver(run(schedule), schedule, given).inverse(poses, np.zeros(known.shape))
    assert (count > 0).all()
    assert not (np.abs(elsewhere - known[:, None])[..., slides].max(axis=-1) < 1e-3 * unit).any(axis=1).all()
    assert judge.found(elsewhere, known, poses).all()


#: Made-up arms whose axes 2, 3 and 4 are parallel, and axis 6 to 2e-13: four links that move and hardly move the tool.
FOUR_BARS = {
    40: (
        [-1.3382930065712946, -2.9323310444987327, 2.3955104431548215, -1.5067795527363632, 2.6e-13, 2.979961246025891],
        [
            -1.3382930065714251,
            2.0645848003705844,
            -0.45503539693047373,
            -3.1227275482324006,
            2.4e-13,
            2.4495392367379063,
        ],
    ),
    47: (
        [0.12849518074179356, -3.109391834571499, 1.5757445073862293, -0.7402063333501905, 3.2e-13, 0.7277436909441077],
        [0.1284951807419065, -1.8975531432887653, -1.162641965863369, 1.4528566037192832, 2.4e-13, 0.06122853584150714],
    ),
}


@pytest.mark.parametrize(("number", "one_curve"), [(40, True), (47, False)])
def test_a_way_round_the_curve_is_found_and_none_to_another_curve(number: int, one_curve: bool) -> None:
    """The way may begin in the direction that leads away from its end. Four bars can have two curves."""
    robot = arm("three axes parallel, 2-4", number, seed=1)
    schedule = build_schedule(derive(robot))
    judge = Judge(
        TreeKinematics(schedule, parameters(robot)), schedule.task, np.ones(6, dtype=bool), float(schedule.tau)
    )
    start, end = FOUR_BARS[number]
    pose = judge.kinematics.forward(np.array([end]))
    assert float(judge.closures(np.array([[start]]), pose)[0, 0]) < PATH
    nearest_way = Tracer(judge.kinematics, schedule.task, PATH + 4 * judge.tau, judge.revolute)
    way = wrapped(np.array([end]) - np.array([start]), judge.revolute)
    assert not nearest_way.joined(np.array([start]), way, pose).any()
    assert joined(judge, start, end) == one_curve
    assert joined(judge, end, start) == one_curve


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
