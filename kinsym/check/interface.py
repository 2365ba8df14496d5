"""The laws of everything beside the solutions: branches and marks, windings, tables, defaults and refusals.

Branches and marks of the languages are held against each other, and branches against the exact walk; windings and the
nearest of them against a list of all that fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kinsym.algebra.tree import Sym
from kinsym.check.c_solver import CSolver
from kinsym.check.calls import LIMIT, NOT_A_POSE, PARAMETER, REFERENCE, WEIGHT, Calls, Marked, Nearest, calls_of
from kinsym.check.laws import malformed
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import wrapped
from kinsym.check.questions import Questions
from kinsym.check.solvers import Floats, as_float
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.check.windings import close, hold_windings, limits_of, table_limits

MARK_LAW = "solve gives the solutions with their branches and marks"
TABLE_LAW = "names of branches, limits and parameters are the table's"
DEFAULT_LAW = "what is left out has its default"
INPUT_LAW = "wrong parameters, references, limits and weights are refused"
SAME_MARKS_LAW = "same branches, free and border joints"

DEFAULT_POSES = 3
#: At one in so many poses next to singular ones a band ends between two languages' roundings.
MORE_MARKS = 24
#: At one in so many poses, where two singularities are near, settling may move a free joint far from its reference.
MORE_MOVED = 24


def hold_interface(
    ledger: Ledger, target: NumpySolver | CSolver, questions: Questions, rng: np.random.Generator
) -> list[Any]:
    """Every law on one language; returns what it says of each pose, for :func:`hold_same_marks`."""
    calls = calls_of(target)
    found = [calls.solve(pose, q) for pose, q in zip(questions.poses, questions.q, strict=True)]
    answers = target.inverse(questions.poses, questions.q)
    rows = zip(found, *answers, questions.poses, strict=True)
    wrong = sum(not _fits(marked, q[:count], pose, questions) for marked, q, count, pose in rows)
    moved = sum(not _chosen(marked, reference, questions) for marked, reference in zip(found, questions.q, strict=True))
    ledger.count(MARK_LAW, target.name, len(found), wrong + max(0, moved - 1 - len(found) // MORE_MOVED))
    limits = limits_of(questions, rng)
    hold_windings(ledger, target, questions, limits=limits, rng=rng)
    ledger.count(TABLE_LAW, target.name, 1, int(not _tables_hold(calls.tables(), questions)))
    _hold_defaults(ledger, target, calls, questions)
    _hold_refusals(ledger, target, calls, questions, limits[0])
    return found


def hold_same_marks(ledger: Ledger, subject: str, left: Sequence[Any], right: Sequence[Any], plain: Any) -> None:
    """Two languages say the same of every ordinary pose, and of the others but for a few at the ends of a band."""
    other = np.array([not _same(a, b) for a, b in zip(left, right, strict=True)])
    odd = int((other & ~plain).sum())
    failed = int((other & plain).sum()) + max(0, odd - 1 - int((~plain).sum()) // MORE_MARKS)
    ledger.count(SAME_MARKS_LAW, subject, len(other), failed, limit=f"but for 1 in {MORE_MARKS}")


def _same(left: Any, right: Any) -> bool:
    if not (isinstance(left, Marked) and isinstance(right, Marked)):
        return type(left) is type(right)
    return left.status == right.status and all(np.array_equal(a, b) for a, b in zip(left[1:5], right[1:5], strict=True))


def _fits(marked: Any, q: Floats, pose: Floats, questions: Questions) -> bool:
    """Whether marked solutions are those of ik in rising branches; of a general solver, which tells a double root
    by half the digits, a way on the pose may lead from the one to the other."""
    if not isinstance(marked, Marked) or marked.q.shape != q.shape:
        return False
    same = (np.abs(wrapped(marked.q - q, questions.judge.revolute)) <= questions.fine.same).all(axis=-1)
    if questions.schedule.general and not same.all():
        same |= questions.judge.joined(marked.q[None], q[None], pose[None])[0]
    rising = bool((np.diff(marked.branch) > 0).all()) if len(q) else True
    inside = bool(((marked.branch >= 0) & (marked.branch < questions.schedule.maximum)).all())
    special = bool(marked.free.any() or marked.border.any())
    status = "unreachable" if not len(q) else "singular" if special else "solved"
    free = bool((marked.family | ~marked.free).all())
    return bool(same.all()) and rising and inside and free and marked.status == status


def _chosen(marked: Any, reference: Floats, questions: Questions) -> bool:
    """Whether free joints are where the reference has them; of several that are free the sum is, not each of them."""
    if not isinstance(marked, Marked):
        return True
    alone = marked.free & (marked.free.sum(axis=1, keepdims=True) == 1)
    moved = np.abs(wrapped(marked.q - reference, questions.judge.revolute))[alone]
    return bool((moved <= questions.fine.chosen).all())


def _tables_hold(tables: Mapping[str, Any], questions: Questions) -> bool:
    schedule = questions.schedule
    values = {item.name: None if item.value is None else as_float(item.value) for item in schedule.parameters}
    return (
        (not schedule.branches or tables["branches"] == tuple(schedule.branches))
        and np.array_equal(tables["limits"], table_limits(questions))
        and tables.get("parameters", values) == values
    )


def _hold_defaults(ledger: Ledger, target: NumpySolver | CSolver, calls: Calls, questions: Questions) -> None:
    """Parameters that are left out are the table's; no reference is one of zeros, unless an input comes from it."""
    schedule, q, same = questions.schedule, questions.q[:DEFAULT_POSES], questions.fine.same
    values = {item.name: item.value for item in schedule.parameters if item.value is not None}
    told = target.defaults(q)
    if len(values) < len(schedule.parameters):
        missed = told is not None
    else:
        kinematics = TreeKinematics(schedule, values)
        wanted = (kinematics.forward(q), kinematics.jacobian(q)[..., kinematics.free])
        missed = told is None or not (
            close(told[0], wanted[0], same) and close(told[1][..., kinematics.free], wanted[1], same)
        )
    numbers = {name: as_float(value) for name, value in values.items()}
    spared = calls.spared(questions.poses[0], q[0], numbers) if numbers else {}
    wrong = int(missed) + sum(not alike for alike in spared.values())
    ledger.count(DEFAULT_LAW, target.name, 1 + len(spared), wrong)
    if questions.schedule.inputs:
        return
    zeros = np.zeros(questions.q.shape[1])
    rows = [*questions.ordinary[:2], *np.flatnonzero(~questions.plain)[:6]]
    wrong = 0
    for row in rows:
        left, right = calls.solve(questions.poses[row], None), calls.solve(questions.poses[row], zeros)
        plain = target.plain(questions.poses[row])
        if not (_same(left, right) and isinstance(left, Marked) and np.array_equal(left.q, right.q)):
            wrong += 1
            continue
        if isinstance(target, CSolver):
            near = [calls.nearest(questions.poses[row], each, None, None) for each in (None, zeros)]
            found = [each.q if isinstance(each, Nearest) else each for each in near]
            wrong += not (found[0] is found[1] or np.array_equal(found[0], found[1]))
        same = plain.shape == left.q.shape
        wrong += not (same and (np.abs(wrapped(plain - left.q, questions.judge.revolute)) <= questions.fine.same).all())
    ledger.count(DEFAULT_LAW, target.name, len(rows), wrong)


def _hold_refusals(
    ledger: Ledger, target: NumpySolver | CSolver, calls: Calls, questions: Questions, limits: Any
) -> None:
    """Each thing that is wrong is named, and nothing else is."""
    row = questions.ordinary[0]
    pose, q, schedule = questions.poses[row], questions.q[row], questions.schedule
    weights = np.ones(len(q))
    said: list[tuple[Any, str]] = []
    for value in (np.nan, np.inf):
        for place in questions.places:
            if schedule.joints[place].name not in schedule.inputs:
                near = _with(q, place, value)
                said += [(calls.solve(pose, near), REFERENCE), (calls.within(pose, near, None), REFERENCE)]
            said.append((calls.nearest(pose, q, _with(weights, place, value), None), WEIGHT))
    for place in questions.places:
        said.append((calls.nearest(pose, q, _with(weights, place, -1e-9), None), WEIGHT))
        for ends in ((1.0, 0.5), (np.nan, 1.0), (0.0, np.nan), (np.inf, np.inf), (-np.inf, -np.inf)):
            broken = _with(limits, place, ends)
            said += [(calls.within(pose, q, broken), LIMIT), (calls.nearest(pose, q, None, broken), LIMIT)]
    names = [item.name for item in schedule.parameters]
    no_numbers = [(name, value) for name in (*names, *schedule.inputs) for value in (np.nan, np.inf)]
    nonzero = {item.value.name for item in schedule.nonzero if isinstance(item.value, Sym)}
    vanishing = [(name, 0.0) for name in names if name in nonzero]
    for name, value in [*no_numbers, *vanishing]:
        told = calls.refusing(pose, q, {name: value})
        if name in names and value:
            told |= calls.refusing_forward(q, {name: value})
        said += [(PARAMETER if refused else "", PARAMETER) for refused in told.values()]
    for case in malformed(pose).values():
        said += [
            (calls.solve(case, q), NOT_A_POSE),
            (calls.within(case, q, None), NOT_A_POSE),
            (calls.nearest(case, q, None, None), NOT_A_POSE),
        ]
    wrong = [expected for answer, expected in said if not (isinstance(answer, str) and answer == expected)]
    note = f"not told: {', '.join(sorted(set(wrong)))}" if wrong else ""
    ledger.count(INPUT_LAW, target.name, len(said), len(wrong), note=note)


def _with(values: Floats, place: int, value: Any) -> Floats:
    changed = np.array(values, dtype=np.float64)
    changed[place] = value
    return changed
