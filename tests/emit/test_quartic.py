"""The kernel with four roots: |(X, Y)| = |(K, L)| for four lines p cos + q sin + r, in both languages and exactly."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import needs_compiler
from tests.emit.kernel_calls import FREE, Roots, T, exactly, in_c, in_numpy

NAMES = KERNELS["quartic"].inputs[:12]
ONE, COSINE, SINE = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
NOTHING = (0.0, 0.0, 0.0)
Line = tuple[float, float, float]
Lines = tuple[Line, Line, Line, Line]
Kernel = Callable[[Lines], Roots]


def inputs(lines: Lines, again: Lines | None = None) -> dict[str, float]:
    """The arguments of the kernel; the second statement is the first if there is no other."""
    values, others = (np.ravel(part).tolist() for part in (lines, again or lines))
    named = zip((*NAMES, *(f"{name}2" for name in NAMES)), [*values, *others], strict=True)
    return {**dict(named), "t": T, "t2": T}


def _exactly(lines: Lines) -> Roots:
    return exactly("quartic", **inputs(lines))


def _with(function: Callable[..., Roots]) -> Kernel:
    return lambda lines: function("quartic", **inputs(lines))


@pytest.fixture(
    params=[
        pytest.param(_with(in_c), id="c", marks=needs_compiler),
        pytest.param(_with(in_numpy), id="numpy"),
        pytest.param(_exactly, id="exact"),
    ]
)
def kernel(request: pytest.FixtureRequest) -> Kernel:
    """The kernel in each language."""
    return request.param


def angles(roots: Roots) -> list[float]:
    """The angles of roots; each is a point of the unit circle."""
    for c, s in roots:
        assert abs(math.hypot(c, s) - 1.0) < 1e-15 * 4
    return [math.atan2(s, c) for c, s in roots]


def line(scale: float, part: Line, constant: float = 0.0) -> Line:
    """``scale * part + constant``."""
    p, q, r = part
    return scale * p, scale * q, scale * r + constant


def turned(lines: Lines, by: float) -> Lines:
    """The same lines over an angle that is larger by ``by``."""
    c, s = math.cos(by), math.sin(by)
    return tuple((p * c - q * s, p * s + q * c, r) for p, q, r in lines)  # type: ignore[return-value]


def test_four_roots_in_order(kernel: Kernel) -> None:
    """cos + 0.2 = ±0.5."""
    roots = kernel((line(1.0, COSINE, 0.2), NOTHING, line(0.5, ONE), NOTHING))
    first, second = math.acos(0.3), math.acos(-0.7)
    assert angles(roots) == pytest.approx([-second, -first, first, second], abs=1e-15)


def test_two_roots_and_none(kernel: Kernel) -> None:
    """cos + 0.8 = ±0.5 has two real roots, cos + 2 = ±0.5 has none."""
    assert angles(kernel((line(1.0, COSINE, 0.8), NOTHING, NOTHING, line(0.5, ONE)))) == pytest.approx(
        [-math.acos(-0.3), math.acos(-0.3)], abs=1e-15
    )
    assert kernel((line(1.0, COSINE, 2.0), NOTHING, line(0.5, ONE), NOTHING)) == []


@pytest.mark.parametrize(
    ("outside", "count"), [(0.0, 2), (0.5 * T, 2), (-0.5 * T, 2), (-3.0 * T, 4), (3.0 * T, 0), (1e-6, 0), (-1e-6, 4)]
)
def test_border(kernel: Kernel, outside: float, count: int) -> None:
    """|cos| = 1 + outside: double roots at 0 and pi within the tolerance of the length, pi among them."""
    found = angles(kernel((COSINE, NOTHING, line(1.0 + outside, ONE), NOTHING)))
    assert len(found) == count
    if count == 2:
        assert [abs(angle) for angle in found] == pytest.approx([0.0, math.pi], abs=4.0 * T)
    if count == 4:
        half = math.acos(1.0 + outside)
        assert found == pytest.approx([half - math.pi, -half, half, math.pi - half], abs=1e-9)


@pytest.mark.parametrize("at", np.linspace(-math.pi, math.pi, 25)[1:])
def test_no_angle_is_lost(kernel: Kernel, at: float) -> None:
    """A simple and a double root anywhere on the circle, also where tan(theta/2) is infinite."""
    simple = kernel(turned((SINE, NOTHING, line(0.5, ONE), NOTHING), at))
    assert len(simple) == 4
    for c, s in simple:
        assert abs(abs(s * math.cos(at) - c * math.sin(at)) - 0.5) < 1e-15
    double = kernel(turned((COSINE, NOTHING, ONE, NOTHING), at))
    assert sorted(abs(c * math.cos(at) + s * math.sin(at)) for c, s in double) == pytest.approx([1.0, 1.0], abs=1e-15)
    assert len(double) == 2


def test_roots_that_meet_in_threes_and_fours(kernel: Kernel) -> None:
    """(1 - cos)^2 = 0 is one root; sin (1 - cos) = 0 is one at 0 and one at pi."""
    assert angles(kernel((line(1.0, COSINE, -1.0), NOTHING, NOTHING, NOTHING))) == pytest.approx([0.0], abs=1e-6)
    lines = ((-0.5, 0.5, 0.5), NOTHING, (0.5, 0.5, -0.5), NOTHING)
    found = angles(kernel(lines))
    assert [abs(angle) for angle in found] == pytest.approx([0.0, math.pi], abs=1e-4)


@pytest.mark.parametrize("small", [1e-3, 1e-6, 1e-9, 3e-12])
def test_short_vectors_keep_their_digits(kernel: Kernel, small: float) -> None:
    """|sin| = small: all coefficients are of size one, yet both vectors are short; squares would lose the roots."""
    found = angles(kernel((line(small, ONE), NOTHING, SINE, NOTHING)))
    angle = math.asin(small)
    assert sorted(found) == pytest.approx([angle - math.pi, -angle, angle, math.pi - angle], abs=1e-15)


def test_free(kernel: Kernel) -> None:
    """Vectors that are equally long at every angle, up to the tolerance."""
    assert kernel((COSINE, SINE, ONE, NOTHING)) == [pytest.approx(FREE)]
    assert kernel((line(1.0 + 0.1 * T, COSINE), SINE, NOTHING, ONE)) == [pytest.approx(FREE)]
    assert kernel((NOTHING, NOTHING, NOTHING, NOTHING)) == [pytest.approx(FREE)]


@pytest.mark.parametrize("bad", [math.nan, math.inf, 1e200])
@pytest.mark.parametrize("language", [pytest.param(in_c, id="c", marks=needs_compiler), in_numpy])
def test_no_root_of_what_is_no_number(language: Callable[..., Roots], bad: float) -> None:
    assert _with(language)((line(1.0, COSINE, bad), NOTHING, ONE, NOTHING)) == []


def by_eigenvalues(lines: Lines) -> list[float]:
    """The roots as eigenvalues: with z = e^(i theta) the equation is a polynomial of degree four in z."""
    total = np.zeros(5, dtype=complex)
    for sign, (p, q, r) in zip((1, 1, -1, -1), lines, strict=True):
        harmonic = np.array([(p + 1j * q) / 2, r, (p - 1j * q) / 2])
        total += sign * np.polymul(harmonic, harmonic)
    roots = np.roots(total[::-1])
    return sorted(float(x) for x in np.angle(roots[np.abs(np.abs(roots) - 1.0) < 1e-7]))


def test_against_eigenvalues(kernel: Kernel) -> None:
    """Random lines: the same roots as a companion matrix finds."""
    random = np.random.default_rng(5)
    counts = set()
    for _ in range(150):
        lines = tuple(map(tuple, random.normal(size=(4, 3)).tolist()))
        wanted = by_eigenvalues(lines)
        assert angles(kernel(lines)) == pytest.approx(wanted, abs=1e-7)
        counts.add(len(wanted))
    assert counts == {0, 2, 4}


@pytest.mark.parametrize("language", [pytest.param(in_c, id="c", marks=needs_compiler), in_numpy])
@pytest.mark.parametrize("factor", [1.0, -7.0])
def test_the_statement_with_short_vectors_decides(language: Callable[..., Roots], factor: float) -> None:
    """small^2 - sin^2 as (1 - sin^2) - (1 - small^2), which has lost small^2, and as it stands, times a constant."""
    small = 1e-9
    long = (COSINE, NOTHING, line(math.sqrt(1.0 - small * small), ONE), NOTHING)
    size = math.sqrt(abs(factor))
    short = (line(size * small, ONE), NOTHING, line(size, SINE), NOTHING)
    again = short if factor > 0 else (short[2], short[3], short[0], short[1])
    for one, two in ((long, again), (again, long)):
        found = sorted(angles(language("quartic", **inputs(one, two))))
        assert found == pytest.approx([small - math.pi, -small, small, math.pi - small], abs=1e-15)


@pytest.mark.parametrize("language", [pytest.param(in_c, id="c", marks=needs_compiler), in_numpy])
def test_a_second_statement_that_says_nothing_is_left_out(language: Callable[..., Roots]) -> None:
    nothing = (COSINE, SINE, ONE, NOTHING)
    lines = (line(1.0, COSINE, 0.2), NOTHING, line(0.5, ONE), NOTHING)
    assert language("quartic", **inputs(lines, nothing)) == language("quartic", **inputs(lines))
