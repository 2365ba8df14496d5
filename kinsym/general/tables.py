"""The constant tables of the general solver, computed with 60 digits and rounded once to doubles.

Both languages print the same numbers. Angles of the Fourier form are counted from :data:`OFFSET`.
"""

from __future__ import annotations

from functools import cache
from math import comb

from mpmath import MPContext

DEGREE = 8
SAMPLES = 2 * DEGREE + 1
ARCS = 8
LOCAL = 10
"""Degree of the polynomial that replaces the determinant on a short interval."""

OFFSET = 0.1234567
"""Where sampling starts: symmetric arms are singular at 0 and pi."""

CHART = 0.7
"""Where x is counted from: symmetric arms have solutions at 0 and pi, which X = 0 and infinity must not be."""

BORDER_COLUMN = (0.53, -0.41, 0.67, 0.38, -0.59, 0.44, -0.36, 0.62, 0.49, -0.55, 0.33, -0.64)
BORDER_ROW = (0.47, -0.61, 0.35, 0.58, -0.39, 0.66)
"""Generic constants of the bordered determinant: the column beside M, the row below its columns X^2 W, X W."""

STRIDES = (0.414214, 0.732051, 0.236068, 0.645751, 0.316625, 0.605551)
"""Fractions of the square roots of 2, 3, 5, 7, 11, 13: their multiples fill a unit cube evenly (Richtmyer 1951)."""

STARTS, DESCENT = 32, 60
"""From how many points of the cube solutions are looked for where no determinant helps, and passes from each."""

Table = tuple[tuple[float, ...], ...]


def _context() -> MPContext:
    ctx = MPContext()
    ctx.dps = 60
    return ctx


@cache
def arc_table() -> Table:
    """(a0, a1, b1, ..., a8, b8) about an arc's centre to the 17 Bernstein coefficients of (1 + v^2)^8 f on it.

    v is the tangent of half the angle from the centre, -h <= v <= h, h = tan(pi/16). cos kt and sin kt times
    (1 + v^2)^8 are real and imaginary part of (1 + iv)^(2k) (1 + v^2)^(8-k). With v = h (2u - 1) the factors are
    polynomials in u on [0, 1], and their Bernstein coefficients multiply like those of binomials.
    """
    ctx = _context()
    h = ctx.tan(ctx.pi / (2 * ARCS))
    linear = [ctx.mpc(1, -h), ctx.mpc(1, h)]
    square = [1 + h * h, 1 - h * h, 1 + h * h]
    columns: list[list[object]] = []
    for k in range(DEGREE + 1):
        product = [ctx.mpc(1)]
        for _ in range(2 * k):
            product = _times(ctx, product, linear)
        for _ in range(DEGREE - k):
            product = _times(ctx, product, square)
        columns.append([value.real for value in product])
        if k:
            columns.append([value.imag for value in product])
    return _rounded([list(row) for row in zip(*columns, strict=True)])


def _times(ctx: MPContext, left: list, right: list) -> list:  # type: ignore[type-arg]
    """The product of two polynomials in Bernstein form on [0, 1]."""
    m, n = len(left) - 1, len(right) - 1
    result = [ctx.mpc(0)] * (m + n + 1)
    for i, a in enumerate(left):
        for j, b in enumerate(right):
            result[i + j] += a * b * comb(m, i) * comb(n, j) / ctx.mpf(comb(m + n, i + j))
    return result


@cache
def chebyshev_points() -> tuple[float, ...]:
    """The 11 points in (0, 1), increasing, at which the determinant is sampled on a short interval."""
    ctx = _context()
    return tuple(float(x) for x in _points(ctx))


def _points(ctx: MPContext) -> list:  # type: ignore[type-arg]
    n = LOCAL + 1
    return [(1 - ctx.cos(ctx.pi * (2 * j + 1) / (2 * n))) / 2 for j in range(n)]


@cache
def local_table() -> Table:
    """Values at the 11 points to Bernstein coefficients of degree 10 on [0, 1]."""
    ctx = _context()
    basis = ctx.matrix(
        [[comb(LOCAL, i) * x**i * (1 - x) ** (LOCAL - i) for i in range(LOCAL + 1)] for x in _points(ctx)]
    )
    return _rounded((basis**-1).tolist())


def _rounded(rows: list) -> Table:  # type: ignore[type-arg]
    return tuple(tuple(float(value) if abs(value) > 1e-40 else 0.0 for value in row) for row in rows)


@cache
def turns(count: int) -> Table:
    """Cosine and sine of the multiples of a turn divided by ``count``."""
    ctx = _context()
    angles = [2 * ctx.pi * k / count for k in range(count)]
    return _rounded([[ctx.cos(angle), ctx.sin(angle)] for angle in angles])


@cache
def direction(angle: float) -> tuple[float, ...]:
    """Cosine and sine of an angle, for example of :data:`OFFSET`."""
    ctx = _context()
    return float(ctx.cos(angle)), float(ctx.sin(angle))


@cache
def arc_end() -> float:
    """h, the tangent of a quarter of an arc: where v ends on it."""
    ctx = _context()
    return float(ctx.tan(ctx.pi / (2 * ARCS)))
