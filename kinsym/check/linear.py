"""Determinants, null vectors and roots of polynomials with 50 digits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Value = Any
Vector = list[Value]
Matrix = list[list[Value]]

#: Sampling starts where no symmetric arm is singular.
START = 0.2718
#: Roots nearer to the unit circle than this may stand for real angles.
NEARLY_REAL = 1e-3
NEARLY_NULL = 1e-3
ROUNDS = 40


def determinant(ctx: Any, rows: Matrix) -> Value:
    """The determinant, by elimination with row pivoting; the rows are used up."""
    value = ctx.one
    while rows:
        pivot = max(range(len(rows)), key=lambda i: abs(rows[i][0]))
        if not rows[pivot][0]:
            return ctx.zero
        if pivot:
            rows[0], rows[pivot], value = rows[pivot], rows[0], -value
        first, *rest = rows
        value *= first[0]
        rows = []
        for row in rest:
            factor = row[0] / first[0]
            rows.append([a - factor * b for a, b in zip(row[1:], first[1:], strict=True)] if factor else row[1:])
    return value


def null_vectors(ctx: Any, rows: Matrix) -> tuple[Vector, Vector, bool]:
    """The two vectors a square matrix makes smallest, and whether only the first of them is nearly a null vector."""
    size = len(rows)
    order = list(range(size))
    for done in range(size - 1):
        pivot = max(
            ((i, j) for i in range(done, size) for j in range(done, size)),
            key=lambda place: abs(rows[place[0]][place[1]]),
        )
        rows[done], rows[pivot[0]] = rows[pivot[0]], rows[done]
        if pivot[1] != done:
            order[done], order[pivot[1]] = order[pivot[1]], order[done]
            for row in rows:
                row[done], row[pivot[1]] = row[pivot[1]], row[done]
        if not rows[done][done]:
            break
        for i in range(done + 1, size):
            factor = rows[i][done] / rows[done][done]
            if factor:
                rows[i] = [
                    a - factor * b if j > done else ctx.zero
                    for j, (a, b) in enumerate(zip(rows[i], rows[done], strict=True))
                ]
    vectors = []
    for free in (size - 1, size - 2):
        y = [ctx.zero] * size
        y[free] = ctx.one
        for k in range(free - 1, -1, -1):
            y[k] = -ctx.fdot(rows[k][k + 1 :], y[k + 1 :]) / rows[k][k] if rows[k][k] else ctx.zero
        vector = [ctx.zero] * size
        for place, value in zip(order, y, strict=True):
            vector[place] = value
        vectors.append(vector)
    return vectors[0], vectors[1], abs(rows[-2][-2]) > NEARLY_NULL * abs(rows[0][0])


def circle_roots(ctx: Any, function: Callable[[Value, Value], Value], degree: int) -> list[Value]:
    """The angles at which a trigonometric polynomial of the cosine and the sine vanishes, or nearly does."""
    count = 2 * degree + 1
    turn = 2 * ctx.pi / count
    points = [(ctx.cos(j * turn), ctx.sin(j * turn)) for j in range(count)]
    c0, s0 = ctx.cos(START), ctx.sin(START)
    values = [function(c * c0 - s * s0, s * c0 + c * s0) for c, s in points]
    if not any(values):
        return []
    coefficients = []
    for k in range(degree, -degree - 1, -1):
        waves = [points[(j * k) % count] for j in range(count)]
        coefficients.append(ctx.mpc(ctx.fdot(values, [c for c, _ in waves]), -ctx.fdot(values, [s for _, s in waves])))
    return [START + ctx.arg(z) for z in all_roots(ctx, coefficients) if abs(abs(z) - 1) < NEARLY_REAL]


def all_roots(ctx: Any, coefficients: Vector) -> list[Value]:
    """All complex roots of a polynomial, highest power first: Aberth's method from those of its companion matrix."""
    import numpy as np

    size = max(abs(value) for value in coefficients)
    starts = np.roots([complex(value / size) for value in coefficients])
    roots = [ctx.mpc(z.real, z.imag) for z in starts.tolist()]
    degree = len(coefficients) - 1
    slopes = [value * (degree - k) for k, value in enumerate(coefficients[:-1])]
    active = set(range(len(roots)))
    for _ in range(ROUNDS):
        for k in sorted(active):
            z = roots[k]
            value, slope = _horner(ctx, coefficients, z), _horner(ctx, slopes, z)
            if not value or not slope:
                active.discard(k)
                continue
            newton = value / slope
            pull = ctx.fsum(1 / (z - other) for n, other in enumerate(roots) if n != k and other != z)
            step = newton / (1 - newton * pull)
            roots[k] = z - step
            if abs(step) < 1e-15 * max(1, abs(z)):
                active.discard(k)
        if not active:
            break
    return roots


def _horner(ctx: Any, coefficients: Vector, z: Value) -> Value:
    value = ctx.zero
    for coefficient in coefficients:
        value = value * z + coefficient
    return value
