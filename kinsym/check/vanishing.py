"""The laws at special values of the parameters: one of them is 0, or two lengths are equal.

General values hide what depends on them. A parameter may be 0 unless the plan says that it must not; links of equal
length fold onto each other, where whole families of solutions begin. A value that takes a motion from the arm whatever
its joints do leaves families of solutions everywhere, and no plan is for it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.laws import CLOSURE, Judge
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import uniform, wrapped
from kinsym.check.solvers import Floats
from kinsym.check.task import task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.emit.schedule import Schedule

Values = Mapping[str, Fraction]

VANISHING_LAW = "solved with a parameter at 0 and with equal lengths"
REGULAR_LAW = "what may be 0 takes no motion from the arm"

#: Ordinary joint vectors for each special value, and those whose joints stand at quarter turns or next to them.
ORDINARY, TURNED, SLOW = 6, 24, 1
OFFSETS = (0.0, 1e-9, -1e-7, 1e-5)
#: The share of the largest singular value of a Jacobian that the least one has but for rounding where a motion is lost.
LOST = 1e-9


def special_values(schedule: Schedule, values: Values, lengths: frozenset[str]) -> Iterator[dict[str, Fraction]]:
    """The parameters with one of those that may be 0 at 0, then with two neighbours of the lengths that may not be
    equal; not those with which a sum vanishes that must not."""
    needed = {name for item in schedule.nonzero for name in item.parameters}
    yield from ({**values, name: Fraction(0)} for name in values if name not in needed and values[name])
    kept = [name for name in values if name in lengths and values[name]]
    sums = [set(item.parameters) for item in schedule.nonzero if len(item.parameters) > 1]
    for one, two in pairwise(kept):
        if not any({one, two} <= names for names in sums):
            yield {**values, two: abs(values[one]) * (1 if values[two] > 0 else -1)}


class Special:
    """Poses (m, 4, 4) of joint vectors q (m, n) at special values of the parameters, ordinary ones first."""

    def __init__(
        self, schedule: Schedule, values: Values, given: Floats, judge: Judge, rng: np.random.Generator
    ) -> None:
        kinematics = TreeKinematics(schedule, values)
        self.schedule, self.values = schedule, values
        self.judge = Judge(kinematics, schedule.task, judge.revolute, judge.tau, judge.path)
        self.ordinary = SLOW if schedule.general else ORDINARY
        q = uniform(judge.revolute, kinematics.size or 1.0, self.ordinary + (0 if schedule.general else TURNED), rng)
        # what is held stays where it is held
        self.q = np.where(kinematics.free, q, given[: len(q)])
        self._turn(np.flatnonzero(kinematics.free))
        self.poses = kinematics.forward(self.q)

    @property
    def regular(self) -> bool:
        """Whether the task's Jacobian has full rank at an ordinary joint vector, lengths in sizes of the arm."""
        kinematics, q = self.judge.kinematics, self.q[: self.ordinary]
        slopes = task_jacobian(kinematics.jacobian(q), kinematics.forward(q), self.judge.task, kinematics.size)
        unit = np.where(self.judge.revolute, 1.0, kinematics.size or 1.0)
        height = np.linalg.svd((slopes * unit)[..., kinematics.free], compute_uv=False)
        return bool((height[:, -1] > LOST * height[:, 0]).any())

    def _turn(self, free: Sequence[int] | np.ndarray) -> None:
        """Put a joint of all but the ordinary vectors at a quarter turn, a length at 0, or next to it."""
        for place, row in enumerate(range(self.ordinary, len(self.q))):
            joint, offset = free[place % len(free)], OFFSETS[place // (2 * len(free)) % len(OFFSETS)]
            turn = np.pi * (place // len(free) % 2) if self.judge.revolute[joint] else 0.0
            self.q[row, joint] = wrapped(np.array([turn + offset]), np.array([self.judge.revolute[joint]]))[0]


def hold_regular(ledger: Ledger, subject: str, every: Sequence[Special]) -> None:
    """At each special value the arm has all motions of its task in one of the ordinary postures at least."""
    wrong = sum(not special.regular for special in every)
    if every:
        ledger.count(REGULAR_LAW, subject, len(every), wrong)


def hold_special(ledger: Ledger, target: NumpySolver | CSolver, every: Sequence[Special]) -> None:
    """All solutions reach their poses; the known vector is found, where two singularities may meet any is."""
    tried = wrong = 0
    for special in every:
        code = target.library if isinstance(target, CSolver) else target.module
        solver = type(target)(code, special.schedule, special.values)  # type: ignore[arg-type]
        q, count = solver.inverse(special.poses, special.q)
        closures = special.judge.closures(q, special.poses)
        broken = ~((closures <= CLOSURE) | (np.arange(q.shape[1]) >= count[:, None])).all(axis=1)
        first = slice(0, special.ordinary)
        lost = count == 0
        lost[first] |= ~special.judge.found(q[first], special.q[first], special.poses[first])
        tried, wrong = tried + len(lost), wrong + int((broken | lost).sum())
    ledger.count(VANISHING_LAW, target.name, tried, wrong)
