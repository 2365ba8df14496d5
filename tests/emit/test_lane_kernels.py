"""The kernels of the batch have the ordinary roots of the kernels for one pose, and tell where there are others."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest

from kinsym.emit.environment import render
from kinsym.emit.source.c_batch import LANE_KERNELS
from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import PLAIN, CLibrary, needs_compiler
from tests.emit.kernel_calls import MOST, T, marked_in_c
from tests.emit.schedules import every_kernel

pytestmark = needs_compiler

RULES = sorted(rule for rule in LANE_KERNELS if not KERNELS[rule].plain)
TRIALS = 300


def _wrapper(rule: str) -> str:
    """The kernel of one rule and an exported function around it: inputs in; roots and mark out, 1 if they are there."""
    kernel = KERNELS[rule]
    outputs = [f"out + {MOST * place}" for place in range(len(kernel.outputs))]
    call = f"lane_{rule}({', '.join([*(f'in[{i}]' for i in range(len(kernel.inputs))), *outputs, 'mark'])})"
    body = f"return {call};" if kernel.branches > 1 else f"{call}; return 1.0;"
    head = f"double test_lane_{rule}(const double *in, double *out, double *mark)"
    return render(f"c/batch/kernels/{rule}.c.jinja", core=PLAIN) + f"{head};\n{head} {{ {body} }}\n"


@cache
def library() -> ctypes.CDLL:
    """Every kernel of the batch beside those for one pose."""
    built = CLibrary(every_kernel(), "\n" + "".join(map(_wrapper, RULES))).library
    for rule in RULES:
        getattr(built, f"test_lane_{rule}").restype = ctypes.c_double
    return built


def in_lane(rule: str, inputs: dict[str, float]) -> tuple[float, float, list[tuple[float, ...]]]:
    """Whether the roots are there, whether one is marked, and the roots."""
    kernel = KERNELS[rule]
    values = [inputs[name] for name in kernel.inputs]
    given, out = (ctypes.c_double * len(values))(*values), (ctypes.c_double * (MOST * len(kernel.outputs)))()
    mark = ctypes.c_double()
    there = getattr(library(), f"test_lane_{rule}")(given, out, ctypes.byref(mark))
    places = [(MOST * place, rooted) for place, (_, rooted) in enumerate(kernel.outputs)]
    roots = [tuple(out[place + (root if rooted else 0)] for place, rooted in places) for root in range(kernel.branches)]
    return there, mark.value, roots


def _trials(rule: str) -> Iterator[dict[str, float]]:
    """Ordinary inputs, small ones, and ones on both sides of a border at every distance."""
    random = np.random.default_rng(8)
    for trial in range(TRIALS):
        inputs = dict(zip(KERNELS[rule].inputs, map(float, random.normal(size=len(KERNELS[rule].inputs))), strict=True))
        inputs |= {name: T for name in ("t", "t_alt") if name in inputs}
        if rule == "linear_pole":
            inputs |= _on_a_sphere(random)
        yield _beside_a_border(rule, inputs, random) if trial % 3 == 1 else inputs
        if rule != "linear_pole":
            small = float(10.0 ** random.uniform(-15.0, 0.0))
            yield {name: value if name.startswith("t") else value * small for name, value in inputs.items()}


def _on_a_sphere(random: np.random.Generator) -> dict[str, float]:
    """(x, y, z) of length 1, often near the pole, and (a, b) as long as p."""
    y, z = random.normal(size=2) * 10.0 ** random.uniform(-13.0, 1.0)
    point = np.array([random.choice([-1.0, 1.0]), y, z])
    x, y, z = map(float, point / np.linalg.norm(point))
    p, turn = random.normal(), random.uniform(-np.pi, np.pi)
    return {"x": x, "y": y, "z": z, "p": p, "a": p * math.cos(turn), "b": p * math.sin(turn), "k": abs(random.normal())}


def _beside_a_border(rule: str, inputs: dict[str, float], random: np.random.Generator) -> dict[str, float]:
    away = 1.0 + float(random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(-15.0, -1.0))
    match rule:
        case "linear":
            reach = math.hypot(inputs["a"], inputs["b"])
            return inputs | {"e": math.copysign(reach * away, inputs["e"])}
        case "triangle":
            outer, inner = abs(inputs["l1"]) + abs(inputs["l2"]), abs(inputs["l1"]) - abs(inputs["l2"])
            scale = (outer if inputs["x"] > 0.0 else inner) * away / math.hypot(inputs["x"], inputs["y"])
            return inputs | {"x": inputs["x"] * scale, "y": inputs["y"] * scale}
        case "quadratic":
            return inputs | {"c": inputs["b"] ** 2 * away}
        case "linear_pole":
            return inputs | {"k": 2.0 * abs(inputs["p"]) / (1.0 - inputs["x"]) * away} if inputs["x"] < 0.0 else inputs
        case "homogeneous2":
            return inputs | {"a_alt": inputs["a"] * away, "b_alt": inputs["b"] * away}
        case _:
            return inputs


@pytest.mark.parametrize("rule", RULES)
def test_unmarked_roots_are_the_same_and_all_others_are_told(rule: str) -> None:
    seen = set()
    for inputs in _trials(rule):
        there, marked, roots = in_lane(rule, inputs)
        found = marked_in_c(rule, **inputs)
        special = any(mark for _, mark in found)
        seen.add((len(found), special))
        assert (there, marked) in {(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)}
        if not found:
            assert there == 0.0, inputs
        elif special:
            assert marked == 1.0, inputs
        else:
            assert (there, marked) == (1.0, 0.0), inputs
            np.testing.assert_allclose(roots, [root for root, _ in found], rtol=1e-14, atol=1e-15, err_msg=str(inputs))
    assert {(KERNELS[rule].branches, False), (KERNELS[rule].branches, True)} <= seen
    assert (0, False) in seen or not KERNELS[rule].ends


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.0])
def test_what_is_no_number_is_no_root_or_left_to_the_function_for_one_pose(rule: str, value: float) -> None:
    for name in (name for name in KERNELS[rule].inputs if not name.startswith("t")):
        inputs = next(_trials(rule)) | {name: value}
        there, marked, roots = in_lane(rule, inputs)
        found = [root for root, _ in marked_in_c(rule, **inputs)]
        finite = all(math.isfinite(part) for root in roots for part in root)
        assert marked == 1.0 or len(found) == there * KERNELS[rule].branches or not finite
