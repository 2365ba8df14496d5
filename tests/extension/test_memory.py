"""No call of the compiled functions keeps or loses memory, whether it succeeds or raises."""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.extension.built import outcome, pair, references

Q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7])
LIMITS = np.array([(-4.0, 4.0)] * 7)
WEIGHTS = np.ones(7)
VALUES = np.linspace(-1.0, 1.0, 5)
BAD = np.zeros((4, 4))
NUMBER = 1000.5
POSE = np.eye(4)

CALLS: dict[str, Callable[[Any], Any]] = {
    "fk": lambda m: m.fk(Q, d1=NUMBER),
    "jacobian": lambda m: m.jacobian(Q[None, None], d1=NUMBER),
    "ik": lambda m: m.ik(POSE, theta3=NUMBER, reference=Q, d1=NUMBER),
    "ik_batch": lambda m: m.ik_batch(POSE, theta3=VALUES, reference=Q, d1=NUMBER),
    "solve": lambda m: m.solve(POSE, theta3=NUMBER, reference=Q),
    "within": lambda m: m.within(POSE, theta3=0.3, limits=LIMITS, reference=Q),
    "nearest": lambda m: m.nearest(POSE, Q, theta3=NUMBER, weights=WEIGHTS, limits=LIMITS),
    "lists": lambda m: m.nearest(POSE.tolist(), Q.tolist(), theta3=1, weights=list(WEIGHTS), limits=LIMITS.tolist()),
    "no pose": lambda m: m.ik(BAD, theta3=NUMBER, reference=Q),
    "no pose, batch": lambda m: m.ik_batch(BAD, theta3=VALUES, reference=Q),
    "no pose, within": lambda m: m.within(BAD, theta3=NUMBER, limits=LIMITS),
    "no pose, nearest": lambda m: m.nearest(BAD, Q, theta3=NUMBER),
    "wrong shape": lambda m: m.ik(POSE[:3], theta3=NUMBER),
    "no numbers": lambda m: m.fk("seven"),
    "a parameter that is NaN": lambda m: m.ik(POSE, theta3=NUMBER, d1=np.nan),
    "a parameter that is None": lambda m: m.ik(POSE, theta3=NUMBER, d1=None),
    "an input that is a word": lambda m: m.ik(POSE, theta3="x"),
    "a reference that is NaN": lambda m: m.ik(POSE, theta3=NUMBER, reference=Q * np.nan),
    "limits that are swapped": lambda m: m.within(POSE, theta3=NUMBER, limits=LIMITS[:, ::-1]),
    "a weight below zero": lambda m: m.nearest(POSE, Q, theta3=NUMBER, weights=-WEIGHTS),
    "too many windings": lambda m: m.within(POSE, theta3=NUMBER, limits=LIMITS * 1e3),
}


@pytest.mark.parametrize("case", CALLS)
def test_nothing_is_kept(case: str) -> None:
    """Reference counts of everything that is handed in, and the memory in use, are the same after a thousand calls.

    Objects of Python's and NumPy's free lists are taken for new ones by the first who needs them, so the least of
    three rounds counts.
    """
    package = pair("kuka_iiwa").package
    watched = (Q, LIMITS, WEIGHTS, VALUES, BAD, POSE, NUMBER, np.empty, np.intp, np.bool_, np.ndarray, package._core)

    def thousand_calls() -> int:
        start = tracemalloc.get_traced_memory()[0]
        for _ in range(1000):
            outcome(lambda: CALLS[case](package))
        gc.collect()
        return tracemalloc.get_traced_memory()[0] - start

    outcome(lambda: CALLS[case](package))
    gc.collect()
    before = references(*watched)
    tracemalloc.start()
    try:
        grown = min(thousand_calls() for _ in range(3))
    finally:
        tracemalloc.stop()
    assert references(*watched) == before
    # one lost object a call would be 16 kB and more
    assert grown < 12000


def test_results_own_their_memory() -> None:
    """An answer stays what it is when others are asked for and the arguments are changed or gone."""
    package = pair("kuka_iiwa").package
    q = Q.copy()
    T = package.fk(q)
    answer = package.ik(T, theta3=0.3)
    kept = answer.copy()
    q[:], T[...] = 0.0, 0.0
    del q, T
    others = [package.ik(package.fk(Q + shift), theta3=0.3) for shift in np.linspace(0.1, 1.0, 200)]
    assert (answer == kept).all()
    assert answer.flags.writeable
    assert answer.flags.owndata
    assert len(others) == 200
