"""atan2, sine and cosine of the C in single precision, against double precision."""

from __future__ import annotations

import ctypes
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.emit.environment import render
from kinsym.emit.real import SINGLE
from kinsym.emit.source.single import single
from tests.emit.built import PLAIN, needs_compiler

pytestmark = needs_compiler

_HALF = np.float32(np.pi)
_LOOPS = """
void many_angle(const float *s, const float *c, float *angle, int n);
void many_angle(const float *s, const float *c, float *angle, int n) { angles_of(s, c, angle, n); }
void many_wave(const float *x, float *s, float *c, int n);
void many_wave(const float *x, float *s, float *c, int n)
{
    for (int i = 0; i < n; ++i) {
        s[i] = lane_sin(x[i]);
        c[i] = lane_cos(x[i]);
    }
}
"""


@cache
def built() -> ctypes.CDLL:
    """The functions over arrays."""
    names = {"core": PLAIN, "real": SINGLE}
    text = render("c/atan2.c.jinja", macro="ARM", angles=True, **names)
    text += render("c/batch/wave.c.jinja", waves={"sin", "cos"}, **names)
    with TemporaryDirectory() as folder:
        (Path(folder) / "many.c").write_text(f"#include <math.h>\n{single(text)}{_LOOPS}", encoding="utf-8")
        return ctypes.CDLL(str(compile_shared(folder, "many", folder, flags=FLAGS)))


def units(values: np.ndarray, exact: np.ndarray) -> np.ndarray:
    """The error in units of the last place."""
    return np.abs(values.astype(float) - exact) / np.spacing(np.abs(exact).astype(np.float32))


def angles(s: np.ndarray, c: np.ndarray) -> np.ndarray:
    result = np.empty_like(s)
    built().many_angle(s.ctypes, c.ctypes, result.ctypes, len(s))
    return result


def test_the_arc_tangent_is_within_three_units() -> None:
    random = np.random.default_rng(21)
    turns = random.integers(-8, 9, 20000) * (np.pi / 8) + random.normal(size=20000) * 10.0 ** random.uniform(
        -8, 0, 20000
    )
    sizes = 10.0 ** random.uniform(-18.0, 18.0, 20000)
    s, c = (sizes * np.sin(turns)).astype(np.float32), (sizes * np.cos(turns)).astype(np.float32)
    found = angles(s, c)
    assert units(found, np.arctan2(s.astype(float), c.astype(float))).max() <= 3.0
    assert (found > -_HALF).all()
    assert (found <= _HALF).all()


@pytest.mark.parametrize("s", [0.0, -0.0, 1e-45, -1e-45, 1.0, -1.0, 1e30, -1e30, np.inf, -np.inf, np.nan])
def test_ends_of_the_range(s: float) -> None:
    c = np.array([0.0, -0.0, 1e-45, -1e-45, 1.0, -1.0, 1e30, -1e30, np.inf, -np.inf, np.nan], dtype=np.float32)
    sines = np.full(len(c), s, dtype=np.float32)
    wanted = np.arctan2(sines.astype(float) + 0.0, c.astype(float) + 0.0)
    found = angles(sines, c)
    assert np.allclose(found, np.clip(wanted, -_HALF, _HALF), atol=1e-6, equal_nan=True)
    assert not (found <= -_HALF).any()


def test_sine_and_cosine_are_within_two_units_also_where_they_vanish() -> None:
    random = np.random.default_rng(22)
    eighths = random.integers(-127, 128, 20000) * (np.pi / 4)
    beside = random.normal(size=20000) * 10.0 ** random.uniform(-8.0, -1.0, 20000)
    x = np.concatenate([random.uniform(-100.0, 100.0, 20000), np.clip(eighths + beside, -100, 100)]).astype(np.float32)
    sine, cosine = np.empty_like(x), np.empty_like(x)
    built().many_wave(x.ctypes, sine.ctypes, cosine.ctypes, len(x))
    assert units(sine, np.sin(x.astype(float))).max() <= 2.0
    assert units(cosine, np.cos(x.astype(float))).max() <= 2.0
