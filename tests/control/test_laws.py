"""The laws of the control functions fail where one of them is wrong."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.control import NEAREST_LAW, STATUS_AGREE_LAW, STATUS_LAW, hold_nearest, hold_status
from kinsym.check.laws import Judge
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.emit.program import build_schedule
from tests.arms import derivation, numpy_module
from tests.emit.built import CLibrary, needs_compiler

SCHEDULE = build_schedule(derivation("ur5"))
PARAMETERS = {item.name: item.value or Fraction(1) for item in SCHEDULE.parameters}
Q = np.random.default_rng(5).uniform(-3.0, 3.0, (30, 6))


def numpy_solver() -> NumpySolver:
    """A solver on the generated module."""
    return NumpySolver(numpy_module("ur5"), SCHEDULE, PARAMETERS)


def nearest_failures(solver: Any) -> int:
    """How many of the nearest solutions of a solver the law finds wrong."""
    ledger, rng = Ledger(), np.random.default_rng(1)
    judge = Judge(TreeKinematics(SCHEDULE, PARAMETERS), SCHEDULE.task, np.ones(6, dtype=bool), float(SCHEDULE.tau))
    hold_nearest(ledger, solver, judge, poses=solver.forward(Q), q=Q, rng=rng)
    (check,) = ledger.checks()
    assert (check.law, check.tried) == (NEAREST_LAW, len(Q))
    return check.failed


def status_failures(*solvers: Any) -> dict[str, int]:
    """How many statuses are wrong, by law; all poses count as ordinary ones."""
    ledger, poses = Ledger(), numpy_solver().forward(Q)
    answers = {solver.name: solver.inverse(poses, Q) for solver in solvers}
    everywhere, which = np.ones(len(Q), dtype=bool), np.arange(len(Q))
    hold_status(
        ledger, solvers, answers, poses=poses, q=Q, size=1.0, uniform=everywhere, which=which, singular=which[:0]
    )
    return {check.law: check.failed for check in ledger.checks()}


@needs_compiler
def test_what_is_generated_passes() -> None:
    c = CSolver(CLibrary(SCHEDULE).library, SCHEDULE, PARAMETERS)
    assert nearest_failures(numpy_solver()) == nearest_failures(c) == 0
    found = status_failures(numpy_solver(), c)
    assert found[STATUS_LAW] == found[STATUS_AGREE_LAW] == 0


@pytest.mark.parametrize(
    "wrong",
    [
        lambda q, reference: q + 2 * np.pi * np.eye(6)[2],
        lambda q, reference: q + 1e-6,
        lambda q, reference: None,
    ],
)
def test_a_wrong_nearest_solution_is_seen(wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wound too far, off by a little, not found."""
    solver = numpy_solver()
    right = solver.nearest
    monkeypatch.setattr(solver, "nearest", lambda T, reference, w: wrong(right(T, reference, w), reference))
    assert nearest_failures(solver) == len(Q)


def test_the_second_best_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first solution instead of the nearest one."""
    solver = numpy_solver()
    monkeypatch.setattr(solver, "nearest", lambda T, reference, w: solver.single(T, reference)[0])
    assert nearest_failures(solver) > len(Q) // 2


@needs_compiler
def test_a_wrong_status_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    solver, c = numpy_solver(), CSolver(CLibrary(SCHEDULE).library, SCHEDULE, PARAMETERS)
    monkeypatch.setattr(solver, "status", lambda T, reference: "unreachable")
    found = status_failures(solver, c)
    assert found[STATUS_AGREE_LAW] == len(Q)
    assert status_failures(solver)[STATUS_LAW] > len(Q)
