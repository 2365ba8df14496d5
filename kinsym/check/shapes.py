"""The law of shapes: one joint vector or pose, many, and a table of them have the same answers, in their shapes."""

from __future__ import annotations

from typing import Any

import numpy as np

from kinsym.check.batch import SINGLE_LIMIT
from kinsym.check.laws import SAME
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Floats

SHAPE_LAW = "one, many and a table of them have the same answers"
#: The shape of the table, and so many joint vectors are asked for.
TABLE = (2, 2)


def hold_shapes(ledger: Ledger, target: NumpySolver, *, poses: Floats, q: Floats, general: bool) -> None:
    """``poses`` (m, 4, 4) are ordinary ones of ``q`` (m, n), four at least.

    A ``general`` solver is iterative, and the order in which a block is summed up is NumPy's own: its answers are
    compared less finely.
    """
    number, limit = int(np.prod(TABLE)), SAME if general else SINGLE_LIMIT
    module, poses, q = target.module, poses[:number], q[:number]
    values, given = target.parameters, target.given(q)
    table = {name: np.reshape(value, TABLE) if np.ndim(value) else value for name, value in given.items()}
    first = {name: value[0] if np.ndim(value) else value for name, value in given.items()}
    shaped, wrong, tried = (*TABLE, q.shape[1]), 0, 0
    for call in (module.fk, module.jacobian):
        many = np.asarray(call(q, **values))
        wrong += not _same(call(q.reshape(shaped), **values), many.reshape(*TABLE, *many.shape[1:]), SINGLE_LIMIT)
        wrong += not _same(call(q[0], **values), many[0], SINGLE_LIMIT)
        tried += 2
    for reference, one, square in ((None, None, None), (q, q[0], q.reshape(shaped))):
        many = module.ik_batch(poses, reference=reference, **given)
        grid = module.ik_batch(poses.reshape(*TABLE, 4, 4), reference=square, **table)
        alone = module.ik_batch(poses[0], reference=one, **first)
        for whole, tabled, single in zip(many, grid, alone, strict=True):
            wrong += not _same(tabled, whole.reshape(*TABLE, *whole.shape[1:]), limit)
            wrong += not _same(single, whole[0], limit)
            tried += 2
    ledger.count(SHAPE_LAW, target.name, tried, wrong, limit=f"<= {limit:g}")


def _same(left: Any, right: Any, limit: float) -> bool:
    """Whether two arrays have one shape and nearly the same numbers, NaN at the same places."""
    left, right = np.asarray(left, dtype=np.float64), np.asarray(right, dtype=np.float64)
    scale = np.maximum(1.0, np.nan_to_num(np.abs(right)))
    return left.shape == right.shape and bool(np.isclose(left / scale, right / scale, 0, limit, equal_nan=True).all())
