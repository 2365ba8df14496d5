"""The laws of joint vectors inside limits: every winding of every solution that fits, and the nearest of them.

Whole turns are added to the joints that turn, and what fits is listed here by itself.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.c_solver import CSolver
from kinsym.check.calls import Marked, Nearest, calls_of
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import wrapped
from kinsym.check.questions import Questions
from kinsym.check.solvers import Floats, as_float

WITHIN_LAW = "within gives every winding inside the limits"
INSIDE_LAW = "nearest is the best of them"


def hold_windings(
    ledger: Ledger, target: NumpySolver | CSolver, questions: Questions, *, limits: Sequence[Any], rng: Any
) -> None:
    """Both laws at ordinary poses, for several ``limits`` (n, 2); None stands for those of the table."""
    calls, winding, fine = calls_of(target), questions.winding, questions.fine
    tried = wrong = missed = 0
    for row, limit in itertools.product(questions.ordinary, limits):
        pose, reference = questions.poses[row], questions.q[row]
        marked = calls.solve(pose, reference)
        every = marked.q if isinstance(marked, Marked) else np.empty((0, len(reference)))
        ends = table_limits(questions) if limit is None else limit
        wound = _windings(every, ends, winding, fine.edge)
        if wound is None:
            continue
        tried += 1
        wrong += not _is_within(calls.within(pose, reference, limit), *wound, marked, fine.same)
        near = reference + np.where(questions.judge.kinematics.free, rng.normal(0.0, 2.0, len(reference)), 0.0)
        for weights in (None, rng.uniform(0.1, 2.0, len(reference))):
            answer = calls.nearest(pose, near, weights, limit)
            scale = np.ones(len(near)) if weights is None else weights
            best = min((_least(q, near, ends, scale, winding) for q in every), default=np.inf)
            missed += not _is_nearest(answer, best, near, scale, ends, worse=fine.worse)
            missed += not _is_one_of(answer, marked, winding, fine.same)
    ledger.count(WITHIN_LAW, target.name, tried, wrong)
    ledger.count(INSIDE_LAW, target.name, 2 * tried, missed)


def limits_of(questions: Questions, rng: np.random.Generator) -> list[Floats | None]:
    """Limits (n, 2): narrow ones, wide ones of which one joint's are infinite, and those of the table."""
    n = questions.q.shape[1]
    unit = np.where(questions.judge.revolute, np.pi, max(questions.judge.kinematics.size, 1.0))
    middle = rng.uniform(-0.4, 0.4, n) * unit
    narrow = np.stack([middle - 0.8 * unit, middle + 0.8 * unit], axis=1)
    wide = np.stack([middle - 1.3 * unit, middle + 1.1 * unit], axis=1)
    wide[rng.integers(n)] = (-np.inf, np.inf)
    one_end = np.stack([middle - 0.9 * unit, np.full(n, np.inf)], axis=1)
    return [*(_rounded(limits, questions) for limits in (narrow, wide, one_end)), None]


def table_limits(questions: Questions) -> Floats:
    """The limits (n, 2) of the table, infinite where it has none."""
    limits = [joint.limits for joint in questions.schedule.joints]
    every = [(-np.inf, np.inf) if ends is None else tuple(map(as_float, ends)) for ends in limits]
    return _rounded(np.array(every), questions)


def _rounded(values: Floats, questions: Questions) -> Floats:
    """Numbers as their type holds them."""
    return values.astype(questions.fine.real).astype(np.float64)


def close(left: Floats, right: Floats, same: float) -> bool:
    """Whether two arrays of one shape hold the same numbers."""
    return bool((np.abs(left - right) <= same * np.maximum(1.0, np.abs(right))).all())


def _windings(every: Floats, limits: Floats, revolute: Any, edge: float) -> tuple[Floats, NDArray[np.intp]] | None:
    """All joint vectors (w, n) inside limits (n, 2), turns of the first joint outermost, and the rows of the solutions
    (m, n) that they wind (w,); None if one is on an edge."""
    wound: list[tuple[float, ...]] = []
    rows: list[int] = []
    for row, q in enumerate(every):
        places = [_turned(*values, edge) for values in zip(q, limits, revolute, strict=True)]
        if any(place is None for place in places):
            return None
        wound += list(itertools.product(*places))  # type: ignore[arg-type]
        rows += [row] * (len(wound) - len(rows))
    return np.array(wound, dtype=np.float64).reshape(-1, every.shape[1]), np.array(rows, dtype=np.intp)


def _turned(x: float, ends: Floats, revolute: bool, edge: float) -> list[float] | None:
    low, high = ends
    turns = range(-3, 4) if revolute and np.isfinite(ends).all() else range(1)
    values = [x + 2 * np.pi * turn for turn in turns]
    if any(abs(value - end) <= edge * max(1.0, abs(end)) for value in values for end in ends if np.isfinite(end)):
        return None
    return [value for value in values if low <= value <= high]


def _is_within(found: Any, wound: Floats, rows: NDArray[np.intp], marked: Any, same: float) -> bool:
    """Whether an answer is these windings, each with the marks of the solution that it winds."""
    if not (isinstance(found, Marked) and isinstance(marked, Marked) and found.q.shape == wound.shape):
        return False
    alike = all(np.array_equal(part, whole[rows]) for part, whole in zip(found[1:5], marked[1:5], strict=True))
    told = "unreachable" if not len(rows) else "singular" if _special(marked, rows) else "solved"
    return close(found.q, wound, same) and alike and found.status in (told, None)


def _special(marked: Marked, rows: Any) -> bool:
    """Whether a joint is free or on a border in any of these solutions."""
    return bool(marked.free[rows].any() or marked.border[rows].any())


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
    if not isinstance(answer, Nearest) or not np.isfinite(best):
        return answer is None and not np.isfinite(best)
    inside = ((answer.q >= limits[:, 0]) & (answer.q <= limits[:, 1])).all()
    cost = float((weights * (answer.q - near) ** 2).sum())
    return bool(inside) and abs(cost - best) <= worse * max(1.0, best)


def _is_one_of(answer: Nearest | None, marked: Marked, winding: Any, same: float) -> bool:
    """Whether an answer is a solution up to whole turns, with its status; none is no wrong one."""
    if answer is None:
        return True
    gaps = np.abs(wrapped(marked.q - answer.q, winding)) / np.maximum(1.0, np.abs(answer.q))
    row = int(np.argmin(gaps.max(axis=1)))
    told = "singular" if _special(marked, [row]) else "solved"
    return bool(gaps[row].max() <= same) and answer.status in (told, None)
