"""The marks of roots, in both languages and in the exact walk, at the edges where they begin."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kinsym.check.marks import NEAR, NONE, Mark
from kinsym.emit.source.kernels import KERNELS
from tests.emit.built import needs_compiler
from tests.emit.kernel_calls import (
    FREE,
    Marked,
    T,
    marked_exactly,
    marked_in_c,
    marked_in_numpy,
    marks,
)


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
