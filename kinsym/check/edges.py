"""The laws on both sides of the borders of the workspace, where roots merge, are in doubt and are parted again.

Joint vectors alone give no pose outside, and few that are inside by less than roots are told apart. The depths follow
the tolerances of the generated code: below tau two roots are one, up to 4 tau outside a root is on its pose, up to
10^-12 it is kept if it is in doubt, up to NEAR tau it is made sure of.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kinsym.check.borders import borders, moved
from kinsym.check.laws import CLOSURE, SAME, Judge
from kinsym.check.ledger import Ledger
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Floats, Solutions, Solver
from kinsym.robot.model import Task

EDGE_LAW = "solved on both sides of a border"
EDGE_AGREE_LAW = "same numbers of solutions on both sides of a border"
ROUGH_LAW = "same solutions of poses known to seven digits"

#: In units of the arm; inside, then outside.
INSIDE = (1.7e-14, 3e-14, 1.5e-13, 6e-13, 1e-11, 1e-9, 1e-7, 1e-5)
OUTSIDE = (3e-14, 1.5e-13, 6e-13, 5e-12, 3e-11, 3e-10, 1e-8, 1e-5)
#: Postures on borders of which all depths are tried, and the closure on a way between two vectors of one double root.
POSTURES, PATH = 6, 1e-8
#: At one in so many poses a band ends between two languages' roundings.
SHARE = 100


@dataclass(frozen=True, kw_only=True)
class Edges:
    """Poses (m, 4, 4) next to borders with references q (m, n); those ``inside`` (m,) have q among their solutions."""

    poses: Floats
    q: Floats
    inside: NDArray[np.bool_]


def edges(judge: Judge, task: Task, singular: Floats) -> Edges:
    """Those next to the first of the ``singular`` postures (k, n) that lie on borders; none if there is no border."""
    kinematics, n = judge.kinematics, singular.shape[1]
    edge = borders(kinematics, task, singular, judge.revolute) if len(singular) else None
    if edge is None or not len(edge.q):
        return Edges(poses=np.empty((0, 4, 4)), q=np.empty((0, n)), inside=np.empty(0, dtype=bool))
    rows = np.repeat(np.arange(min(POSTURES, len(edge.q))), len(INSIDE))
    within = wrapped(edge.inside(rows, np.resize(INSIDE, len(rows))), judge.revolute)
    deep = np.resize(OUTSIDE, len(rows))[:, None]
    beyond = moved(kinematics.forward(edge.q[rows]), edge.outward[rows] * deep, kinematics.size)
    return Edges(
        poses=np.concatenate([kinematics.forward(within), beyond]),
        q=np.concatenate([within, edge.q[rows]]),
        inside=np.arange(2 * len(rows)) < len(rows),
    )


def hold_edges(ledger: Ledger, target: Solver, judge: Judge, at: Edges) -> Solutions:
    """Every solution reaches its pose, none comes twice, and inside the known vector is found; returns the answer."""
    q, count = target.inverse(at.poses, at.q)
    closures = judge.closures(q, at.poses)
    broken = np.asarray(~((closures <= CLOSURE) | (np.arange(q.shape[1]) >= count[:, None])).all(axis=1))
    angles = q[..., judge.revolute & judge.kinematics.free]
    with np.errstate(invalid="ignore"):
        broken |= ((angles <= -np.pi) | (angles > np.pi)).any(axis=(1, 2))
    wide = replace(judge, path=max(judge.path, PATH))
    broken[at.inside] |= ~wide.found(q[at.inside], at.q[at.inside], at.poses[at.inside])
    if len(q):
        ledger.count(EDGE_LAW, target.name, len(q), int(broken.sum()) + judge.copies(q))
    return q, count


def hold_same_edges(ledger: Ledger, subject: str, left: Solutions, right: Solutions) -> None:
    """Two languages answer with the same numbers of solutions but for a few at the ends of a band."""
    if len(left[1]):
        _count(ledger, EDGE_AGREE_LAW, subject, left[1] != right[1])


def hold_same_rough(ledger: Ledger, subject: str, left: Solutions, right: Solutions, judge: Judge) -> None:
    """Two languages have the same solutions of poses whose rotations are known to few digits.

    A pose says less than its solutions then, and any of them near it would do; of the same equations they are the same.
    """
    (a, _), (b, _) = left, right
    with np.errstate(invalid="ignore"):
        apart = np.abs(wrapped(a - b, judge.revolute)).max(axis=-1)
    there = np.arange(a.shape[1]) < left[1][:, None]
    _count(ledger, ROUGH_LAW, subject, (left[1] != right[1]) | (there & ~(apart <= SAME)).any(axis=1))


def _count(ledger: Ledger, law: str, subject: str, other: NDArray[np.bool_]) -> None:
    failed = max(0, int(other.sum()) - 1 - len(other) // SHARE)
    ledger.count(law, subject, len(other), failed, limit=f"but for 1 in {SHARE}")
