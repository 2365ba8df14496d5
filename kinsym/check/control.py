"""The laws of what a controller asks for: the nearest solution, and the status of a call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from kinsym.check.c_solver import CSolver
from kinsym.check.laws import SAME, Judge, malformed, outward
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Floats, Solutions, Solver

NEAREST_LAW = "nearest returns the solution nearest to the reference"
STATUS_LAW = "the status tells what was found"
STATUS_AGREE_LAW = "same status"

#: How far the reference is from the joint vector of the pose, in radians or lengths: now and then more than a turn.
SPREAD = 3.0
#: So many poses lie beyond the reach, unless slides take the arm there.
FAR = 4
#: Of the singular poses of one choice of parameters rounding may hide so many.
ROUNDED = 1
#: A worse answer than the best by this share is a wrong one: nine digits are a tie.
WORSE = 1e-6


def hold_nearest(
    ledger: Ledger,
    target: NumpySolver | CSolver,
    judge: Judge,
    *,
    poses: Floats,
    q: Floats,
    rng: np.random.Generator,
) -> None:
    """The answer is a solution up to whole turns, and no solution is nearer.

    ``poses`` (m, 4, 4) are those of ``q`` (m, n); a joint that is held keeps its value in the reference.
    """
    winding, free = judge.revolute & judge.kinematics.free, judge.kinematics.free
    references = q + np.where(free, rng.normal(0.0, SPREAD, q.shape), 0.0)
    weights = rng.uniform(0.1, 2.0, q.shape)
    wrong = 0
    for row, reference in enumerate(references):
        answer = target.nearest(poses[row], reference, weights[row])
        solutions, counts = target.inverse(poses[row : row + 1], references[row : row + 1])
        every = solutions[0, : counts[0]]
        if answer is None or not len(every):
            wrong += (answer is None) != (not len(every))
            continue
        costs = (weights[row] * wrapped(every - reference, winding) ** 2).sum(axis=1)
        own = (weights[row] * (answer - reference) ** 2).sum()
        apart = np.abs(wrapped(every - answer, winding)) / np.maximum(1.0, np.abs(answer))
        wrong += not (own <= costs.min() * (1.0 + WORSE) + SAME**2 and apart.max(axis=1).min() <= SAME)
    ledger.count(NEAREST_LAW, target.name, len(q), wrong)


def hold_status(
    ledger: Ledger,
    targets: Sequence[Solver],
    answers: Mapping[str, Solutions],
    *,
    poses: Floats,
    q: Floats,
    size: float,
    uniform: NDArray[np.bool_],
    which: NDArray[np.intp],
    singular: NDArray[np.intp],
) -> None:
    """The status of each language fits its answer, and all say the same of poses that are not next to a border.

    ``size`` is that of the arm; some poses are asked for far beyond it. The rows ``singular`` are exactly so.
    """
    said: dict[str, list[str]] = {}
    far = outward(poses[:FAR], size)
    for target in targets:
        if target.name not in answers or not isinstance(target, NumpySolver | CSolver):
            continue
        count = answers[target.name][1]
        cases = list(malformed(poses[0]).values())
        try:
            beyond = np.flatnonzero(target.inverse(far, q[: len(far)])[1] == 0)
            missed = [target.status(far[row], q[row]) for row in beyond]
            special = [target.status(poses[row], q[row]) for row in singular]
            told = [target.status(poses[row], q[row]) for row in which]
            refused = [target.status(case, q[0]) for case in cases]
        except Exception as error:  # generated code that was edited may raise anything
            ledger.fail(STATUS_LAW, target.name, f"{type(error).__name__}: {error}")
            continue
        wrong = sum(bool(count[row]) == (word == "unreachable") for row, word in zip(which, told, strict=True))
        wrong += sum(word != "not a pose" for word in refused) + sum(word != "unreachable" for word in missed)
        wrong += max(0, sum(word != "singular" for word in special) - ROUNDED)
        ledger.count(STATUS_LAW, target.name, len(which) + len(cases) + len(missed) + len(special), wrong)
        said[target.name] = told
    for name in list(said)[1:]:
        own, first = next(iter(said.items()))
        wrong = sum(a != b for a, b, plain in zip(first, said[name], uniform[which].tolist(), strict=True) if plain)
        ledger.count(STATUS_AGREE_LAW, f"{own} and {name}", int(uniform[which].sum()), wrong)
