"""The numerical kernels of both languages and of the exact walk, one by one.

They are tried at ordinary inputs, on borders, where an unknown is free and at the edges of their marks.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest

from kinsym.check.evaluate import exact
from kinsym.check.kernels import KERNELS as EXACT
from kinsym.check.marks import NEAR, NONE, Mark
from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import CLibrary, needs_compiler, numpy_module
from tests.emit.schedules import every_kernel

T = 1e-12  # a tolerance that is easy to step over on both sides
REFERENCE = 0.3
MOST = 4  # roots of a kernel
EXACT_TRIALS = 100
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
def _library() -> ctypes.CDLL:
    library = CLibrary(every_kernel(), "\n" + ANGLES + "".join(map(_wrapper, HELPED))).library
    for function in (library.test_angle, library.test_wrap):
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_double] * (2 if function is library.test_angle else 1)
    return library


@cache
def _module() -> Any:
    return numpy_module(every_kernel())


def marked_in_c(rule: str, reference: float = REFERENCE, loose: bool = False, **inputs: float) -> Marked:
    """The roots that the C kernel gives, with their marks."""
    kernel = KERNELS[rule]
    values = [inputs[name] for name in kernel.inputs] + [reference] * kernel.free
    given, out = (ctypes.c_double * len(values))(*values), (ctypes.c_double * (MOST * len(kernel.outputs)))()
    mark = (ctypes.c_int * MOST)()
    count = getattr(_library(), f"test_{rule}")(given, int(loose), out, mark)
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
    function = getattr(_module(), f"_{rule}")
    with np.errstate(all="ignore"):
        results = function(*values, axes=1) if kernel.branches > 1 else (*function(*values), np.array([True]))
    *outputs, mark, real = (np.broadcast_to(result, (kernel.branches, 1))[:, 0] for result in results)
    found = [root for root in range(kernel.branches) if real[root]]
    return [(tuple(float(output[root]) for output in outputs), Mark(int(mark[root]))) for root in found]


def in_numpy(rule: str, reference: float = REFERENCE, **inputs: float) -> Roots:
    """The roots of the NumPy kernel that are not in doubt."""
    return [root for root, mark in marked_in_numpy(rule, reference, **inputs) if Mark.DOUBTFUL not in mark]


@pytest.fixture(params=[pytest.param(in_c, id="c", marks=needs_compiler), pytest.param(in_numpy, id="numpy")])
def kernel(request: pytest.FixtureRequest) -> Kernel:
    """A kernel by its rule, in each language."""
    return request.param


FREE = (math.cos(REFERENCE), math.sin(REFERENCE))


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


@pytest.fixture(
    params=[
        pytest.param(marked_in_c, id="c", marks=needs_compiler),
        pytest.param(marked_in_numpy, id="numpy"),
        pytest.param(marked_exactly, id="exact"),
    ]
)
def marked(request: pytest.FixtureRequest) -> Callable[..., Marked]:
    """A kernel that tells its marks, by its rule."""
    return request.param


FAR = NEAR * T  # where marks end
INSIDE, OUTSIDE = 0.999 * FAR, 1.001 * FAR


def marks(found: Marked) -> list[Mark]:
    """The marks of roots."""
    return [mark for _, mark in found]


@pytest.mark.parametrize(
    ("room", "tight", "loose"),
    [
        (OUTSIDE, [NONE, NONE], [NONE, NONE]),
        (INSIDE, [Mark.SOFT, Mark.SOFT], [Mark.SOFT, Mark.SOFT]),
        (3.0 * T, [Mark.SOFT, Mark.SOFT], [Mark.SOFT, Mark.SOFT]),
        (0.5 * T, [Mark.BORDER], [Mark.BORDER]),
        (-0.5 * T, [Mark.BORDER], [Mark.BORDER]),
        (-3.0 * T, [Mark.BORDER | Mark.DOUBTFUL], [Mark.BORDER | Mark.DOUBTFUL]),
        (-INSIDE, [Mark.BORDER | Mark.DOUBTFUL], [Mark.BORDER | Mark.DOUBTFUL]),
        (-OUTSIDE, [], [Mark.BORDER | Mark.DOUBTFUL]),
        (-0.1, [], [Mark.BORDER | Mark.DOUBTFUL]),
    ],
)
def test_marks_beside_a_border(
    marked: Callable[..., Marked], room: float, tight: list[Mark], loose: list[Mark]
) -> None:
    """Every kernel with a border, at the same distance from it: both signs of linear, stretched and folded links."""
    at = 1.0 - 2.0 * room  # of the quadratic: its discriminant is the room
    cases: list[tuple[str, dict[str, float]]] = [
        ("linear", {"a": 0.6, "b": 0.8, "e": 1.0 - room}),
        ("linear", {"a": 0.6, "b": 0.8, "e": room - 1.0}),
        ("triangle", {"x": 0.0, "y": 1.0 - room, "l1": 0.7, "l2": 0.3}),
        ("triangle", {"x": 0.5 + room, "y": 0.0, "l1": 0.3, "l2": -0.8}),
        ("quadratic", {"b": 1.0, "c": (at + 1.0) / 2.0}),
    ]
    for rule, inputs in cases:
        assert marks(marked(rule, t=T, **inputs)) == tight, rule
        assert marks(marked(rule, t=T, loose=True, **inputs)) == loose, rule


def test_doubtful_roots_are_those_on_the_border(marked: Callable[..., Marked]) -> None:
    """Beyond the reach a root in doubt is the stretched or folded arm, the turning point of the equation."""
    ((root, _),) = marked("linear", a=0.6, b=0.8, e=-1.5, t=T, loose=True)
    assert root == pytest.approx((-0.6, -0.8))
    ((root, _),) = marked("triangle", x=2.0, y=0.0, l1=0.7, l2=0.3, t=T, loose=True)
    assert root[:2] == pytest.approx((0.3, 0.0))
    ((root, _),) = marked("triangle", x=0.1, y=0.0, l1=0.7, l2=0.3, t=T, loose=True)
    assert root[:2] == pytest.approx((-0.3, 0.0))
    ((root, _),) = marked("quadratic", b=2.0, c=9.0, t=T, loose=True)
    assert root == (-2.0,)


def test_no_first_link_is_no_triangle_however_loose(marked: Callable[..., Marked]) -> None:
    assert marked("triangle", x=0.5, y=0.0, l1=0.0, l2=0.5, t=T, loose=True) == []


@pytest.mark.parametrize(
    ("rule", "inputs", "count"),
    [
        ("quotient", lambda r: {"x": 0.6 * r, "y": -0.8 * r, "d": -2.0}, 1),
        ("quotient_length", lambda r: {"n": 0.3, "d": -r}, 1),
        ("homogeneous", lambda r: {"a": 0.6 * r, "b": -0.8 * r}, 2),
        ("homogeneous2", lambda r: {"a": 0.0, "b": -r, "a_alt": 0.1 * r, "b_alt": 0.0, "t_alt": T}, 2),
        ("homogeneous2", lambda r: {"a": 0.0, "b": 0.1 * r, "a_alt": 0.0, "b_alt": 2.0 * r, "t_alt": 2.0 * T}, 2),
        ("direction", lambda r: {"x": 0.6 * r, "y": -0.8 * r, "along": 0.3, "across": 0.2}, 1),
    ],
)
def test_marks_beside_a_free_unknown(
    marked: Callable[..., Marked], rule: str, inputs: Callable[[float], dict[str, float]], count: int
) -> None:
    for length, expected in ((OUTSIDE, [NONE] * count), (INSIDE, [Mark.SOFT] * count), (0.5 * T, [Mark.FREE])):
        assert marks(marked(rule, t=T, **inputs(length))) == expected


@pytest.mark.parametrize(
    ("e", "tight", "loose"),
    [
        (0.5 * T, [Mark.FREE], [Mark.FREE]),
        (3.0 * T, [Mark.FREE | Mark.DOUBTFUL], [Mark.FREE | Mark.DOUBTFUL]),
        (-INSIDE, [Mark.FREE | Mark.DOUBTFUL], [Mark.FREE | Mark.DOUBTFUL]),
        (OUTSIDE, [], [Mark.FREE | Mark.DOUBTFUL]),
    ],
)
def test_marks_of_a_linear_equation_without_coefficients(
    marked: Callable[..., Marked], e: float, tight: list[Mark], loose: list[Mark]
) -> None:
    """Any angle would do if the right side vanished too."""
    for expected, more in ((tight, False), (loose, True)):
        found = marked("linear", a=0.5 * T, b=0.0, e=e, t=T, loose=more)
        assert marks(found) == expected
        assert all(root == pytest.approx(FREE) for root, _ in found)


def _one_vector(xc: float, x: float, k: float) -> dict[str, float]:
    """|xc cos + x| = |k| for the quartic, stated twice."""
    lines = dict.fromkeys(KERNELS["quartic"].inputs, 0.0) | {"xc": xc, "x": x, "k": k}
    return lines | {f"{name}2": lines[name] for name in ("xc", "x", "k")} | {"t": T, "t2": T}


@pytest.mark.parametrize(
    ("k", "tight", "loose"),
    [
        # |cos + 2| = k: a minimum at pi, above zero for k < 1, and a maximum at 0
        (1.0 + OUTSIDE, [NONE, NONE], [NONE, NONE]),
        (1.0 + INSIDE, [Mark.SOFT, Mark.SOFT], [Mark.SOFT, Mark.SOFT]),
        (1.0 + 0.5 * T, [Mark.BORDER], [Mark.BORDER]),
        (1.0 - 3.0 * T, [Mark.BORDER | Mark.DOUBTFUL], [Mark.BORDER | Mark.DOUBTFUL]),
        (1.0 - INSIDE, [Mark.BORDER | Mark.DOUBTFUL], [Mark.BORDER | Mark.DOUBTFUL]),
        (1.0 - OUTSIDE, [], [Mark.BORDER | Mark.DOUBTFUL]),
        (3.0 - INSIDE, [Mark.SOFT, Mark.SOFT], [Mark.SOFT, Mark.SOFT]),
        (3.0 + INSIDE, [Mark.BORDER | Mark.DOUBTFUL], [Mark.BORDER | Mark.DOUBTFUL]),
        (3.0 + OUTSIDE, [], [Mark.BORDER | Mark.DOUBTFUL]),
    ],
)
def test_marks_of_the_quartic(marked: Callable[..., Marked], k: float, tight: list[Mark], loose: list[Mark]) -> None:
    inputs = _one_vector(1.0, 2.0, k)
    assert marks(marked("quartic", **inputs)) == tight
    found = marked("quartic", **inputs, loose=True)
    assert marks(found) == loose
    if loose == [Mark.BORDER | Mark.DOUBTFUL]:
        assert found[0][0] == pytest.approx((-1.0 if k < 2.0 else 1.0, 0.0), abs=1e-7)


def test_marks_of_the_quartic_are_of_each_root(marked: Callable[..., Marked]) -> None:
    """|cos + 0.2| = 0.8 - h: the two roots next to pi are soft, the two at ±acos(0.6) are not."""
    near = marks(marked("quartic", **_one_vector(1.0, 0.2, 0.8 - 0.5 * FAR)))
    assert near == [Mark.SOFT, NONE, NONE, Mark.SOFT]
    beyond = marks(marked("quartic", **_one_vector(1.0, 0.2, 0.8 + 0.5 * FAR)))
    assert beyond == [NONE, NONE, Mark.BORDER | Mark.DOUBTFUL]
    assert marks(marked("quartic", **_one_vector(0.0, 1.0, 1.0))) == [Mark.FREE]


def _neighbours(value: float) -> list[float]:
    """The doubles around a value."""
    around = [value]
    for _ in range(5):
        around += [np.nextafter(around[-1], math.inf)]
        around.insert(0, np.nextafter(around[0], -math.inf))
    return list(map(float, around))


@pytest.mark.parametrize("language", [pytest.param("c", marks=needs_compiler), "numpy"])
def test_angles_are_above_minus_pi_and_at_most_pi(language: str) -> None:
    module = _module()
    angle = _library().test_angle if language == "c" else lambda s, c: float(module._angle(s, c))
    wrap = _library().test_wrap if language == "c" else lambda x: float(module._wrap(x))
    for s, c, expected in [(-0.0, -1.0, np.pi), (0.0, -1.0, np.pi), (-1e-300, -1.0, np.pi), (0.0, 1.0, 0.0)]:
        assert angle(s, c) == expected
    assert math.isnan(angle(math.nan, 1.0))
    assert math.isnan(wrap(math.nan))
    turns = [value for k in range(-9, 11) for value in _neighbours(k * math.pi)]
    for x in [*turns, *map(float, np.linspace(-30.0, 30.0, 501))]:
        assert -math.pi < wrap(x) <= math.pi
        assert abs(math.sin((wrap(x) - x) / 2.0)) < 1e-14
    assert [wrap(k * math.pi) for k in (-3, -1, 1, 3)] == [math.pi] * 4


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
