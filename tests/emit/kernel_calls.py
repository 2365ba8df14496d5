"""The kernels of both languages and of the exact walk, called one by one: inputs in, roots and marks out."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from kinsym.check.evaluate import exact
from kinsym.check.kernels import KERNELS as EXACT
from kinsym.check.marks import Mark
from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import CLibrary, numpy_module
from tests.emit.schedules import every_kernel

T = 1e-12  # a tolerance that is easy to step over on both sides
REFERENCE = 0.3
MOST = 4  # roots of a kernel
Roots = list[tuple[float, ...]]
Marked = list[tuple[tuple[float, ...], Mark]]
Kernel = Callable[..., Roots]
ANGLES = """double test_angle(double s, double c);
double test_angle(double s, double c) { return angle_of(s, c); }
double test_wrap(double angle);
double test_wrap(double angle) { return wrap(angle); }
"""
HELPED = [rule for rule, kernel in KERNELS.items() if not kernel.plain]


def _wrapper(rule: str) -> str:
    """An exported C function that calls a static kernel: inputs, reference, whether loose in; roots and marks out."""
    kernel = KERNELS[rule]
    inputs = [f"in[{i}]" for i in range(len(kernel.inputs) + kernel.free)] + ["loose"] * kernel.ends
    outputs = [f"out + {MOST * i}" for i in range(len(kernel.outputs))] + ["mark"] * (kernel.branches > 1)
    call = f"solve_{rule}({', '.join(inputs + outputs)})"
    body = f"return {call};" if kernel.branches > 1 else f"mark[0] = {call}; return 1;"
    head = f"int test_{rule}(const double *in, int loose, double *out, int *mark)"
    return f"{head};\n{head} {{ (void)loose; {body} }}\n"


@cache
def library() -> ctypes.CDLL:
    """Every C kernel, compiled once."""
    built = CLibrary(every_kernel(), "\n" + ANGLES + "".join(map(_wrapper, HELPED))).library
    for function in (built.test_angle, built.test_wrap):
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_double] * (2 if function is built.test_angle else 1)
    return built


@cache
def module() -> Any:
    """Every NumPy kernel."""
    return numpy_module(every_kernel())


def marked_in_c(rule: str, reference: float = REFERENCE, loose: bool = False, **inputs: float) -> Marked:
    """The roots that the C kernel gives, with their marks."""
    kernel = KERNELS[rule]
    values = [inputs[name] for name in kernel.inputs] + [reference] * kernel.free
    given, out = (ctypes.c_double * len(values))(*values), (ctypes.c_double * (MOST * len(kernel.outputs)))()
    mark = (ctypes.c_int * MOST)()
    count = getattr(library(), f"test_{rule}")(given, int(loose), out, mark)
    return [
        (
            tuple(out[MOST * place + (root if rooted else 0)] for place, (_, rooted) in enumerate(kernel.outputs)),
            Mark(mark[root]),
        )
        for root in range(count)
    ]


def marked_exactly(rule: str, reference: float = REFERENCE, loose: bool = False, **inputs: float) -> Marked:
    """The roots that the kernel of the exact walk gives, with their marks."""
    ctx, _ = exact()
    given = {name: ctx.mpf(value) for name, value in inputs.items()}
    found = EXACT[rule](ctx, given, ctx.mpf(reference), loose)
    return [(tuple(map(float, root)), mark) for root, mark in found]


def in_c(rule: str, reference: float = REFERENCE, **inputs: float) -> Roots:
    """The roots of the C kernel that are not in doubt."""
    return [root for root, mark in marked_in_c(rule, reference, **inputs) if Mark.DOUBTFUL not in mark]


def exactly(rule: str, reference: float = REFERENCE, **inputs: float) -> Roots:
    """The roots of the exact kernel that are not in doubt."""
    return [root for root, mark in marked_exactly(rule, reference, **inputs) if Mark.DOUBTFUL not in mark]


def marked_in_numpy(rule: str, reference: float = REFERENCE, loose: bool = False, **inputs: float) -> Marked:
    """The roots and marks that the NumPy kernel gives for a block of one pose."""
    kernel = KERNELS[rule]
    values = [np.array([inputs[name]]) for name in kernel.inputs] + [np.array([reference])] * kernel.free
    values += [np.array([int(loose)])] * kernel.ends
    function = getattr(module(), f"_{rule}")
    with np.errstate(all="ignore"):
        results = function(*values, axes=1) if kernel.branches > 1 else (*function(*values), np.array([True]))
    *outputs, mark, real = (np.broadcast_to(result, (kernel.branches, 1))[:, 0] for result in results)
    found = [root for root in range(kernel.branches) if real[root]]
    return [(tuple(float(output[root]) for output in outputs), Mark(int(mark[root]))) for root in found]


def in_numpy(rule: str, reference: float = REFERENCE, **inputs: float) -> Roots:
    """The roots of the NumPy kernel that are not in doubt."""
    return [root for root, mark in marked_in_numpy(rule, reference, **inputs) if Mark.DOUBTFUL not in mark]


FREE = (math.cos(REFERENCE), math.sin(REFERENCE))


def marks(found: Marked) -> list[Mark]:
    """The marks of roots."""
    return [mark for _, mark in found]
