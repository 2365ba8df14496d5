"""The exact walk: kernels against their equations, the order of branches, tolerance bands."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from kinsym.check.evaluate import exact
from kinsym.check.kernels import KERNELS
from kinsym.check.marks import Mark
from kinsym.check.walk import ExactWalk
from tests.check import hand

CTX, _ = exact()
TAU = CTX.mpf(2) ** -46


def numbers(**values: Any) -> dict[str, Any]:
    """Inputs of a kernel with the tolerance of unit length."""
    return {"t": TAU, **{name: CTX.mpf(str(value)) for name, value in values.items()}}


def marked(rule: str, loose: bool = False, **values: Any) -> list[tuple[tuple[Any, ...], Mark]]:
    """The roots of a kernel with their marks."""
    return KERNELS[rule](CTX, numbers(**values), CTX.mpf(0.5), loose)


def roots(rule: str, **values: Any) -> list[tuple[Any, ...]]:
    """The roots of a kernel that exist."""
    return [root for root, mark in marked(rule, **values) if Mark.DOUBTFUL not in mark]


def near(left: Any, right: Any) -> bool:
    """Equal to 45 digits."""
    return bool(abs(left - CTX.mpf(right)) < CTX.mpf(10) ** -45)


@pytest.mark.parametrize(("a", "b", "e"), [("3", "4", "2"), ("-1", "0.5", "0.25"), ("0", "-2", "-1.5")])
def test_linear_solves_its_equation(a: str, b: str, e: str) -> None:
    """Both roots satisfy a c + b s = e on the unit circle, the upper sign first."""
    found = roots("linear", a=a, b=b, e=e)
    for c, s in found:
        assert near(CTX.mpf(a) * c + CTX.mpf(b) * s, e)
        assert near(c * c + s * s, 1)
    turn = [CTX.atan2(CTX.mpf(a) * s - CTX.mpf(b) * c, CTX.mpf(a) * c + CTX.mpf(b) * s) for c, s in found]
    assert turn[0] > 0 > turn[1]


def test_linear_at_the_border() -> None:
    """One root within the band, two inside, none outside; free where everything vanishes."""
    assert [len(roots("linear", a=1, b=0, e=1 - k)) for k in (1e-13, 1e-14, 0.0, -1e-14, -5e-14)] == [2, 1, 1, 1, 0]
    assert roots("linear", a=1e-15, b=0, e=1e-15) == [(CTX.cos(CTX.mpf(0.5)), CTX.sin(CTX.mpf(0.5)))]
    assert roots("linear", a=1e-15, b=0, e=0.1) == []


@pytest.mark.parametrize(("l1", "l2"), [("0.6", "0.4"), ("-0.6", "0.4"), ("0.6", "-0.4"), ("-0.4", "-0.6")])
def test_triangle_reaches_the_point(l1: str, l2: str) -> None:
    """|l1 + (k + i w)| is the distance, |k + i w| the second link, and ``along`` is l1 + k; also for negative links."""
    for x, y in ((0.7, 0.1), (-0.3, 0.2)):
        found = roots("triangle", x=x, y=y, l1=l1, l2=l2)
        assert len(found) == 2
        for k, w, along in found:
            assert near(k * k + w * w, CTX.mpf(l2) ** 2)
            assert near(along, CTX.mpf(l1) + k)
            assert near(along**2 + w**2, CTX.mpf(str(x)) ** 2 + CTX.mpf(str(y)) ** 2)
        assert found[0][1] == -found[1][1]


def test_triangle_at_the_border() -> None:
    """Stretched and folded arms have one solution; a point beyond has none; equal links fold to the origin."""
    assert [len(roots("triangle", x=x, y=0, l1="0.6", l2="0.4")) for x in ("0.999", "1", "1.001")] == [2, 1, 0]
    assert [len(roots("triangle", x=x, y=0, l1="0.6", l2="0.4")) for x in ("0.201", "0.2", "0.199")] == [2, 1, 0]
    ((k, w, along),) = roots("triangle", x="0", y="0", l1="0.5", l2="0.5")
    assert near(k, "-0.5")
    assert w == along == 0


def test_other_kernels_solve_their_equations() -> None:
    """Every root is put back into the equation of its rule."""
    for c, s in roots("homogeneous", a="0.3", b="-0.7"):
        assert near(CTX.mpf("0.3") * c - CTX.mpf("0.7") * s, 0)
    wide = roots("homogeneous2", a="1e-20", b="0", a_alt="0.3", b_alt="0.4", t_alt="1e-14")
    assert near(wide[0][0] * CTX.mpf("0.3") + wide[0][1] * CTX.mpf("0.4"), 0)
    ((c, s),) = roots("quotient", x="0.3", y="-0.4", d="-0.5")
    assert near(c, "-0.6")
    assert near(s, "0.8")
    assert roots("quotient_length", n="3", d="1.5") == [(2,)]
    assert roots("quotient_length", n="3", d="1e-20") == [(CTX.mpf(0.5),)]
    assert [len(roots("quadratic", b="1", c=c)) for c in ("0.5", "1", "1.5")] == [2, 1, 0]
    for (d,) in roots("quadratic", b="1", c="0.5"):
        assert near(d * d + 2 * d, "-0.5")
    ((c, s),) = roots("direction", x="0.3", y="0.4", along="0.4", across="0.3")
    assert near(c * CTX.mpf("0.4") - s * CTX.mpf("0.3"), "0.3")
    assert near(s * CTX.mpf("0.4") + c * CTX.mpf("0.3"), "0.4")


def test_walk_finds_both_solutions_in_order() -> None:
    """The upper sign first; each solution leads back to the pose to 40 digits."""
    walk = ExactWalk(hand.schedule(), hand.VALUES)
    pose = [*walk.forward([0.4, 0.7]), [0, 0, 0, 1]]
    found = walk.inverse(pose)
    assert found is not None
    assert [q[1] > 0 for q in found] == [True, False]
    for q in found:
        reached = walk.forward(q)
        assert abs(reached[0][3] - pose[0][3]) + abs(reached[1][3] - pose[1][3]) < CTX.mpf(10) ** -40


def test_walk_refuses_and_mends() -> None:
    """What is no pose gives None; a rotation off by 1e-9 is taken with a wider tolerance."""
    walk = ExactWalk(hand.schedule(), hand.VALUES)
    pose = [*walk.forward([0.4, 0.7]), [0, 0, 0, 1]]
    for row, column, value in ((0, 0, float("nan")), (1, 3, 1e200), (2, 2, -1), (3, 3, 2)):
        broken = [list(entries) for entries in pose]
        broken[row][column] = value
        assert walk.inverse(broken) is None
    loose = [list(entries) for entries in pose]
    loose[0][0] += CTX.mpf(10) ** -9
    assert len(walk.inverse(loose) or []) == 2


def test_reference_is_taken_where_a_joint_is_free() -> None:
    """Equal links folded onto axis 1: theta1 is what the caller gives."""
    walk = ExactWalk(hand.schedule(), {"l1": Fraction(1, 2), "l2": Fraction(1, 2)})
    pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    (q,) = walk.inverse(pose, [0.25, 0]) or []
    assert near(q[0], 0.25)
