"""Marked solutions of the exact walk: what a border hides, what a doubt turns out to be, and the same sets as the C."""

from __future__ import annotations

import ctypes
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import compile_shared
from kinsym.check.evaluate import exact
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.laws import CLOSURE, PATH, Judge
from kinsym.check.marks import Mark
from kinsym.check.poses import Counts, generator, samples
from kinsym.check.settle import ALIKE, MOVED, Goal, Settler, Solution
from kinsym.check.singular import volume_of
from kinsym.check.task import sifted, task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.check.walk import ExactWalk
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests import arms
from tests.check import hand
from tests.emit.built import needs_compiler

CTX, NUMBERS = exact()
REACH = 4 * CTX.mpf(2) ** -46
COUNTS = Counts(uniform=2, quarter=6, singular=16, pair=16)


@cache
def _walk(l1: Fraction = Fraction(3, 5), l2: Fraction = Fraction(2, 5)) -> ExactWalk:
    return ExactWalk(hand.schedule(), {"l1": l1, "l2": l2})


def _pose(walk: ExactWalk, q: list[Any]) -> list[list[Any]]:
    return [*walk.forward(q), [0, 0, 0, 1]]


@cache
def _settler() -> Settler:
    walk, schedule = _walk(), hand.schedule()
    return Settler(
        CTX,
        joints=schedule.joints,
        task=schedule.task,
        forward=walk.forward,
        jacobian=walk.jacobian,
        wrap=NUMBERS.functions["wrap"],
    )


def _settled(start: list[Any], mark: Mark, target: list[Any]) -> list[Solution]:
    goal = Goal(_walk().forward(target), _walk().size, REACH)
    alike = ALIKE if Mark.DOUBTFUL in mark else 0
    return _settler().settle(Solution(0, [CTX.mpf(value) for value in start], alike), 1, mark, goal)


@pytest.mark.parametrize("bend", ["1e-7", "1e-5", "-1e-6"])
def test_a_border_beside_the_pose_hides_two_solutions(bend: str) -> None:
    """The stretched arm next to a slightly bent one: both elbows are found, the mirror image as the second."""
    target = [CTX.mpf("0.4"), CTX.mpf(bend)]
    first, second = _settled(["0.4", 0], Mark.BORDER, target)
    assert abs(first.q[1] + second.q[1]) < 1e-20
    assert min(abs(item.q[1] - target[1]) for item in (first, second)) < 1e-20
    assert (first.branch, second.branch) == (0, 1)
    assert (first.alike, second.alike) == (MOVED, ALIKE)


def test_only_a_border_has_a_twin() -> None:
    target = [CTX.mpf("0.4"), CTX.mpf("1e-5")]
    assert len(_settled(["0.4", "2e-5"], Mark.SOFT, target)) == 1


def test_what_is_on_the_pose_stays_as_it_is() -> None:
    """A vector within four tau is neither moved nor given a twin."""
    start = ["0.4", "1e-8"]  # 1e-17 of the reach away from the stretched arm
    (found,) = _settled(start, Mark.BORDER, [CTX.mpf("0.4") + CTX.mpf("0.4e-8"), 0])
    assert found.q == [CTX.mpf(value) for value in start]


def test_a_doubt_beyond_the_reach_is_no_solution() -> None:
    """A root in doubt is held to 1e-12, one that exists to 1e-9."""
    start = [CTX.mpf(value) for value in ("0.4", 0)]
    for outside, doubtful, sure in (("1e-4", 0, 0), ("1e-11", 0, 1), ("1e-15", 1, 1)):
        rows = _walk().forward(start)
        for axis in range(2):
            rows[axis][3] *= 1 + CTX.mpf(outside)
        goal = Goal(rows, _walk().size, REACH)
        given = Solution(0, start, ALIKE)
        assert len(_settler().settle(given, 1, Mark.SOFT | Mark.DOUBTFUL, goal)) == doubtful
        assert len(_settler().settle(given, 1, Mark.SOFT, goal)) == sure


def test_angles_that_were_moved_are_in_range() -> None:
    """A start at pi that is moved over it comes back at -pi."""
    (found,) = _settled([CTX.pi, "1.0"], Mark.SOFT, [CTX.pi + CTX.mpf("1e-6"), CTX.mpf(1)])
    assert abs(found.q[0] + CTX.pi - CTX.mpf("1e-6")) < 1e-20


def test_copies_go_only_where_there_was_a_doubt() -> None:
    """The sure one of two alike stays, of two in doubt the first; whole turns and 1e-4 make no difference."""
    at, beside, away = ([CTX.mpf(a), CTX.mpf(b)] for a, b in (("3.1415", 1), ("-3.1416", "1.0001"), ("3.1415", "1.01")))

    def kept(*found: Solution) -> list[int]:
        return [item.branch for item in _settler().without_copies(found, CTX.mpf(1))]

    assert kept(Solution(0, at, ALIKE), Solution(1, beside)) == [1]
    assert kept(Solution(0, at), Solution(1, beside, ALIKE)) == [0]
    assert kept(Solution(0, at, ALIKE), Solution(1, beside, ALIKE)) == [0]
    assert kept(Solution(0, at), Solution(1, beside)) == [0, 1]
    assert kept(Solution(0, at, ALIKE), Solution(1, away, ALIKE)) == [0, 1]
    assert kept(Solution(0, at, MOVED), Solution(1, beside)) == [0, 1]
    assert kept(Solution(0, at, MOVED), Solution(1, at)) == [1]


@pytest.mark.parametrize("bend", ["1e-9", "1e-7", "3e-7", "4e-7", "1e-5", "1e-3", "0.5"])
def test_walk_finds_both_elbows_of_an_arm_that_is_almost_stretched(bend: str) -> None:
    """One while the stretched arm is within the tolerance of the pose, then two, in the order of the branches."""
    found = _walk().inverse(_pose(_walk(), ["0.4", bend])) or []
    assert len(found) == (1 if CTX.mpf(bend) < 3.5e-7 else 2)
    assert [bool(q[1] > 0) for q in found[: len(found) // 2]] == [True] * (len(found) // 2)


def test_walk_answers_a_point_just_out_of_reach_only_within_the_tolerance() -> None:
    for outside, count in (("1e-15", 1), ("1e-11", 0), ("1e-7", 0)):
        pose = _pose(_walk(), ["0.4", 0])
        for axis in range(2):
            pose[axis][3] *= 1 + CTX.mpf(outside)
        assert len(_walk().inverse(pose) or []) == count


def _near_singular(name: str) -> tuple[Any, ...]:
    """Poses next to singular ones, what the walk and the C answer, and the judge."""
    schedule = build_schedule(arms.derivation(name))
    parameters = {p.name: p.value if p.value is not None else Fraction(3, 10) for p in schedule.parameters}
    kinematics = TreeKinematics(schedule, parameters)

    def volume(q: Any) -> Any:
        slope = task_jacobian(kinematics.jacobian(q), kinematics.forward(q), schedule.task, kinematics.size)
        return volume_of(slope)

    drawn = samples(schedule.joints, volume, kinematics.size, COUNTS, generator(schedule.digest, 1))
    revolute = np.array([joint.kind == "R" for joint in schedule.joints])
    path = CLOSURE if sifted(schedule) else PATH
    judge = Judge(kinematics, schedule.task, revolute, float(schedule.tau), path)
    return schedule, parameters, judge, drawn.q, ExactSolver(schedule, parameters)


@needs_compiler
@pytest.mark.parametrize(
    ("name", "unlike"),
    # At one pose of the skew wrist theta4 was free on a border, and moves by 0.1 change the pose by 1e-12: each stops
    # elsewhere in this valley.
    [("elbow_6r_screw", 0), ("ur5", 0), ("puma560", 0), ("stanford_paul", 0), ("skew_wrist", 1)],
)
def test_walk_and_c_answer_the_same_next_to_singular_poses(name: str, unlike: int, tmp_path: Path) -> None:
    """Each solution of the one is joined to one of the other; no pose is lost, every answer reaches it."""
    schedule, parameters, judge, q, solver = _near_singular(name)
    for file, text in TARGETS["c"](schedule).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    library = ctypes.CDLL(str(compile_shared(tmp_path, schedule.name, tmp_path)))
    poses = solver.forward(q)
    reference = q + 0.3
    found, count = solver.inverse(poses, reference)
    closures = judge.closures(found, poses)
    assert (count > 0).all()
    assert (closures[np.isfinite(closures)] < CLOSURE).all()
    assert judge.found(found, q, poses).all()
    _, sets = judge.agreement((found, count), CSolver(library, schedule, parameters).inverse(poses, reference), poses)
    assert (~sets).sum() <= unlike, q[~sets]
