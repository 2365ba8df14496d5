"""The kernel of a wrist of equal twists: in both languages and with 50 digits, next to the pole and on the border."""

from __future__ import annotations

import math

import pytest

from kinsym.check.evaluate import exact
from kinsym.check.kernels import KERNELS
from tests.emit.kernel_calls import Kernel, T

CTX, _ = exact()
TWIST = math.radians(60.0)
RADIUS = math.sin(TWIST) ** 2  # of cos^2 + sin^2 cos(theta5), the entry x of a wrist with this twist and its opposite


def pose(theta5: float) -> dict[str, float]:
    """The kernel's inputs at an angle; z is the small entry, exact where cos(theta5) has lost it."""
    half = math.sin(0.5 * theta5)
    away = 2.0 * RADIUS * half * half
    return {
        "a": RADIUS,
        "b": 0.0,
        "p": RADIUS,
        "k": 1.0,
        "x": 1.0 - away,
        "y": 0.0,
        "z": math.sqrt(away * (2.0 - away)),
    }


@pytest.mark.parametrize("theta5", [3.0, 2.0, 1.0, 1e-2, 1e-5, 1e-8, 1e-11])
def test_both_angles_keep_their_digits(kernel: Kernel, theta5: float) -> None:
    """The plain rule knows an angle of 1e-8 to no digit, as 1 - x is 1e-16."""
    roots = kernel("linear_pole", **pose(theta5), t=1e-14)
    assert len(roots) == 2
    for sign, (c, s) in zip((1.0, -1.0), roots, strict=True):
        assert math.atan2(s, c) == pytest.approx(sign * theta5, rel=1e-12)


def test_at_the_pole_and_on_the_border_there_is_one(kernel: Kernel) -> None:
    assert kernel("linear_pole", **pose(0.0), t=T) == [(1.0, 0.0)]
    assert kernel("linear_pole", **pose(0.1 * T), t=T) == [(1.0, 0.0)]
    assert [len(kernel("linear_pole", **pose(math.pi - d), t=T)) for d in (0.0, 1e-7, 1e-5)] == [1, 1, 2]


@pytest.mark.parametrize("name", ["x", "y", "z", "p", "k"])
def test_what_is_no_number_has_no_root(kernel: Kernel, name: str) -> None:
    assert kernel("linear_pole", **{**pose(1.0), name: math.nan}, t=T) == []


def test_beyond_the_border_there_is_none(kernel: Kernel) -> None:
    assert kernel("linear_pole", **{**pose(1.0), "x": -0.9, "y": 0.0, "z": math.sqrt(1.0 - 0.81)}, t=T) == []
    assert kernel("linear_pole", **{**pose(1.0), "a": 0.0, "p": 0.0}, t=T) == []


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_the_exact_kernel_agrees(kernel: Kernel, turned: bool, sense: float) -> None:
    for theta5 in (2.5, 1.0, 1e-4, 1e-9):
        inputs = {**pose(theta5), "p": sense * RADIUS}
        if turned:
            inputs |= {"a": 0.0, "b": RADIUS}
        ours = kernel("linear_pole", **inputs, t=T)
        exactly = KERNELS["linear_pole"](CTX, {name: CTX.mpf(v) for name, v in {**inputs, "t": T}.items()}, None, False)
        assert len(ours) == len(exactly)
        for one, (other, _) in zip(ours, exactly, strict=True):
            assert one == pytest.approx([float(v) for v in other], abs=1e-14)
