"""The laws of C in single precision, held against the exact walk, the table and the other languages.

A float knows seven digits, so a pose is known to about 1e-7 of the arm's size, and a solution to that divided by the
least singular value of the task's Jacobian, lengths in units of the arm. Solutions at which that value is above
:data:`REGULAR` are *regular*: these must be the exact walk's, one for one. Next to singular poses double roots are one
from further away than in double precision and a border is wider, so that numbers of solutions may differ; there every
solution must reach its pose all the same, and hardly any pose may be left without one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.c_solver import CSolver
from kinsym.check.interface import hold_interface
from kinsym.check.laws import Judge, malformed, outward
from kinsym.check.ledger import Ledger
from kinsym.check.poses import Samples, wrapped
from kinsym.check.questions import Fineness, Questions
from kinsym.check.solvers import Floats, Solutions
from kinsym.check.strange import hold_refusals
from kinsym.check.task import task_jacobian
from kinsym.robot.model import Task

#: The least singular value from which on a solution is regular.
REGULAR = 0.01
#: Forward kinematics and Jacobian, in units of the arm or 1; what was measured is below 1e-6.
FORWARD = 5e-6
#: The closure of regular solutions and of all, in units of the arm: the least squares give up beyond 1e-4 of its size,
#: to which an arm that slides adds where the pose is.
ORDINARY, CLOSURE = 2e-5, 3e-4
#: The error of a joint value times the least singular value.
FELT = 1e-5
#: Solutions nearer than this in every joint, lengths in units of the arm, are copies.
COPY = 1e-3
#: At one in so many singular poses there may be no solution.
EMPTY = 100
#: One call and many are the same code but for the order of sums.
BATCH = 1e-4
#: Angles so many times as large are left to the function for one joint vector.
MANY_TURNS, TURNED = 1e3, 5
FAR_POSES = 12
#: How finely the calls of a controller are judged, at ordinary and at singular poses.
FINENESS = Fineness(real=np.float32, same=1e-4, worse=1e-4, edge=1e-4, chosen=0.1)

FORWARD_LAW = "single precision: forward kinematics"
JACOBIAN_LAW = "single precision: Jacobian"
ORDINARY_LAW = "single precision: FK(IK(T)) = T for regular solutions"
CLOSURE_LAW = "single precision: FK(IK(T)) = T for every solution"
KNOWN_LAW = "single precision: the known joint vector is among the solutions where it is regular"
SAME_LAW = "single precision: the same regular solutions"
EMPTY_LAW = "single precision: poses at and next to singular ones have a solution"
COPY_LAW = "single precision: no solution twice"
RANGE_LAW = "single precision: angles in (-pi, pi]"
FAR_LAW = "single precision: no solution beyond the reach"
BATCH_LAW = "single precision: ik_near and ik_batch agree, fk and fk_batch"


class SingleSolver(CSolver):
    """The compiled C in single precision."""

    name = "C in float"
    real = np.float32


@dataclass(frozen=True, kw_only=True)
class SinglePrecision:
    """What a solver in single precision is held to, at the poses (m, 4, 4) of samples q (m, n).

    ``answers`` has for each other answerer its solutions and the rows of the poses that it saw.
    """

    ledger: Ledger
    judge: Judge
    samples: Samples
    poses: Floats
    answers: Mapping[str, tuple[Solutions, NDArray[np.intp]]]

    def hold(self, target: SingleSolver, questions: Questions, rng: np.random.Generator) -> None:
        """Every law."""
        q = self.samples.q
        self._forward(target, q)
        answer = target.inverse(self.poses, q)
        self._solutions(target.name, answer)
        for name, (other, rows) in self.answers.items():
            self._same(f"{name} and {target.name}", answer, other, rows)
        hold_refusals(self.ledger, target, self.poses[0])
        self._far(target)
        self._batch(target, q)
        hold_interface(self.ledger, target, questions, rng)

    def _forward(self, target: SingleSolver, q: Floats) -> None:
        kinematics = self.judge.kinematics
        self.ledger.judge(FORWARD_LAW, target.name, self._apart(target.forward(q), self.poses), FORWARD)
        exact = kinematics.jacobian(q)
        errors = np.abs(target.jacobian(q) - exact)[..., kinematics.free].max(axis=(1, 2))
        self.ledger.judge(JACOBIAN_LAW, target.name, errors / max(1.0, float(np.abs(exact).max())), FORWARD)

    def _solutions(self, name: str, answer: Solutions) -> None:
        """The laws of the solutions alone, and of the joint vectors that the poses were made from."""
        q, count = answer
        there = np.arange(q.shape[1]) < count[:, None]
        closures = self.judge.closures(q, self.poses)
        closures = np.where(there, np.where(np.isnan(closures), np.inf, closures), 0.0)
        regular = there & (self._least(q) > REGULAR)
        self.ledger.judge(ORDINARY_LAW, name, np.where(regular, closures, 0.0).max(axis=1), ORDINARY)
        self.ledger.judge(CLOSURE_LAW, name, closures.max(axis=1), CLOSURE)
        known = self.samples.q
        least = self._least(known)
        tell = least > REGULAR
        apart = self._gaps(q, known[:, None]).min(axis=1, initial=np.inf)
        self.ledger.judge(KNOWN_LAW, name, apart[tell] * least[tell], FELT)
        without = int(((count <= 0) & ~tell).sum())
        rows = int((~tell).sum())
        limit = f"but for 1 in {EMPTY}"
        self.ledger.count(EMPTY_LAW, name, rows, max(0, without - 1 - rows // EMPTY), limit=limit)
        twice = sum(np.count_nonzero(self._gaps(q[:, k + 1 :], q[:, k : k + 1]) < COPY) for k in range(q.shape[1] - 1))
        self.ledger.count(COPY_LAW, name, len(q), int(twice), limit=f"> {COPY:g} apart")
        angles = q[..., self.judge.revolute & self.judge.kinematics.free]
        half = float(np.float32(np.pi))
        with np.errstate(invalid="ignore"):
            inside = np.all((angles > -half) & (angles <= half), axis=-1)
        self.ledger.count(RANGE_LAW, name, len(q), int((there & ~inside).any(axis=1).sum()))

    def _same(self, subject: str, answer: Solutions, other: Solutions, rows: NDArray[np.intp]) -> None:
        """The regular solutions of each are among the other's; where all are regular they are as many."""
        (mine, mine_count), (theirs, theirs_count) = (answer[0][rows], answer[1][rows]), other
        wrong = np.zeros(len(rows), dtype=bool)
        firm = np.ones(len(rows), dtype=bool)
        for some, others in ((mine, theirs), (theirs, mine)):
            least = np.maximum(self._least(some), 1e-300)
            there = ~np.isnan(some).any(axis=-1)
            apart = self._gaps(others[:, None], some[:, :, None]).min(axis=-1, initial=np.inf)
            regular = there & (least > REGULAR)
            wrong |= (regular & ~(apart <= FELT / least)).any(axis=1)
            firm &= (regular | ~there).all(axis=1)
        wrong |= firm & (mine_count != theirs_count)
        self.ledger.count(SAME_LAW, subject, len(rows), int(wrong.sum()))

    def _far(self, target: SingleSolver) -> None:
        if self.judge.task is Task.ORIENTATION or not self.judge.revolute.all():
            return
        far = outward(self.poses[:FAR_POSES], self.judge.kinematics.size)
        count = target.inverse(far, np.zeros((len(far), self.samples.q.shape[1])))[1]
        self.ledger.count(FAR_LAW, target.name, len(far), int((count != 0).sum()))

    def _batch(self, target: SingleSolver, q: Floats) -> None:
        reference = np.where(self.judge.kinematics.free, 0.0, q)
        single, count = target.inverse(self.poses, reference)
        batch, batch_count, solved = target.inverse_batch(self.poses, reference)
        there = np.arange(single.shape[1]) < count[:, None]
        wrong = (batch_count != count) | (there & ~(self._gaps(batch, single) <= BATCH)).any(axis=1)
        cases = np.array(list(malformed(self.poses[0]).values()))
        answered = target.inverse_batch(cases, reference[: len(cases)])[1] >= 0
        turning = self.judge.revolute & self.judge.kinematics.free
        every = np.concatenate([q, q[:TURNED] * np.where(turning, MANY_TURNS, 1.0)])
        one, many = target.forward(every), target.forward_batch(every)
        apart = ~(self._apart(many, one) <= FORWARD)
        tried = len(q) + len(cases) + len(every)
        failed = int(wrong.sum() + answered.sum() + apart.sum()) + (solved != int((batch_count > 0).sum()))
        self.ledger.count(BATCH_LAW, target.name, tried, failed)

    def _apart(self, poses: Floats, wanted: Floats) -> Floats:
        """The largest difference of poses (m, 4, 4), lengths in units of the arm or, far away, of the position."""
        errors = np.abs(poses - wanted)
        errors[:, :3, 3] /= np.maximum(np.abs(wanted[:, :3, 3]).max(axis=1, keepdims=True), self._length)
        return np.asarray(errors.max(axis=(1, 2)), dtype=np.float64)

    def _least(self, q: Floats) -> Floats:
        """The least singular value of the task's Jacobian at joint vectors (..., n), lengths in units of the arm."""
        kinematics = self.judge.kinematics
        at = np.where(np.isfinite(q), q, 0.0)
        slope = task_jacobian(kinematics.jacobian(at), kinematics.forward(at), self.judge.task, kinematics.size)
        free = kinematics.free
        values = np.linalg.svd((slope * self._unit)[..., free], compute_uv=False)
        return np.asarray(values[..., -1], dtype=np.float64)

    def _gaps(self, left: Floats, right: Floats) -> Floats:
        """The largest difference of joint vectors (..., n), whole turns aside; infinite where one is none."""
        with np.errstate(invalid="ignore"):
            gaps = (np.abs(wrapped(left - right, self.judge.revolute)) / self._unit).max(axis=-1)
        return np.where(np.isnan(gaps), np.inf, gaps)

    @property
    def _unit(self) -> Floats:
        return np.where(self.judge.revolute, 1.0, self._length)

    @property
    def _length(self) -> float:
        return self.judge.kinematics.size if self.judge.kinematics.size > 0 else 1.0
