"""The numerical kernels of both languages, one by one: at ordinary inputs, on borders and where an unknown is free."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.emit.built import needs_compiler
from tests.emit.kernel_calls import (
    FREE,
    REFERENCE,
    Kernel,
    T,
    library,
    module,
)


@pytest.mark.parametrize(
    ("a", "b", "e", "count"),
    [
        (1.0, 0.0, 0.5, 2),
        (0.3, -0.4, -0.2, 2),
        (0.3, -0.4, 0.0, 2),
        (3.0, 4.0, 5.0, 1),  # border: r = 5
        (3.0, 4.0, -5.0, 1),
        (3.0, 4.0, 5.0 - 0.5 * T, 1),  # within the tolerance inwards
        (3.0, 4.0, 5.0 + 0.5 * T, 1),  # and outwards
        (3.0, 4.0, 5.0 - 3.0 * T, 2),
        (3.0, 4.0, 5.0 + 3.0 * T, 0),
        (1e-150, 0.0, 1.0, 0),  # no coefficient, a right side: no root
        (0.0, 0.0, 1.0, 0),
        (0.0, 0.0, 2.0 * T, 0),
        (0.9 * T, 0.0, 1.5 * T, 0),
        (math.nan, 1.0, 0.0, 0),
        (1.0, 1.0, math.nan, 0),
    ],
)
def test_linear(kernel: Kernel, a: float, b: float, e: float, count: int) -> None:
    roots = kernel("linear", a=a, b=b, e=e, t=T)
    assert len(roots) == count
    for c, s in roots:
        assert abs(c * c + s * s - 1.0) < 1e-11
        assert abs(a * c + b * s - e) <= 2.0 * T


def test_linear_order_and_free(kernel: Kernel) -> None:
    (first, second) = kernel("linear", a=1.0, b=0.0, e=0.5, t=T)
    assert first == pytest.approx((0.5, math.sqrt(0.75)))
    assert second == pytest.approx((0.5, -math.sqrt(0.75)))
    assert kernel("linear", a=0.5 * T, b=0.0, e=-0.5 * T, t=T) == [pytest.approx(FREE)]


@pytest.mark.parametrize("rule", ["homogeneous", "homogeneous2"])
def test_homogeneous(kernel: Kernel, rule: str) -> None:
    spare = {"a_alt": 1e-3, "b_alt": 0.0, "t_alt": T} if rule == "homogeneous2" else {}
    first, second = kernel(rule, a=3.0, b=4.0, t=T, **spare)
    assert first == pytest.approx((0.8, -0.6))
    assert second == pytest.approx((-0.8, 0.6))
    spare = {"a_alt": 0.0, "b_alt": 0.0, "t_alt": T} if spare else {}
    assert len(kernel(rule, a=0.0, b=2.0 * T, t=T, **spare)) == 2


def test_homogeneous_free(kernel: Kernel) -> None:
    assert kernel("homogeneous", a=0.0, b=0.5 * T, t=T) == [pytest.approx(FREE)]
    nothing = {"a": 0.0, "b": 0.5 * T, "t": T}
    free = kernel("homogeneous2", **nothing, a_alt=0.5, b_alt=0.0, t_alt=1.0)
    assert free == [pytest.approx(FREE)]


def test_homogeneous2_takes_the_pair_that_is_larger_in_its_tolerance(kernel: Kernel) -> None:
    roots = kernel("homogeneous2", a=1.0, b=0.0, t=1e-3, a_alt=0.0, b_alt=0.1, t_alt=1e-6)
    assert roots == [pytest.approx((1.0, 0.0)), pytest.approx((-1.0, 0.0))]
    roots = kernel("homogeneous2", a=1.0, b=0.0, t=1e-3, a_alt=0.0, b_alt=0.1, t_alt=1e-3)
    assert roots == [pytest.approx((0.0, -1.0)), pytest.approx((0.0, 1.0))]


@pytest.mark.parametrize(
    ("l1", "l2", "rho", "count"),
    [
        (0.7, 0.5, 0.9, 2),
        (-0.7, 0.5, 0.9, 2),
        (0.7, -0.5, 0.9, 2),
        (0.5, 0.7, 0.9, 2),
        (0.7, 0.5, 1.2, 1),  # stretched
        (0.7, 0.5, 1.2 + 0.4 * T, 1),
        (0.7, 0.5, 1.2 + 3.0 * T, 0),
        (0.7, 0.5, 1.2 - 3.0 * T, 2),
        (-0.7, 0.5, 1.2, 1),
        (0.7, 0.5, 0.2, 1),  # folded
        (0.5, 0.7, 0.2, 1),
        (-0.7, 0.5, 0.2, 1),
        (0.7, 0.5, 0.2 - 0.4 * T, 1),
        (0.7, 0.5, 0.2 - 3.0 * T, 0),
        (0.7, 0.5, 0.2 + 3.0 * T, 2),
        (0.6, 0.6, 0.0, 1),  # equal links folded on the base
        (0.6, 0.6, 0.5 * T, 1),
        (0.6, 0.6, 3.0 * T, 2),
        (0.7, 0.0, 0.7, 1),  # no second link: a circle
        (0.0, 0.5, 0.5, 0),  # no first link: no triangle
        (0.7, 0.5, math.nan, 0),
        (0.7, 0.5, 1e200, 0),
    ],
)
def test_triangle(kernel: Kernel, l1: float, l2: float, rho: float, count: int) -> None:
    x, y = 0.6 * rho, 0.8 * rho
    roots = kernel("triangle", x=x, y=y, l1=l1, l2=l2, t=T)
    assert len(roots) == count
    for k, w, along in roots:
        assert abs(math.hypot(k, w) - abs(l2)) < 1e-11
        assert abs(math.hypot(along, w) - rho) < 3.0 * T
        assert abs(along - l1 - k) < 3.0 * T * (1 if count == 1 else 10)
    if count == 1:
        assert roots[0][1] == 0.0
    if count == 2:
        assert roots[0][1] > 0.0 > roots[1][1]


def test_direction(kernel: Kernel) -> None:
    angle, along, across = 2.0, 0.3, -0.7
    x = math.cos(angle) * along - math.sin(angle) * across
    y = math.sin(angle) * along + math.cos(angle) * across
    (root,) = kernel("direction", x=x, y=y, along=along, across=across, t=T)
    assert root == pytest.approx((math.cos(angle), math.sin(angle)))
    (tiny,) = kernel("direction", x=x * 3e-12, y=y * 3e-12, along=along, across=across, t=T)
    assert tiny == pytest.approx((math.cos(angle), math.sin(angle)))
    assert kernel("direction", x=0.5 * T, y=0.5 * T, along=along, across=across, t=T) == [pytest.approx(FREE)]
    assert kernel("direction", x=1.0, y=2.0, along=0.0, across=0.0, t=T) == [pytest.approx(FREE)]


def test_quotient(kernel: Kernel) -> None:
    assert kernel("quotient", x=3.0, y=4.0, d=5.0, t=T) == [pytest.approx((0.6, 0.8))]
    assert kernel("quotient", x=3.0, y=4.0, d=-5.0, t=T) == [pytest.approx((-0.6, -0.8))]
    assert kernel("quotient", x=0.0, y=2.0 * T, d=1.0, t=T) == [pytest.approx((0.0, 1.0))]
    assert kernel("quotient", x=0.0, y=0.5 * T, d=1.0, t=T) == [pytest.approx(FREE)]


def test_quotient_length(kernel: Kernel) -> None:
    assert kernel("quotient_length", n=3.0, d=-2.0, t=T) == [(-1.5,)]
    assert kernel("quotient_length", n=3.0, d=T, t=T) == [(REFERENCE,)]
    assert kernel("quotient_length", n=3.0, d=-T, t=T) == [(REFERENCE,)]


@pytest.mark.parametrize(
    ("b", "c", "roots"),
    [
        (1.0, -3.0, [1.0, -3.0]),
        (-1.0, 0.0, [2.0, 0.0]),
        (2.0, 4.0, [-2.0]),
        (2.0, 4.0 + 0.5 * T, [-2.0]),
        (2.0, 4.0 - 0.5 * T, [-2.0]),
        (2.0, 4.0 + 1e-11, []),
        (math.nan, 0.0, []),
    ],
)
def test_quadratic(kernel: Kernel, b: float, c: float, roots: list[float]) -> None:
    assert [root for (root,) in kernel("quadratic", b=b, c=c, t=T)] == pytest.approx(roots)


def _neighbours(value: float) -> list[float]:
    """The doubles around a value."""
    around = [value]
    for _ in range(5):
        around += [np.nextafter(around[-1], math.inf)]
        around.insert(0, np.nextafter(around[0], -math.inf))
    return list(map(float, around))


@pytest.mark.parametrize("language", [pytest.param("c", marks=needs_compiler), "numpy"])
def test_angles_are_above_minus_pi_and_at_most_pi(language: str) -> None:
    source = module()
    angle = library().test_angle if language == "c" else lambda s, c: float(source._angle(s, c))
    wrap = library().test_wrap if language == "c" else lambda x: float(source._wrap(x))
    for s, c, expected in [(-0.0, -1.0, np.pi), (0.0, -1.0, np.pi), (0.0, 1.0, 0.0)]:
        assert angle(s, c) == expected
    assert -math.pi < angle(-1e-300, -1.0) <= math.pi
    assert math.isnan(angle(math.nan, 1.0))
    assert math.isnan(wrap(math.nan))
    turns = [value for k in range(-9, 11) for value in _neighbours(k * math.pi)]
    for x in [*turns, *map(float, np.linspace(-30.0, 30.0, 501))]:
        assert -math.pi < wrap(x) <= math.pi
        assert abs(math.sin((wrap(x) - x) / 2.0)) < 1e-14
    assert [wrap(k * math.pi) for k in (-3, -1, 1, 3)] == [math.pi] * 4
