"""Arms with seven joints of which one is locked: the six that are left have no closed form."""

from __future__ import annotations

import ctypes
from functools import cache
from types import ModuleType

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.deadline import Deadline
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.calibrate import calibrated
from kinsym.emit.latex.document import document
from kinsym.emit.program import build_schedule
from kinsym.emit.text.equations import equations
from kinsym.errors import DeadlineExceeded, NoClosedForm
from kinsym.general.select import general_plan
from kinsym.robot import from_inline, lock
from kinsym.robot.model import Task
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import misses, run

LOCKS = {"input": {"theta3": None}, "value": {"theta3": "3/10"}, "slide": {"d1": None}}


def table(kind: str) -> str:
    """Seven random rows; the first joint slides where it is the one to be locked."""
    rng = np.random.Generator(np.random.PCG64(5))
    rows = []
    for number in range(1, 8):
        alpha, a, d, theta = (round(float(x), 3) for x in rng.uniform((-3, 0.05, -0.5, -3), (3, 0.5, 0.5, 3)))
        slides = kind == "slide" and number == 1
        rows.append(f"{alpha} {a} d1 {theta}" if slides else f"{alpha} {a} {d} theta{number}")
    return "; ".join(rows)


@cache
def locked(kind: str) -> Derivation:
    """The derivation with the lock of that kind."""
    return derive(lock(from_inline(table(kind), convention="paul", name="seven"), LOCKS[kind]))


@cache
def module(kind: str) -> ModuleType:
    """Its generated module."""
    return run(build_schedule(locked(kind)))


def place(kind: str) -> int:
    """Where the locked joint stands in a joint vector."""
    return 0 if kind == "slide" else 2


def joint_vectors(kind: str, count: int) -> np.ndarray:
    """Random joint vectors; the locked joint has one of three values, or the one at which it is held."""
    rng = np.random.Generator(np.random.PCG64(8))
    q = rng.uniform(-np.pi, np.pi, (count, 7))
    q[:, place(kind)] = 0.3 if kind == "value" else np.array([0.3, -0.7, 0.1])[np.arange(count) % 3]
    return q


def given(kind: str, q: np.ndarray) -> dict[str, np.ndarray]:
    """The locked joint as the caller gives it."""
    return {} if kind == "value" else {next(iter(LOCKS[kind])): q[..., place(kind)]}


@pytest.mark.parametrize("kind", LOCKS)
def test_whole_joint_vectors_with_the_value_exactly_as_given(kind: str) -> None:
    assert locked(kind).plan is None
    arm, q = module(kind), joint_vectors(kind, 30)
    poses = arm.fk(q)
    solutions, valid = arm.ik_batch(poses, **given(kind, q))
    assert solutions.shape == (30, 16, 7)
    gap = np.abs(np.angle(np.exp(1j * (solutions - q[:, None]))))
    assert np.where(valid, gap.max(axis=-1), np.inf).min(axis=1).max() < 1e-9
    held = np.broadcast_to(q[:, None, place(kind)], valid.shape)
    assert (solutions[..., place(kind)][valid] == held[valid]).all()
    assert misses(arm, poses, solutions, valid).max() < 1e-12
    assert np.isnan(solutions[~valid]).all()


@pytest.mark.parametrize("kind", ["input", "slide"])
def test_a_sweep_is_as_many_calls(kind: str) -> None:
    arm, q = module(kind), joint_vectors(kind, 3)
    pose = arm.fk(q[0])
    ((name, values),) = given(kind, q).items()
    solutions, valid = arm.ik_sweep(pose, **{name: values})
    for value, found, real in zip(values, solutions, valid, strict=True):
        assert np.allclose(found[real], arm.ik(pose, **{name: value}), rtol=0, atol=1e-12)


def test_a_locked_value_that_is_no_number_is_refused() -> None:
    with pytest.raises(ValueError, match="theta3 must be finite"):
        module("input").ik(np.eye(4), theta3=np.nan)


@pytest.mark.parametrize("kind", ["input", "value"])
def test_the_oracle_finds_the_same(kind: str) -> None:
    arm, q = module(kind), joint_vectors(kind, 3)
    poses = arm.fk(q)
    exact, count = ExactSolver(build_schedule(locked(kind)), {}).inverse(poses, q)
    solutions, valid = arm.ik_batch(poses, **given(kind, q))
    assert (count == valid.sum(axis=1)).all()
    assert np.allclose(exact, solutions, rtol=0, atol=1e-9, equal_nan=True)


@needs_compiler
@pytest.mark.parametrize("kind", LOCKS)
def test_the_c_finds_the_same(kind: str) -> None:
    schedule, arm, q = build_schedule(locked(kind)), module(kind), joint_vectors(kind, 12)
    poses = arm.fk(q)
    found, count = CSolver(CLibrary(schedule).library, schedule, {}).inverse(poses, q)
    solutions, valid = arm.ik_batch(poses, **given(kind, q))
    assert (count == valid.sum(axis=1)).all()
    assert np.allclose(found, solutions, rtol=0, atol=1e-9, equal_nan=True)


@needs_compiler
def test_marks_are_numbers_in_the_order() -> None:
    schedule, arm = build_schedule(locked("value")), module("value")
    library = CLibrary(schedule).library
    pose = np.ascontiguousarray(arm.fk(joint_vectors("value", 1)[0]))
    q, marks = np.empty((16, 7)), np.full((16, 3), 9, dtype=np.uint32)
    arguments = (pose.ctypes.data, None, None, q.ctypes.data, marks.ctypes.data)
    count = library.seven_ik_marked(*map(ctypes.c_void_p, arguments))
    assert count == len(arm.ik(pose)) > 1
    assert marks[:count].tolist() == [[branch, 0, 0] for branch in range(count)]


def test_the_page_says_what_is_given() -> None:
    text = equations(locked("input"))
    assert "theta3 is given, an input of the inverse kinematics\n  c3 = cos(theta3)" in text
    assert "The joints are counted without theta3" in text
    assert r"The joints are counted without $\theta_{3}$" in document(locked("input"))


def test_an_arm_with_a_joint_to_spare_is_told_how_to_lock_it() -> None:
    with pytest.raises(NoClosedForm, match=r"six joints can be solved without one. Add for example --lock theta4$"):
        derive(from_inline(table("input"), convention="paul", name="seven"))


def test_the_deadline_ends_the_choice_of_cuts() -> None:
    over = Deadline(1e-9)
    with pytest.raises(DeadlineExceeded, match="the ways round the loop are looked at"):
        general_plan(locked("input").solved, Task.POSE, "why", over)
    with pytest.raises(DeadlineExceeded, match="the ways round the loop are compared"):
        calibrated(build_schedule(locked("input")), over)
