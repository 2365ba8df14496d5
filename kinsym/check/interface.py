"""The laws of everything beside the solutions: branches and marks, windings, tables, defaults and refusals.

Branches and marks of the languages are held against each other, and branches against the exact walk; windings and the
nearest of them against a list of all that fit.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kinsym.algebra.tree import Sym
from kinsym.check.calls import LIMIT, NOT_A_POSE, PARAMETER, REFERENCE, WEIGHT, Calls, Marked, calls_of
from kinsym.check.control import WORSE
from kinsym.check.laws import SAME, Judge, malformed
from kinsym.check.ledger import Ledger
from kinsym.check.poses import wrapped
from kinsym.check.solvers import CSolver, Floats, NumpySolver, TreeKinematics, as_float
from kinsym.emit.schedule import Schedule

MARK_LAW = "solve gives the solutions with their branches and marks"
WITHIN_LAW = "within gives every winding inside the limits"
INSIDE_LAW = "nearest is the best of them"
TABLE_LAW = "names of branches, limits and parameters are the table's"
DEFAULT_LAW = "what is left out has its default"
INPUT_LAW = "wrong parameters, references, limits and weights are refused"
SAME_MARKS_LAW = "same branches, free and border joints"

WINDING_POSES, SLOW_POSES = 6, 1
DEFAULT_POSES = 3
#: Joint vectors so near to a limit are left out of the comparison.
EDGE = 1e-9
#: At one in so many poses next to singular ones a band ends between two languages' roundings.
MORE_MARKS = 100
#: How far the settling of a solution may move a free joint from its reference; at one in so many poses, where two
#: singularities are near, it may move it further.
CHOSEN = 1e-4
MORE_MOVED = 24


@dataclass(frozen=True, kw_only=True)
class Fineness:
    """A type of numbers, and how finely it tells joint values, costs and limits apart: as the constants say."""

    real: type[np.floating[Any]] = np.float64
    same: float = SAME
    worse: float = WORSE
    edge: float = EDGE
    chosen: float = CHOSEN


@dataclass(frozen=True, kw_only=True)
class Questions:
    """The poses (m, 4, 4) of joint vectors q (m, n) that these laws are tried on, and which are ordinary (m,)."""

    schedule: Schedule
    judge: Judge
    poses: Floats
    q: Floats
    plain: Any
    fine: Fineness = Fineness()

    @property
    def winding(self) -> Any:
        """The joints that whole turns are added to."""
        return self.judge.revolute & self.judge.kinematics.free

    @property
    def ordinary(self) -> Any:
        """The rows of the first ordinary poses; a general solver takes long for each."""
        return np.flatnonzero(self.plain)[: SLOW_POSES if self.schedule.general else WINDING_POSES]

    @property
    def places(self) -> range:
        """The joints of which a value is made wrong."""
        return range(1 if self.schedule.general else self.q.shape[1])


def hold_interface(
    ledger: Ledger, target: NumpySolver | CSolver, questions: Questions, rng: np.random.Generator
) -> list[Any]:
    """Every law on one language; returns what it says of each pose, for :func:`hold_same_marks`."""
    calls = calls_of(target)
    found = [calls.solve(pose, q) for pose, q in zip(questions.poses, questions.q, strict=True)]
    answers = target.inverse(questions.poses, questions.q)
    wrong = sum(not _fits(marked, q[:count], questions) for marked, q, count in zip(found, *answers, strict=True))
    moved = sum(not _chosen(marked, reference, questions) for marked, reference in zip(found, questions.q, strict=True))
    ledger.count(MARK_LAW, target.name, len(found), wrong + max(0, moved - 1 - len(found) // MORE_MOVED))
    limits = _limits(questions, rng)
    _hold_windings(ledger, target, questions, limits=limits, rng=rng)
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


def _fits(marked: Any, q: Floats, questions: Questions) -> bool:
    """Whether marked solutions are those of ik in rising branches."""
    if not isinstance(marked, Marked) or marked.q.shape != q.shape:
        return False
    gaps = np.abs(wrapped(marked.q - q, questions.judge.revolute))
    rising = bool((np.diff(marked.branch) > 0).all()) if len(q) else True
    inside = bool(((marked.branch >= 0) & (marked.branch < questions.schedule.maximum)).all())
    special = bool(marked.free.any() or marked.border.any())
    status = "unreachable" if not len(q) else "singular" if special else "solved"
    free = bool((marked.family | ~marked.free).all())
    return bool((gaps <= questions.fine.same).all()) and rising and inside and free and marked.status == status


def _chosen(marked: Any, reference: Floats, questions: Questions) -> bool:
    """Whether free joints are where the reference has them; of several that are free the sum is, not each of them."""
    if not isinstance(marked, Marked):
        return True
    alone = marked.free & (marked.free.sum(axis=1, keepdims=True) == 1)
    moved = np.abs(wrapped(marked.q - reference, questions.judge.revolute))[alone]
    return bool((moved <= questions.fine.chosen).all())


def _limits(questions: Questions, rng: np.random.Generator) -> list[Floats | None]:
    """Limits (n, 2): narrow ones, wide ones of which one joint's are infinite, and those of the table."""
    n = questions.q.shape[1]
    unit = np.where(questions.judge.revolute, np.pi, max(questions.judge.kinematics.size, 1.0))
    middle = rng.uniform(-0.4, 0.4, n) * unit
    narrow = np.stack([middle - 0.8 * unit, middle + 0.8 * unit], axis=1)
    wide = np.stack([middle - 1.3 * unit, middle + 1.1 * unit], axis=1)
    wide[rng.integers(n)] = (-np.inf, np.inf)
    one_end = np.stack([middle - 0.9 * unit, np.full(n, np.inf)], axis=1)
    return [*(_rounded(limits, questions) for limits in (narrow, wide, one_end)), None]


def _hold_windings(
    ledger: Ledger, target: NumpySolver | CSolver, questions: Questions, *, limits: Sequence[Any], rng: Any
) -> None:
    calls, winding, fine = calls_of(target), questions.winding, questions.fine
    tried = wrong = missed = 0
    for row, limit in itertools.product(questions.ordinary, limits):
        pose, reference = questions.poses[row], questions.q[row]
        marked = calls.solve(pose, reference)
        every = marked.q if isinstance(marked, Marked) else np.empty((0, len(reference)))
        ends = _table_limits(questions) if limit is None else limit
        wound = _windings(every, ends, winding, fine.edge)
        if wound is None:
            continue
        tried += 1
        found = calls.within(pose, reference, limit)
        wrong += not (isinstance(found, np.ndarray) and found.shape == wound.shape and _close(found, wound, fine.same))
        near = reference + np.where(questions.judge.kinematics.free, rng.normal(0.0, 2.0, len(reference)), 0.0)
        for weights in (None, rng.uniform(0.1, 2.0, len(reference))):
            answer = calls.nearest(pose, near, weights, limit)
            scale = np.ones(len(near)) if weights is None else weights
            best = min((_least(q, near, ends, scale, winding) for q in every), default=np.inf)
            missed += not _is_nearest(answer, best, near, scale, ends, worse=fine.worse)
            missed += not _among(answer, every, winding, fine.same)
    ledger.count(WITHIN_LAW, target.name, tried, wrong)
    ledger.count(INSIDE_LAW, target.name, 2 * tried, missed)


def _close(left: Floats, right: Floats, same: float) -> bool:
    return bool((np.abs(left - right) <= same * np.maximum(1.0, np.abs(right))).all())


def _windings(every: Floats, limits: Floats, revolute: Any, edge: float) -> Floats | None:
    """All joint vectors (w, n) inside limits (n, 2), turns of the first joint outermost; None if one is on an edge."""
    wound = []
    for q in every:
        places = [_turned(*values, edge) for values in zip(q, limits, revolute, strict=True)]
        if any(place is None for place in places):
            return None
        wound += list(itertools.product(*places))  # type: ignore[arg-type]
    return np.array(wound, dtype=np.float64).reshape(-1, every.shape[1])


def _turned(x: float, ends: Floats, revolute: bool, edge: float) -> list[float] | None:
    low, high = ends
    turns = range(-3, 4) if revolute and np.isfinite(ends).all() else range(1)
    values = [x + 2 * np.pi * turn for turn in turns]
    if any(abs(value - end) <= edge * max(1.0, abs(end)) for value in values for end in ends if np.isfinite(end)):
        return None
    return [value for value in values if low <= value <= high]


def _least(q: Floats, near: Floats, limits: Floats, weights: Floats, winding: Any) -> float:
    """What the nearest winding of one solution costs; infinite if none is inside."""
    total = 0.0
    for x, (low, high), wanted, weight, turns in zip(q, limits, near, weights, winding, strict=True):
        values = x + 2 * np.pi * np.arange(-6, 7) if turns else np.array([x])
        inside = values[(values >= low) & (values <= high)]
        total += weight * float(((inside - wanted) ** 2).min(initial=np.inf))
    return total


def _is_nearest(answer: Any, best: float, near: Floats, weights: Floats, limits: Floats, *, worse: float) -> bool:
    """Whether an answer is inside the limits and costs what the best costs; None where nothing is inside."""
    if not isinstance(answer, np.ndarray) or not np.isfinite(best):
        return answer is None and not np.isfinite(best)
    inside = ((answer >= limits[:, 0]) & (answer <= limits[:, 1])).all()
    cost = float((weights * (answer - near) ** 2).sum())
    return bool(inside) and abs(cost - best) <= worse * max(1.0, best)


def _among(answer: Any, every: Floats, winding: Any, same: float) -> bool:
    """Whether an answer is a solution up to whole turns; none is no wrong one."""
    if answer is None:
        return True
    gaps = np.abs(wrapped(every - answer, winding)) / np.maximum(1.0, np.abs(answer))
    return bool(gaps.max(axis=1).min(initial=np.inf) <= same)


def _table_limits(questions: Questions) -> Floats:
    limits = [joint.limits for joint in questions.schedule.joints]
    every = [(-np.inf, np.inf) if ends is None else tuple(map(as_float, ends)) for ends in limits]
    return _rounded(np.array(every), questions)


def _rounded(values: Floats, questions: Questions) -> Floats:
    """Numbers as their type holds them."""
    return values.astype(questions.fine.real).astype(np.float64)


def _tables_hold(tables: Mapping[str, Any], questions: Questions) -> bool:
    schedule = questions.schedule
    values = {item.name: None if item.value is None else as_float(item.value) for item in schedule.parameters}
    return (
        (not schedule.branches or tables["branches"] == tuple(schedule.branches))
        and np.array_equal(tables["limits"], _table_limits(questions))
        and tables.get("parameters", values) == values
    )


def _hold_defaults(ledger: Ledger, target: NumpySolver | CSolver, calls: Calls, questions: Questions) -> None:
    """Parameters are the table's; no reference is a reference of zeros, where no input has to come from it."""
    schedule, q, same = questions.schedule, questions.q[:DEFAULT_POSES], questions.fine.same
    values = {item.name: item.value for item in schedule.parameters if item.value is not None}
    told = target.defaults(q)
    if len(values) < len(schedule.parameters):
        missed = told is not None
    else:
        kinematics = TreeKinematics(schedule, values)
        wanted = (kinematics.forward(q), kinematics.jacobian(q)[..., kinematics.free])
        missed = told is None or not (
            _close(told[0], wanted[0], same) and _close(told[1][..., kinematics.free], wanted[1], same)
        )
    ledger.count(DEFAULT_LAW, target.name, 1, int(missed))
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
            wrong += not (near[0] is near[1] or np.array_equal(near[0], near[1]))
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
    wrong_ones = [(name, value) for name in names for value in (np.nan, np.inf)]
    nonzero = {item.value.name for item in schedule.nonzero if isinstance(item.value, Sym)}
    vanishing = [(name, 0.0) for name in names if name in nonzero]
    for name, value in [*wrong_ones, *vanishing]:
        told = calls.refusing(pose, q, {name: value})
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
