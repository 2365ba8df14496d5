"""Every timed answer is put through the product of the table's matrices, which no library had a part in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.benchmarks.speed.arms import ARMS, Floats
from tests.benchmarks.speed.entries import Answer

#: A solution that misses its pose by more (in metres and in entries of the rotation) is wrong.
WRONG = 1e-6


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """Solutions for an input on average, how many are wrong, and the worst miss of the others."""

    mean: float
    wrong: int
    worst: float


def judged(kind: str, arm: str, inputs: Floats, answer: Answer) -> Verdict:
    """The answers to inputs: solutions of poses (..., n), or matrices of joint vectors as rows."""
    table = ARMS[arm]
    found = np.array([len(rows) for rows in answer])
    width = {"ik": len(table.rows), "fk": 16, "jacobian": 6 * len(table.rows)}[kind]
    rows = np.concatenate([np.asarray(one, dtype=np.float64).reshape(-1, width) for one in answer])
    if kind == "ik":
        wanted = np.repeat(inputs, found, axis=0)
        misses = np.abs(table.forward(rows) - wanted)
    else:
        q = inputs[: len(rows)]
        matrix = table.forward(q) if kind == "fk" else table.jacobian(q)
        misses = np.abs(rows - matrix.reshape(len(rows), -1))
    worst = misses.max(axis=tuple(range(1, misses.ndim)), initial=0.0)
    good = worst <= WRONG
    return Verdict(mean=float(found.mean()), wrong=int((~good).sum()), worst=float(worst[good].max(initial=0.0)))
