"""A solution without the elimination, with 50 digits, for a pose that a whole curve of joint vectors reaches.

There the determinant vanishes at every angle and tells nothing. The Levenberg-Marquardt method, damped by the square of
the distance that is left, goes to the curve from nearly anywhere.
"""

from __future__ import annotations

from kinsym.check.linear import Matrix, Value, Vector
from kinsym.check.newton import Newton
from kinsym.general.tables import DESCENT, STARTS, STRIDES

NEAR = 1e-3


def descended(newton: Newton, rows: Matrix, length: Value) -> list[Vector]:
    """The first solution that is met of a pose (three rows of four), as a list; empty if no start leads to one."""
    for number in range(1, STARTS + 1):
        near = _near(newton, _start(newton, number, length), rows, length)
        polished = None if near is None else newton.polished(near, rows, length)
        if polished is not None:
            return [polished]
    return []


def _start(newton: Newton, number: int, length: Value) -> Vector:
    """Where the code starts too: angles all round, lengths up to twice the arm's."""
    ctx = newton.ctx
    shares = [2 * (number * ctx.mpf(stride) % 1) - 1 for stride in STRIDES]
    return [share * (2 * length if kind == "P" else ctx.pi) for share, kind in zip(shares, newton.kinds, strict=False)]


def _near(newton: Newton, q: Vector, rows: Matrix, length: Value) -> Vector | None:
    """Joint values from which Newton's method reaches the pose, or None if the passes end before."""
    ctx = newton.ctx
    for _ in range(DESCENT):
        reached = newton.forward(q)
        if newton.off(reached, rows, length) < NEAR:
            return q
        slope, error = newton.linearised(q, reached, rows, length)
        jacobian, missing = ctx.matrix(slope), ctx.matrix(error)
        damping = ctx.fdot(error, error) / 10 + ctx.mpf(NEAR) ** 4
        normal = jacobian.T * jacobian + damping * ctx.eye(len(q))
        q, _ = newton.advanced(q, list(ctx.cholesky_solve(normal, jacobian.T * missing)), length)
    return None
