"""The sine and the cosine of the batch functions."""

from __future__ import annotations

import ctypes
import math
import shutil
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import mpmath as mp
import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.emit.environment import render
from kinsym.emit.real import DOUBLE
from tests.emit.built import PLAIN

NAME = "wave"
FASTEST = ("-O3", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-fno-trapping-math", *FLAGS[2:])
FARTHEST = 10000.0


@cache
def built(compiler: str, flags: tuple[str, ...]) -> ctypes.CDLL:
    """Both functions over arrays."""
    loops = "".join(
        f"void many_{name}(const double *x, double *y, int n);\n"
        f"void many_{name}(const double *x, double *y, int n) "
        f"{{ for (int i = 0; i < n; ++i) {{ y[i] = lane_{name}(x[i]); }} }}\n"
        for name in ("sin", "cos")
    )
    with TemporaryDirectory() as folder:
        text = render("c/batch/wave.c.jinja", waves={"sin", "cos"}, core=PLAIN, real=DOUBLE)
        (Path(folder) / f"{NAME}.c").write_text(text + loops, encoding="utf-8")
        return ctypes.CDLL(str(compile_shared(folder, NAME, folder, compiler=compiler, flags=flags)))


def angles() -> np.ndarray:
    """Over the whole range and next to multiples of an eighth of a turn."""
    random = np.random.default_rng(12)
    eighths = random.integers(-12700, 12700, 1500) * (np.pi / 4)
    beside = random.normal(size=1500) * 10.0 ** random.uniform(-16.0, -1.0, 1500)
    anywhere = random.uniform(-4.0, 4.0, 1500), random.uniform(-FARTHEST, FARTHEST, 1500)
    return np.hstack([*anywhere, eighths + beside, 0.0])


def many(library: ctypes.CDLL, name: str, x: np.ndarray) -> np.ndarray:
    """The values of one function."""
    y = np.empty_like(x)
    getattr(library, f"many_{name}")(x.ctypes, y.ctypes, len(x))
    return y


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("flags", [FLAGS, FASTEST], ids=["as checked", "fastest"])
def test_within_two_units_in_the_last_place(compiler: str, flags: tuple[str, ...]) -> None:
    """Relative to the value itself, also where it nearly vanishes."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    x = angles()
    with mp.workdps(40):
        for name, exact in (("sin", mp.sin), ("cos", mp.cos)):
            for angle, value in zip(x, many(built(compiler, flags), name, x), strict=True):
                true = exact(mp.mpf(float(angle)))
                assert abs(value - true) <= 2.0 * math.ulp(float(true))


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_has_no_sine(value: float) -> None:
    if shutil.which("gcc") is None:
        pytest.skip("gcc is not installed")
    for name in ("sin", "cos"):
        assert np.isnan(many(built("gcc", FLAGS), name, np.array([value])))


def test_the_parts_of_a_quarter_turn() -> None:
    """Two of 33 bits, so that whole multiples up to 2^20 are exact, and the rest."""
    text = render("c/batch/wave.c.jinja", waves=set(), core=PLAIN, real=DOUBLE)
    parts = [1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21]
    assert all(repr(part) in text for part in parts)
    for part in parts[:2]:
        mantissa = math.frexp(part)[0] * 2.0**33
        assert mantissa == int(mantissa)
    with mp.workdps(60):
        assert abs(sum(map(mp.mpf, parts)) - mp.pi / 2) < 1e-36
