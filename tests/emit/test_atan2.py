"""The arc tangent of the generated C: its polynomial, its error, its special values."""

from __future__ import annotations

import ctypes
import math
import re
import shutil
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import mpmath as mp
import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared, find_compiler
from kinsym.emit.environment import render
from kinsym.emit.real import DOUBLE
from tests.emit.atan_polynomial import least_error_polynomial
from tests.emit.built import PLAIN, needs_compiler

NAME = "angle"
ABOVE_MINUS_PI = math.nextafter(-math.pi, 0.0)
EXPORTED = f"""
#ifdef __cplusplus
extern "C" {{
#endif
double {NAME}_one(double s, double c);
double {NAME}_one(double s, double c) {{ return angle_of(s, c); }}
void {NAME}_many(const double *s, const double *c, double *angle, int n);
void {NAME}_many(const double *s, const double *c, double *angle, int n) {{ angles_of(s, c, angle, n); }}
#ifdef __cplusplus
}}
#endif
"""
OWN = {
    "as checked": FLAGS,
    "fast": ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math", *FLAGS[2:]),
    "c++": ("-x", "c++", "-std=c++17", *FLAGS[1:]),
}
LIBM = {"libm": (*FLAGS, f"-D{NAME.upper()}_LIBM_ATAN2")}
EDGES = [0.0, -0.0, 5e-324, -5e-324, 1e-300, -1e-300, 1.0, -1.0, 1e290, -1e290, math.inf, -math.inf, math.nan]


def source() -> str:
    """The function and the loop as a generated source holds them."""
    return render("c/atan2.c.jinja", macro=NAME.upper(), angles=True, core=PLAIN, real=DOUBLE)


@cache
def built(compiler: str, flags: tuple[str, ...]) -> ctypes.CDLL:
    """Both functions, exported."""
    with TemporaryDirectory() as folder:
        (Path(folder) / f"{NAME}.c").write_text(f"#include <math.h>\n{source()}{EXPORTED}", encoding="utf-8")
        library = ctypes.CDLL(str(compile_shared(folder, NAME, folder, compiler=compiler, flags=flags)))
    one, many = getattr(library, f"{NAME}_one"), getattr(library, f"{NAME}_many")
    one.restype, one.argtypes = ctypes.c_double, [ctypes.c_double] * 2
    many.restype, many.argtypes = None, [ctypes.c_void_p] * 3 + [ctypes.c_int]
    return library


@pytest.fixture(params=["gcc", "clang"])
def compiler(request: pytest.FixtureRequest) -> str:
    """Each compiler that is there."""
    if shutil.which(request.param) is None:
        pytest.skip(f"{request.param} is not installed")
    return str(request.param)


def angles(library: ctypes.CDLL, s: np.ndarray, c: np.ndarray) -> np.ndarray:
    """The angles of many sines and cosines by the loop."""
    s, c, result = np.array(s, dtype=float), np.array(c, dtype=float), np.full(len(s) + 1, 7.0)
    getattr(library, f"{NAME}_many")(s.ctypes, c.ctypes, result.ctypes, len(s))
    assert result[-1] == 7.0
    return result[:-1]


def pairs(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Sines and cosines over nine decades, on and beside the lines where the octants and their halves meet."""
    random = np.random.default_rng(11)
    anywhere = random.uniform(-1.0, 1.0, (2, count)) * 10.0 ** random.uniform(-9.0, 0.0, (2, count))
    turns = random.integers(-8, 9, count) * (np.pi / 8) + random.normal(size=count) * 10.0 ** random.uniform(
        -17.0, -1.0, count
    )
    s, c = np.hstack([anywhere, [np.sin(turns), np.cos(turns)]])
    return s, c


def test_the_polynomial_is_the_best_one() -> None:
    coefficients, error = least_error_polynomial()
    assert error < 1.3e-18
    lines = re.findall(r"(?:even|odd) =(?: \w+ \* zz)? ?([-+]? ?[\d.]+)(?=[;,])", source())
    assert [float(text.replace(" ", "")) for text in lines] == coefficients[::-1]


@needs_compiler
@pytest.mark.parametrize("flags", OWN.values(), ids=OWN)
def test_within_three_units_in_the_last_place(compiler: str, flags: tuple[str, ...]) -> None:
    library = built(compiler, flags)
    s, c = pairs(2000)
    loop = angles(library, s, c)
    with mp.workdps(40):
        for sine, cosine, in_loop in zip(s, c, loop, strict=True):
            exact = mp.atan2(mp.mpf(float(sine)), mp.mpf(float(cosine)))
            alone = getattr(library, f"{NAME}_one")(sine, cosine)
            for angle in (alone, float(in_loop)):
                assert -math.pi < angle <= math.pi
                assert abs(angle - exact) <= 3 * math.ulp(angle)


@needs_compiler
@pytest.mark.parametrize("flags", [*OWN.values(), *LIBM.values()], ids=[*OWN, *LIBM])
def test_zeros_infinities_and_what_is_no_number(compiler: str, flags: tuple[str, ...]) -> None:
    library = built(compiler, flags)
    s, c = np.array(EDGES).repeat(len(EDGES)), np.tile(EDGES, len(EDGES))
    for sine, cosine, angle in zip(s, c, angles(library, s, c), strict=True):
        expected = math.atan2(sine + 0.0, cosine + 0.0)
        expected = ABOVE_MINUS_PI if expected == -math.pi else expected
        assert angle == pytest.approx(expected, abs=1e-15, nan_ok=True)


@needs_compiler
def test_a_macro_takes_the_function_of_the_library() -> None:
    library = built(find_compiler() or "cc", LIBM["libm"])
    s, c = pairs(200)
    expected = np.array([math.atan2(*pair) for pair in zip(s, c, strict=True)])
    expected[expected == -math.pi] = ABOVE_MINUS_PI
    np.testing.assert_array_equal(angles(library, s, c), expected)
