"""What generated code says, by what it was asked, and whether two transcripts say the same."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from kinsym.check.answers import CLOSE_PATH
from kinsym.check.interface import MORE_MARKS
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Floats
from tests.sabotage.inputs import Inputs

#: Values that agree so well are the same but for rounding.
ROUNDING = 1e-9
#: So many times the noise of a rotation its solutions may miss it, as in the checks: it tells no more of them.
UNTOLD = 20

#: By what was asked: words, numbers, or solutions (m, S, n) of poses, NaN where there is none.
Transcript = dict[str, Any]


def flat(answer: Any) -> np.ndarray:
    """Numbers in one array: those of a tuple one after the other, a word by its letters, None as NaN."""
    if isinstance(answer, tuple):
        return np.concatenate([np.ravel(flat(part)).astype(float) for part in answer])
    if isinstance(answer, str):
        return np.frombuffer(answer.encode().ljust(16), dtype=np.uint8)
    return np.array([np.nan]) if answer is None else np.asarray(answer)


def behind_each_other(answers: Iterable[Any]) -> np.ndarray:
    """Answers to one pose after the other in one array, each with its length in front."""
    parts = [np.ravel(flat(answer)).astype(float) for answer in answers]
    return np.concatenate([part for each in parts for part in ([float(len(each))], each)])


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Where two transcripts differ at most and by how much; 0 if nowhere, infinite if in more than rounding."""

    where: str = ""
    size: float = 0.0


def difference(good: Transcript, mutant: Transcript, inputs: Sequence[Inputs]) -> Difference:
    """The first thing that is more than rounding, else the largest rounding."""
    worst = Difference()
    for label, expected in good.items():
        size = _gap(label, expected, mutant[label], inputs)
        if size > ROUNDING:
            return Difference(where=label, size=math.inf)
        if size > worst.size:
            worst = Difference(where=label, size=size)
    return worst


def _gap(label: str, good: Any, mutant: Any, inputs: Sequence[Inputs]) -> float:
    if isinstance(good, str) or isinstance(mutant, str):
        return 0.0 if isinstance(good, str) and isinstance(mutant, str) and good == mutant else math.inf
    if good.shape != mutant.shape:
        return math.inf
    both = np.isnan(good) & np.isnan(mutant) if good.dtype.kind == "f" and mutant.dtype.kind == "f" else False
    same = (good == mutant) | both
    if same.all():
        return 0.0
    kind, _, number = label.partition(" of choice ")
    if good.dtype.kind != "f" or kind.endswith("marks"):
        rows = ~same.reshape(len(same), -1).all(axis=1)
        return ROUNDING if kind.endswith("marks") and _few(rows, inputs[int(number)]) else math.inf
    with np.errstate(invalid="ignore"):
        gaps = np.where(same, 0.0, np.abs(good - mutant) / np.maximum(1.0, np.abs(good)))
    if (gaps <= ROUNDING).all():
        return float(gaps.max())
    return _solution_gap(good, mutant, inputs[int(number)]) if kind.endswith("solutions") else math.inf


def _solution_gap(good: Floats, mutant: Floats, inputs: Inputs) -> float:
    """Solutions are the same if a way on which the pose stays joins them; where two singularities meet those are wanted
    that reach the pose."""
    with np.errstate(invalid="ignore"):
        apart = np.abs(wrapped(mutant - good, inputs.judge.revolute)).max(axis=-1)
    there = [~np.isnan(q).any(axis=-1) for q in (good, mutant)]
    rows = np.flatnonzero((there[0] != there[1]).any(axis=1) | (there[0] & ~(apart <= ROUNDING)).any(axis=1))
    closures = np.where(there[1][rows], inputs.judge.closures(mutant[rows], inputs.T[rows]), 0.0)
    if (closures > np.maximum(ROUNDING, UNTOLD * inputs.noise[rows])[:, None]).any():
        return math.inf
    other, rows = np.zeros(len(good), dtype=bool), rows[~inputs.loose[rows]]
    for noise in np.unique(inputs.noise[rows]):
        alike = rows[inputs.noise[rows] == noise]
        judge = replace(inputs.judge, path=max(inputs.judge.path, CLOSE_PATH, UNTOLD * noise))
        left, right = (_packed(q[alike]) for q in (good, mutant))
        other[alike] = ~judge.agreement(left, right, inputs.T[alike])[1]
        other[alike] |= (left[1] != right[1]) & inputs.firm[alike]
    return ROUNDING if _few(other, inputs) else math.inf


def _few(other: np.ndarray, inputs: Inputs) -> bool:
    """Whether poses (m,) at which something is another lie at the ends of bands, as few as the checks let pass."""
    soft = ~inputs.firm & ~inputs.loose
    return not (other & inputs.firm).any() and int((other & soft).sum()) <= 1 + int(soft.sum()) // MORE_MARKS


def _packed(q: Floats) -> tuple[Floats, np.ndarray]:
    there = ~np.isnan(q).any(axis=-1)
    order = np.argsort(~there, axis=1, kind="stable")
    return np.take_along_axis(q, order[..., None], axis=1), there.sum(axis=1)
