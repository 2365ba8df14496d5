"""What both languages are asked alike: the calls of a controller, in order and out of order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from kinsym.check.calls import Calls, Marked
from kinsym.check.solvers import Floats
from tests.sabotage.inputs import Inputs, broken_parameters, broken_vectors
from tests.sabotage.transcript import Transcript, behind_each_other, flat

#: No arm has more solutions.
_MOST = 16

#: Poses with the joint vectors that made them.
_Rows = Sequence[tuple[Floats, Floats]]


def say(told: Transcript, label: str, call: Callable[..., Any], *arguments: Any, **given: Any) -> None:
    """Put an answer into a transcript, or the error that came instead."""
    try:
        told[label] = flat(call(*arguments, **given))
    except Exception as error:
        told[label] = f"{type(error).__name__}: {error}"


def controller(calls: Calls, each: Inputs) -> Transcript:
    """What the calls say of ordinary poses and of those next to singular ones, and what they refuse."""
    told: Transcript = {}
    say(told, "solve marks", _marks, calls, each)
    rows = [(each.T[row], each.q[row]) for row in each.ordinary]
    # so far away that turns are added; what is locked keeps its value
    free = each.judge.kinematics.free
    near = [np.where(free, 3 * each.q[row - 1], each.q[row]) for row in each.ordinary]
    for k, limits in enumerate((None, *each.limits)):
        say(told, f"within {k}", _within, calls, rows, limits)
        for j, weights in enumerate((None, *each.weights)):
            more = (weights, limits)
            say(told, f"nearest {k} {j}", _nearest, calls, rows, near, more)
    _odd(told, calls, each)
    return told


def _marks(calls: Calls, each: Inputs) -> np.ndarray:
    """Branches, marks and status (m, ...) of some poses, zeros for the others; the joint vectors are those of ik."""
    told = np.zeros((len(each.T), _MOST * (1 + 3 * each.q.shape[1]) + 16))
    for row in each.single:
        found = calls.solve(each.T[row], each.q[row])
        answer = flat(found[1:] if isinstance(found, Marked) else found)
        told[row, : len(answer)] = answer
    return told


def _within(calls: Calls, rows: _Rows, limits: Floats | None) -> np.ndarray:
    return behind_each_other(calls.within(T, q, limits) for T, q in rows)


def _nearest(calls: Calls, rows: _Rows, near: Sequence[Floats], more: Any) -> np.ndarray:
    return behind_each_other(calls.nearest(T, q, *more) for (T, _), q in zip(rows, near, strict=True))


def _odd(told: Transcript, calls: Calls, each: Inputs) -> None:
    q, T = each.q[each.ordinary[0]], each.T[each.ordinary[0]]
    for name, pose in each.odd.items():
        say(told, f"solve of {name}", calls.solve, pose, q)
        say(told, f"within of {name}", calls.within, pose, q, None)
        say(told, f"nearest of {name}", calls.nearest, pose, q, None, None)
    for k, parameters in enumerate(broken_parameters(each.parameters)):
        say(told, f"refused with parameters {k}", lambda given: tuple(calls.refusing(T, q, given).values()), parameters)
        say(told, f"solve with parameters {k}", calls.solve, T, q, parameters)
    for k, broken in enumerate(broken_vectors(q)):
        say(told, f"solve near {k}", calls.solve, T, broken)
        say(told, f"within near {k}", calls.within, T, broken, None)
        say(told, f"nearest near {k}", calls.nearest, T, broken, None, None)
    for k, broken in enumerate(broken_vectors(each.limits[0])):
        say(told, f"within limits {k}", calls.within, T, q, broken)
        say(told, f"nearest limits {k}", calls.nearest, T, q, None, broken)
    for k, broken in enumerate(broken_vectors(each.weights[0])):
        say(told, f"nearest weights {k}", calls.nearest, T, q, broken, None)
