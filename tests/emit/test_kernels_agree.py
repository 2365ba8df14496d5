"""The kernels of both languages and of the exact walk give the same roots and marks at inputs of every kind."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from kinsym.check.marks import Mark
from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import needs_compiler
from tests.emit.kernel_calls import (
    HELPED,
    T,
    in_c,
    in_numpy,
    marked_exactly,
    marked_in_c,
    marks,
)

EXACT_TRIALS = 100


def _trials(rule: str) -> Iterator[dict[str, float]]:
    """Ordinary inputs, and inputs full of zeros and equal values."""
    random = np.random.default_rng(20)
    for trial in range(400):
        values = random.normal(size=len(KERNELS[rule].inputs))
        if trial % 2:
            values = np.round(values)
        inputs = dict(zip(KERNELS[rule].inputs, map(float, values), strict=True))
        inputs |= {name: T for name in ("t", "t_alt") if name in inputs}
        if rule == "linear_pole":
            inputs |= _on_spheres(inputs)
        yield inputs | {
            f"{name}2": value for name, value in inputs.items() if f"{name}2" in inputs
        }  # the same, stated twice


def _on_spheres(inputs: dict[str, float]) -> dict[str, float]:
    """The inputs of linear_pole made true to what it takes for granted: |(x, y, z)| = 1, |p| = |(a, b)|, k > 0."""
    length = math.hypot(inputs["x"], inputs["y"], inputs["z"]) or 1.0
    point = {name: inputs[name] / length for name in "xyz"}
    return point | {"p": math.copysign(math.hypot(inputs["a"], inputs["b"]), inputs["p"]), "k": abs(inputs["k"])}


@needs_compiler
@pytest.mark.parametrize("rule", HELPED)
def test_languages_agree(rule: str) -> None:
    """The same roots to the last digits."""
    for inputs in _trials(rule):
        ours, theirs = in_numpy(rule, **inputs), in_c(rule, **inputs)
        assert len(ours) == len(theirs), inputs
        loose = 1e4 if rule == "quartic" else 1.0  # each language stops within the rounding error of a polynomial
        np.testing.assert_allclose(ours, theirs, rtol=1e-14, atol=1e-15 * loose, err_msg=str(inputs))


@needs_compiler
@pytest.mark.parametrize("rule", HELPED)
def test_c_agrees_with_the_exact_kernel(rule: str) -> None:
    """The same marks, and the same roots as far as double precision tells, whether loose or not."""
    for number, inputs in enumerate(_trials(rule)):
        if number >= EXACT_TRIALS:
            break
        # With small integers turning points of a quartic meet; rounding parts them, and two are in doubt for one.
        for loose in (False,) if rule == "quartic" and number % 2 else (False, True):
            ours, exact_ = (function(rule, loose=loose, **inputs) for function in (marked_in_c, marked_exactly))
            assert marks(ours) == marks(exact_), inputs
            for (root, mark), (expected, _) in zip(ours, exact_, strict=True):
                digits = 1e-6 if Mark.BORDER in mark else 1e-10
                np.testing.assert_allclose(root, expected, rtol=digits, atol=digits, err_msg=str(inputs))
