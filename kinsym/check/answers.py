"""The laws of the answers to poses that were made from joint vectors: closure, completeness, agreement of two answers.

What a pose tells of its joint vector depends on how near it is to a singular one. Ordinary poses tell all of it; next
to a singular one double roots merge and angles are soft; where two singularities meet only that there is a solution is
sure.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kinsym.check.laws import CLOSURE, COPY, SAME, Judge
from kinsym.check.ledger import Ledger
from kinsym.check.poses import NOMINAL, PAIR, UNIFORM, Samples
from kinsym.check.solvers import Floats, Solutions
from kinsym.emit.schedule import Schedule

Rows = NDArray[np.intp]

#: Nearer to a singular pose than this, double roots merge (within 2 sqrt(2 tau)) and angles are soft.
MERGED = 1e-6
#: The closure allowed there on a way between two vectors that count as one solution; where two singularities meet,
#: solutions within tau^(1/4) of each other are one cluster, whose members miss the pose by the square of a third of it.
CLOSE_PATH = 1e-8
PAIR_PATH = 3e-6
#: Nearer than this, but not at it, the pose in doubles may tell too little of the joint vector that made it.
NEAREST = 1e-12
#: At one in so many of the poses nearest to a singular one, rounding may lead one answer to a solution more.
MORE_SOLUTIONS = 100
AGREE_LIMIT = f"<= {SAME:g} or one double root; next to singular poses but for 1 in {MORE_SOLUTIONS}"

#: At one in so many of the poses next to singular ones of the nominal arm, or nearest to any, one may be missed.
MISSED = 100
CLOSE_LIMIT = f"but for 1 in {MISSED} within {NEAREST:g} of one"
#: What Newton's steps leave at a random pose.
ORDINARY = 1e-12

#: Solutions whose volume is below this share of the usual one may be points of a curve of solutions.
REGULAR = 1e-3

INVERSE_LAW = "FK(IK(T)) = T for every solution"
ORDINARY_LAW = "FK(IK(T)) = T to the last digits at random poses"
FOUND_LAW = "the known joint vector is among the solutions"
CLOSE_LAW = "the same next to singular poses"
PAIR_LAW = "two singularities at once still have a solution"
BESIDE_LAW = "the same at and next to singular poses of the nominal arm"
COPY_LAW = "no solution twice"
RANGE_LAW = "angles in (-pi, pi]"
AGREE_LAW = "same solutions in the same order"


@dataclass(frozen=True, kw_only=True)
class Answers:
    """The poses (m, 4, 4) of the samples, by which answers are judged.

    ``volume`` gives the size of the task's Jacobian at joint vectors (m, n); answers are solutions (k, S, n) of the k
    poses ``which`` with their numbers (k,).
    """

    schedule: Schedule
    judge: Judge
    samples: Samples
    poses: Floats
    volume: Callable[[Floats], Floats]

    def hold(self, ledger: Ledger, name: str, answer: Solutions, which: Rows) -> None:
        """Every solution reaches its pose, the known one is among them, none is there twice, no angle out of range."""
        q, count = answer
        closures = self.closures(answer, self.poses[which])
        ledger.judge(INVERSE_LAW, name, closures, CLOSURE)
        if self.schedule.nominal:
            ledger.judge(ORDINARY_LAW, name, closures[self.samples.of(UNIFORM)[which]], ORDINARY)
        self._known(ledger, name, answer, which)
        ledger.count(COPY_LAW, name, len(which), self.judge.copies(q), limit=f"> {COPY:g} apart")
        angles = q[..., self.judge.revolute & self.judge.kinematics.free]
        with np.errstate(invalid="ignore"):
            inside = np.all((angles > -np.pi) & (angles <= np.pi), axis=-1)
        outside = (np.arange(q.shape[1]) < count[:, None]) & ~inside
        ledger.count(RANGE_LAW, name, len(which), int(outside.any(axis=1).sum()))

    def agree(self, ledger: Ledger, subject: str, left: Solutions, right: Solutions, which: Rows) -> None:
        """Two answers are the same, in the same order."""
        same, sets = self.judge.agreement(left, right, self.poses[which])
        uniform, pair, close = self.samples.of(UNIFORM)[which], self.samples.of(PAIR)[which], self._close[which]
        rows = np.flatnonzero(~sets & close)
        if rows.size:
            wider = replace(self.judge, path=max(self.judge.path, CLOSE_PATH))
            first, second = ((q[rows], count[rows]) for q, count in (left, right))
            sets[rows] = wider.agreement(first, second, self.poses[which[rows]])[1]
        on_curves = close & ((self.samples.offset[which] <= NEAREST) | bool(self.schedule.general))
        for row in np.flatnonzero(~sets & on_curves):
            sets[row] = self._regular_ones_agree(left, right, int(row), self.poses[which[row]])
        beside = self.samples.of(NOMINAL)[which]
        odd, lost = int((~sets & close).sum()), int((~sets & beside).sum())
        failed = int(np.where(uniform, ~same, ~sets & ~pair & ~close & ~beside).sum())
        failed += _too_many(odd, close, MORE_SOLUTIONS) + _too_many(lost, beside, MISSED)
        if self.schedule.nominal:
            ledger.tally(f"{subject}: next to singular poses of the nominal arm, not the same solutions", lost)
        ledger.tally(f"{subject}: next to a singular pose, a solution more", odd)
        ledger.count(AGREE_LAW, subject, len(which), failed, limit=AGREE_LIMIT)
        ledger.tally(f"{subject}: at the edge of a tolerance band", int((~same & sets).sum()))

    def closures(self, solutions: Solutions, poses: Floats) -> Floats:
        """The worst closure of each pose's solutions; infinite where one of them is not finite."""
        q, count = solutions
        valid = np.arange(q.shape[1]) < count[:, None]
        closures = self.judge.closures(q, poses)
        closures = np.where(np.isnan(closures), np.inf, closures)
        return np.asarray(np.where(valid, closures, 0.0).max(axis=1, initial=0.0))

    def _known(self, ledger: Ledger, name: str, answer: Solutions, which: Rows) -> None:
        """The known joint vectors are found."""
        q, count = answer
        pair, close = self.samples.of(PAIR)[which], self._close[which]
        missed = ~self._found(q, which)
        beside = self.samples.of(NOMINAL)[which]
        clear = ~close & ~pair & ~beside
        ledger.count(FOUND_LAW, name, int(clear.sum()), int((missed & clear).sum()))
        if self.schedule.nominal:
            lost, limit = int((missed & beside).sum()), f"but for 1 in {MISSED}"
            ledger.count(BESIDE_LAW, name, int(beside.sum()), _too_many(lost, beside, MISSED), limit=limit)
            ledger.tally(f"{name}: next to singular poses of the nominal arm, known vector not found", lost)
        offset = self.samples.offset[which]
        untold = close & (offset > 0.0) & (offset <= NEAREST)
        wrong = int((missed & close & ~untold).sum()) + _too_many(int((missed & untold).sum()), untold, MISSED)
        ledger.count(CLOSE_LAW, name, int(close.sum()), wrong, limit=CLOSE_LIMIT)
        ledger.tally(
            f"{name}: within {NEAREST:g} of a singular pose, known vector not found", int((missed & untold).sum())
        )
        ledger.count(PAIR_LAW, name, int(pair.sum()), int((pair & (count == 0)).sum()))
        ledger.tally(f"{name}: two singularities at once, known vector not found", int((pair & missed).sum()))

    def _found(self, q: Floats, which: Rows) -> NDArray[np.bool_]:
        """Whether the known joint vectors are among the solutions, as finely as their poses tell them."""
        known, poses = self.samples.q[which], self.poses[which]
        found = self.judge.found(q, known, poses)
        for kind, path in ((self._close[which], CLOSE_PATH), (self.samples.of(PAIR)[which], PAIR_PATH)):
            rows = np.flatnonzero(~found & kind)
            if rows.size:
                wider = replace(self.judge, path=max(self.judge.path, path))
                found[rows] = wider.found(q[rows], known[rows], poses[rows])
        return found

    def _regular_ones_agree(self, left: Solutions, right: Solutions, row: int, pose: Floats) -> bool:
        """Whether the regular solutions of one pose are in both answers.

        Where an arm can move without moving its tool, some of a whole curve of solutions are found; the search for the
        roots of a general one may find as many as it can return.
        """
        if self.schedule.general and max(left[1][row], right[1][row]) >= self.schedule.maximum:
            return True
        found = [q[row, : count[row]] for q, count in (left, right)]
        if not all(np.isfinite(q).all() for q in found):
            return False
        firm = [q[self.volume(q) > REGULAR * np.median(self.volume(self.samples.q))] for q in found]
        return self.judge.covers(firm[0], found[1], pose) and self.judge.covers(firm[1], found[0], pose)

    @property
    def _close(self) -> NDArray[np.bool_]:
        """Samples so near to one singular pose that double roots merge and angles are soft."""
        return np.asarray((self.samples.offset <= MERGED) & ~self.samples.of(PAIR))


def _too_many(failed: int, tried: NDArray[np.bool_], share: int) -> int:
    """How many cases of those tried fail beyond one, and one in ``share``."""
    return max(0, failed - 1 - int(tried.sum()) // share)
