"""One pose in plain numbers: the same solutions as the arrays find, and the arrays wherever a solution is special."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from kinsym.check.marks import Mark
from kinsym.emit.environment import render
from kinsym.emit.source.kernels import KERNELS
from tests.arms import numpy_module
from tests.emit.kernel_calls import T, marked_in_numpy

NEAR = 2.0**26
RULES = [rule for rule, kernel in KERNELS.items() if not kernel.plain and rule != "quartic"]
ARMS = [
    "puma560",
    "ur5",
    "stanford_arm",
    "scorbot_5r",
    "planar_rrr_paul",
    "spherical_wrist",
    "skew_wrist",
    "screw",
    "slides_between",
    "planar_rpr",
    "three_slides",
    "single",
]
"""Arms that use every kernel, one that is sifted, and one without any kernel."""


class Special(ArithmeticError):
    """Stands for the exception of a generated module."""


@cache
def kernel(rule: str) -> Callable[..., Any]:
    """The kernel of plain numbers."""
    names: dict[str, Any] = {"math": math, "_NEAR": NEAR, "_Special": Special}
    exec(render(f"numpy/scalar/kernels/{rule}.py.jinja"), names)
    return names[f"_scalar_{rule}"]  # type: ignore[no-any-return]


def roots(rule: str, inputs: dict[str, float]) -> list[tuple[float, ...]] | None:
    """The roots of the kernel, None where it leaves them to the arrays."""
    try:
        found = kernel(rule)(**inputs)
    except (ArithmeticError, ValueError):
        return None
    several = KERNELS[rule].branches > 1
    return list(found) if several else [found if isinstance(found, tuple) else (found,)]


@pytest.mark.parametrize("rule", RULES)
def test_a_kernel_finds_what_the_arrays_find_and_leaves_what_they_mark(rule: str) -> None:
    rng = np.random.default_rng(len(rule))
    left = 0
    for trial in range(400):
        inputs = {name: float(rng.uniform(-1.0, 1.0)) for name in KERNELS[rule].inputs}
        if trial % 4 == 0:
            inputs = {name: value * 10.0 ** -rng.uniform(0, 14) for name, value in inputs.items()}
        if rule == "linear_pole":
            inputs["p"] = math.copysign(math.hypot(inputs["a"], inputs["b"]), inputs["p"])
            inputs["k"] = abs(inputs["k"])
        inputs |= {name: T for name in inputs if name in ("t", "t_alt")}
        expected, found = marked_in_numpy(rule, **inputs), roots(rule, inputs)
        if any(mark for _, mark in expected):
            assert found is None, inputs
        left += found is None
        if found is not None:
            assert found == [root for root, _ in expected], inputs
    assert left < 200


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.0])
def test_a_kernel_gives_nothing_that_is_no_number(rule: str, value: float) -> None:
    for spoiled in KERNELS[rule].inputs:
        inputs = dict.fromkeys(KERNELS[rule].inputs, 0.5) | {"t": T, spoiled: value}
        for root in roots(rule, inputs) or []:
            if not all(map(math.isfinite, root)):
                assert not math.isfinite(value)


def parameters(module: Any) -> dict[str, float]:
    """The values of the table; lengths that it leaves open differ."""
    values = enumerate(module.PARAMETERS.items())
    return {name: 0.3 + 0.1 * place if value is None else value for place, (name, value) in values}


def locked(module: Any, q: np.ndarray) -> dict[str, float]:
    """The values in a joint vector of those joints that the caller has to give."""
    names = [name for name, value in getattr(module, "LOCKED", {}).items() if value is None]
    return {name: q[module.JOINTS.index(name)] for name in names}


@pytest.mark.parametrize("name", [*ARMS, "kuka_iiwa"])
def test_one_pose_is_answered_as_many_are(name: str) -> None:
    module, rng = numpy_module(name), np.random.default_rng(4)
    given = parameters(module)
    known = rng.uniform(-3.0, 3.0, (120, len(module.JOINTS)))
    known[80:] = np.round(known[80:] * 2.0 / np.pi) * np.pi / 2.0
    poses = module.fk(known, **given)
    poses[40:80, :3, :3] += rng.uniform(-1e-9, 1e-9, (40, 3, 3))
    q, valid = module.ik_batch(poses, reference=known, **locked(module, known.T), **given)
    for row, pose in enumerate(poses):
        inputs = {"reference": known[row], **locked(module, known[row]), **given}
        alone, solved = module.ik(pose, **inputs), module.solve(pose, **inputs)
        gap = alone - q[row][valid[row]]
        assert np.abs(np.where(np.abs(gap) > 6.0, np.abs(gap) - 2.0 * np.pi, gap)).max(initial=0.0) < 1e-12
        np.testing.assert_array_equal(alone, solved.q)
        np.testing.assert_array_equal(solved.branch, np.flatnonzero(valid[row]))


def _arrays_used(module: Any, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    calls: list[int] = []
    arrays = module._in_blocks
    monkeypatch.setattr(module, "_in_blocks", lambda *given, **named: calls.append(1) or arrays(*given, **named))
    return calls


@pytest.mark.parametrize("name", ARMS)
def test_an_ordinary_pose_needs_no_arrays(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module = numpy_module(name)
    calls = _arrays_used(module, monkeypatch)
    given = parameters(module)
    known = np.linspace(0.3, 0.9, len(module.JOINTS))
    inputs = {**locked(module, known), **given}
    found = module.ik(module.fk(known, **given).tolist(), **inputs)
    assert np.abs(found - known).max(axis=1).min() < 1e-12
    far = np.eye(4)
    far[:3, 3] = 300.0, 400.0, 500.0
    if "P" not in module.JOINT_TYPES and name != "spherical_wrist":
        assert module.ik(far, **inputs).shape == (0, len(module.JOINTS))
        assert module.solve(far, **inputs).status == "unreachable"
    assert not calls


def test_a_special_pose_is_settled_by_the_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    module = numpy_module("puma560")
    calls = _arrays_used(module, monkeypatch)
    straight = module.fk([0.3, 0.4, 0.5, 0.6, 0.0, 0.7])
    assert module.solve(straight).status == "singular"
    assert (module.ik(straight, reference=[0.0, 0.0, 0.0, 0.25, 0.0, 0.0])[:, 3] == 0.25).any()
    assert len(calls) == 2


def test_a_value_of_a_locked_joint_is_tested() -> None:
    module = numpy_module("kuka_iiwa")
    pose = module.fk(np.full(7, 0.4))
    for value in (math.nan, "text", [0.1, 0.2]):
        with pytest.raises(ValueError, match=r"theta3|could not convert"):
            module.ik(pose, theta3=value)


def test_bad_references_are_refused_though_nothing_is_free() -> None:
    module = numpy_module("puma560")
    pose = module.fk(np.full(6, 0.4))
    for reference in (np.zeros(5), np.full(6, math.nan)):
        with pytest.raises(ValueError, match="reference"):
            module.ik(pose, reference=reference)


def test_roots_that_are_searched_for_stay_in_arrays() -> None:
    module = numpy_module("general_pieper")
    assert not hasattr(module, "_solve_one")
    given = dict.fromkeys(module.PARAMETERS, 0.3)
    known = np.full(6, 0.4)
    assert np.abs(module.ik(module.fk(known, **given), **given) - known).max(axis=1).min() < 1e-9


def test_every_mark_is_left_to_the_arrays() -> None:
    """A stretched triangle, one nearly stretched and one just out of reach."""
    for reach, mark in ((2.0, Mark.BORDER), (2.0 - 1e-8, Mark.SOFT), (2.0 + 1e-8, Mark.DOUBTFUL | Mark.BORDER)):
        inputs = {"x": reach, "y": 0.0, "l1": 1.0, "l2": 1.0, "t": T}
        assert marked_in_numpy("triangle", **inputs)[0][1] == mark
        assert roots("triangle", inputs) is None
