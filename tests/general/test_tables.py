"""The constant tables do what their names say."""

from __future__ import annotations

from math import comb

import numpy as np

from kinsym.general.tables import (
    ARCS,
    DEGREE,
    LOCAL,
    OFFSET,
    SAMPLES,
    arc_table,
    chebyshev_points,
    local_table,
)


def bernstein(c: np.ndarray, u: float) -> float:
    n = len(c) - 1
    return sum(comb(n, i) * u**i * (1 - u) ** (n - i) * value for i, value in enumerate(c))


def wave(coefficients: np.ndarray, t: float) -> float:
    a0, *rest = coefficients
    pairs = zip(rest[::2], rest[1::2], strict=True)
    return a0 + sum(a * np.cos(k * t) + b * np.sin(k * t) for k, (a, b) in enumerate(pairs, start=1))


def test_an_arc_has_the_bernstein_form_of_the_wave() -> None:
    c = np.random.default_rng(1).normal(size=SAMPLES)
    form = np.array(arc_table()) @ c
    for u in (0.0, 0.3, 0.9, 1.0):
        v = np.tan(np.pi / (2 * ARCS)) * (2 * u - 1)
        assert np.isclose(bernstein(form, u), (1 + v * v) ** DEGREE * wave(c, 2 * np.arctan(v)), atol=1e-12)
    assert np.abs(arc_table()).max() < 1.4


def test_values_at_eleven_points_give_the_polynomial() -> None:
    c = np.random.default_rng(2).normal(size=LOCAL + 1)
    values = [bernstein(c, u) for u in chebyshev_points()]
    assert np.allclose(np.array(local_table()) @ values, c, atol=1e-12)


def test_sampling_starts_where_no_symmetric_arm_is_singular() -> None:
    angles = (OFFSET + 2 * np.pi * np.arange(SAMPLES) / SAMPLES) % (np.pi / 2)
    assert np.minimum(angles, np.pi / 2 - angles).min() > 1e-3
