"""The laws of functions for many poses: pose by pose they give what the functions for one pose give."""

from __future__ import annotations

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.laws import Judge, malformed
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Floats

SINGLE_LAW = "ik and ik_batch agree"
SINGLE_FORWARD_LAW = "fk and fk_batch agree"
SWEEP_LAW = "ik_sweep and ik_batch agree"
SINGLE_LIMIT = 1e-12

#: Angles so many times as large are left to the function for one joint vector.
MANY_TURNS = 1e5
TURNED = 5


def hold_batch(ledger: Ledger, target: CSolver, judge: Judge, *, poses: Floats, q: Floats, strange: Floats) -> None:
    """The same numbers of solutions, in the same order, whole turns aside.

    ``poses`` (m, 4, 4) are those of ``q`` (m, n), ``strange`` (k, 4, 4) poses that no joint vector made; free joints
    take 0 in both, joints that are held their value in q. None is refused; what is no pose is, among others. How many
    poses have a solution is told as well.
    """
    every, q = q, q[np.arange(len(poses) + len(strange)) % len(q)]
    poses = np.concatenate([poses, strange])
    reference = np.where(judge.kinematics.free, 0.0, q)
    single, count = target.inverse(poses, reference)
    batch, batch_count, reached = target.inverse_batch(poses, reference)
    found = np.arange(single.shape[1]) < count[:, None]
    with np.errstate(invalid="ignore"):  # a joint value that is not finite
        apart = np.abs(wrapped(batch - single, judge.revolute)).max(axis=-1)
    wrong = (batch_count != count) | (found & ~(apart <= SINGLE_LIMIT)).any(axis=1)
    cases = np.array(list(malformed(poses[0]).values()))
    answered = target.inverse_batch(cases, reference[: len(cases)])[1] >= 0
    tried, failed = len(q) + len(cases) + 1, int(wrong.sum() + answered.sum() + (reached != (count > 0).sum()))
    ledger.count(SINGLE_LAW, target.name, tried, failed, limit=f"<= {SINGLE_LIMIT:g}")
    far = every[:TURNED] * np.where(judge.revolute & judge.kinematics.free, MANY_TURNS, 1.0)
    every = np.concatenate([every, far])
    one, many = target.forward(every), target.forward_batch(every)
    scale = np.maximum(1.0, np.abs(one).max(axis=(1, 2)))
    missed = ~(np.abs(many - one).max(axis=(1, 2)) <= SINGLE_LIMIT * scale)
    ledger.count(SINGLE_FORWARD_LAW, target.name, len(every), int(missed.sum()), limit=f"<= {SINGLE_LIMIT:g}")


def hold_single(
    ledger: Ledger, solver: NumpySolver, judge: Judge, *, poses: Floats, reference: Floats, general: bool
) -> None:
    """``ik`` of each pose (m, 4, 4) with its reference (m, n); ``general`` is an arm without a closed form."""
    q, count = solver.inverse(poses, reference)
    wrong = 0
    for row, pose in enumerate(poses):
        single, batch = solver.single(pose, reference[row]), q[row, : count[row]]
        if single.shape == batch.shape:
            gap = wrapped(single - batch, judge.revolute)
            if np.all(np.abs(gap) <= SINGLE_LIMIT):
                continue
        wrong += not (general and _same_solutions(judge, single, batch, pose))
    ledger.count(SINGLE_LAW, solver.name, len(poses), wrong, limit=f"<= {SINGLE_LIMIT:g}")


def _same_solutions(judge: Judge, single: Floats, batch: Floats, pose: Floats) -> bool:
    """Whether two answers differ by rounding alone: the order in which a batch is summed up is NumPy's own."""
    left, right = (single[None], np.array([len(single)])), (batch[None], np.array([len(batch)]))
    return bool(judge.agreement(left, right, pose[None])[1][0])


def hold_sweep(ledger: Ledger, solver: NumpySolver, *, pose: Floats, q: Floats) -> None:
    """One pose (4, 4) over the values of the locked inputs in joint vectors (m, n): as many single calls."""
    swept, each = solver.sweep(pose, q), solver.inverse(np.repeat(pose[None], len(q), axis=0), q)
    same = np.isclose(swept[0], each[0], rtol=0, atol=SINGLE_LIMIT, equal_nan=True).all(axis=(1, 2))
    wrong = (swept[1] != each[1]) | ~same
    ledger.count(SWEEP_LAW, solver.name, len(q), int(wrong.sum()), limit=f"<= {SINGLE_LIMIT:g}")
