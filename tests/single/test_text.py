"""The pass over the tokens of C: what becomes single precision and what stays as it is."""

from __future__ import annotations

import re
import struct
import subprocess
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import cast

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinsym.check.compiler import FLAGS, find_compiler
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.real import DOUBLE, SINGLE
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.single import FUNCTIONS, in_single, literal, single
from kinsym.errors import DoesNotApply, KinsymError, RobotError
from kinsym.general.plan import GeneralPlan
from kinsym.robot import from_inline
from tests import arms
from tests.emit.atan_polynomial import least_error_polynomial
from tests.hygiene.building import quiet
from tests.single.arms import ARMS, single_schedule

_COMMENTS = re.compile(r"/\*.*?\*/|\"[^\"]*\"", re.DOTALL)


def read(text: str) -> float:
    """A literal as a compiler reads it."""
    return struct.unpack("<f", struct.pack("<f", float(text.rstrip("f"))))[0]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("double x = 1.0;", "float x = 1.0f;"),
        ("x = fabs(y) + 2 * i - .5 + 1e-9 + 3.;", "x = fabsf(y) + 2 * i - .5f + 1e-9f + 3.f;"),
        ("/* a double of 1.0 */ \"sqrt(1.0)\" '.'", "/* a double of 1.0 */ \"sqrt(1.0)\" '.'"),
        ("#include <math.h>\n#define TURN 6.283185307179586", "#include <math.h>\n#define TURN 6.2831855f"),
        ("doubled = my_sqrt(x1.y) + 0x1F + 3u + 1.0f", "doubled = my_sqrt(x1.y) + 0x1F + 3u + 1.0f"),
        ("q[2][1] = -HUGE_VAL + (double)NAN;", "q[2][1] = -HUGE_VALF + (float)NAN;"),
        ("p->l2.sqrt_of; /* * / 1.0 /* */ 1.0", "p->l2.sqrt_of; /* * / 1.0 /* */ 1.0f"),
    ],
)
def test_tokens(text: str, wanted: str) -> None:
    assert single(text) == wanted
    assert single(wanted) == wanted


@given(st.floats(allow_nan=False, allow_infinity=False, width=32).filter(lambda x: x == 0 or abs(x) >= 2.0**-126))
def test_a_float_is_printed_as_itself(value: float) -> None:
    assert read(literal(repr(abs(value)))) == abs(value)


@given(st.floats(min_value=2.0**-126, max_value=3.4e38))
def test_a_double_becomes_the_nearest_float(value: float) -> None:
    assert read(literal(repr(value))) == read(repr(value))


@pytest.mark.parametrize("number", ["1e39", "3.5e38", "1e-39", "4.9e-324", "1e400"])
def test_what_no_float_holds_is_refused(number: str) -> None:
    with pytest.raises(KinsymError, match=r"outside the range of single precision\. Use another unit"):
        literal(number)


def test_a_length_that_no_float_holds_is_refused() -> None:
    robot = from_inline("0 l1 0 theta1; 0 l2 0 theta2", convention="paul", name="two")
    arm = build_schedule(derive(replace(robot, parameters={"l1": Fraction(10) ** 60, "l2": Fraction(1)})))
    with pytest.raises(KinsymError, match=r"1e\+60 is outside the range of single precision"):
        TARGETS["c"](in_single(arm))


@pytest.mark.parametrize("name", ["sqrtf", "atan2f", "HUGE_VALF"])
def test_words_of_float_are_no_names(name: str) -> None:
    arm = build_schedule(derive(from_inline(f"0 {name} 0 theta1; 0 a2 0 theta2", convention="paul", name="two")))
    assert TARGETS["c"](arm)
    with pytest.raises(RobotError, match=f"two: the name {name} is a word of C in single precision"):
        in_single(arm)


def test_the_polynomial_of_an_arm_without_a_closed_form_needs_double_precision() -> None:
    general = replace(_double("planar_rr"), general=cast(GeneralPlan, object()))
    with pytest.raises(DoesNotApply, match=r"planar_rr .* needs double precision.*Leave --real float out"):
        in_single(general)


@pytest.mark.parametrize("name", ARMS)
def test_no_compiler_warns(name: str, tmp_path: Path) -> None:
    for file, text in TARGETS["c"](single_schedule(name)).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    (tmp_path / "includes.cpp").write_text(f'#include "{name}.h"\n', encoding="utf-8")
    assert "-Wdouble-promotion" in FLAGS
    assert "-Wconversion" in FLAGS
    assert quiet(single_schedule(name), tmp_path) >= 4


@pytest.mark.parametrize("name", ARMS)
def test_nothing_is_double(name: str, tmp_path: Path) -> None:
    """Neither a word of the source nor a function that the compiled code calls; the other type is not touched."""
    arm = single_schedule(name)
    texts = TARGETS["c"](arm)
    for file, text in texts.items():
        code = _COMMENTS.sub("", text)
        assert not re.search(r"\bdouble\b|\bHUGE_VAL\b", code)
        assert not re.search(r"(?<![\w.])(?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])", code)
        (tmp_path / file).write_text(text, encoding="utf-8")
    assert "Single precision" in texts[f"{name}.h"]
    compiler = find_compiler()
    if compiler is not None:
        subprocess.run([compiler, "-std=c99", "-O1", "-c", f"{name}.c", "-o", "a.o"], cwd=tmp_path, check=True)
        listed = subprocess.run(["nm", "-u", "a.o"], cwd=tmp_path, check=True, capture_output=True, text=True).stdout
        assert not FUNCTIONS.intersection(listed.split())
    assert TARGETS["c"](replace(arm, real=DOUBLE)) == TARGETS["c"](_double(name))


def _double(name: str) -> Schedule:
    return build_schedule(arms.derivation(name))


def test_numbers_that_belong_to_a_type() -> None:
    """Parts of pi are exact in the bits that are said of them, and each type's sum is pi to its digits."""
    with mpmath.workdps(40):
        for real, digits in ((DOUBLE, 53), (SINGLE, 24)):
            first, second, third = map(mpmath.mpf, map(float, real.quarter))
            for part in (first, second):
                mantissa, _ = mpmath.frexp(part)
                assert mantissa * 2**real.quarter_bits == int(mantissa * 2**real.quarter_bits)
            assert abs(first + second + third - mpmath.pi / 2) < mpmath.mpf(2) ** (-digits - 24)
            near, rest = map(mpmath.mpf, map(float, real.eighth))
            assert near * 2 ** (digits - 3) == int(near * 2 ** (digits - 3))
            assert abs(near + rest - mpmath.pi / 4) < mpmath.mpf(2) ** (-digits - 20)
            assert real.whole == repr(1.5 * 2.0**real.whole_bits)
            assert float(real.epsilon) == pytest.approx(2.0 ** (1 - digits), rel=1e-7)


@pytest.mark.parametrize("real", [DOUBLE, SINGLE], ids=lambda real: real.name)
def test_the_arc_tangent_has_the_polynomial_of_its_type(real) -> None:
    wanted, worst = least_error_polynomial(len(real.arctangent))
    assert [float(value) for value in real.arctangent[::-1]] == pytest.approx(wanted, rel=1e-12)
    assert worst == pytest.approx(float(real.arctangent_text[1]), rel=0.05)
