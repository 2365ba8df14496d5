"""What the rules are made of: linear forms of equations, names that are free, equations as they are shown."""

from __future__ import annotations

import pytest

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Definition, Num, Pow, Quot, Sym, Tree, add, negated
from kinsym.emit.text.formula import TextPrinter
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Names, View, divided, linear_forms, shown, tolerance
from kinsym.inverse.state import start
from kinsym.kinematics.chain import build_chain
from kinsym.robot import load
from kinsym.robot.model import Task

CHAIN = build_chain(load("scara"))
STATE, _ = start(CHAIN, Task.SCARA)
RING = CHAIN.ring
ONE, TWO, BOTH = (next(a for a in CHAIN.angles.values() if a.label == label) for label in ("1", "2", "12"))
C, S, A, B, PX, PY = (RING[name] for name in ("c1", "s1", "a1", "a2", "p_x", "p_y"))
WRITE = TextPrinter()


def equation(poly: Poly, *, angles: tuple = (ONE,), lengths: tuple[str, ...] = (), unit: int = 1) -> PoolEquation:
    """``poly = 0``."""
    return PoolEquation(RING.zero, -poly, unit, "", angles, lengths)


def test_equations_are_linear_forms_of_their_only_unknown() -> None:
    given = [
        equation(PX * C + PY * S - A),
        # its opposite, and multiples of the angle that are no equation of it
        equation(A - PX * C - PY * S),
        equation(C * S - A),
        equation(C * C - A),
        equation(PX * C, angles=(ONE, TWO)),
        equation(PX * C, lengths=("d3",)),
        equation(PX - A - B, angles=(ONE,)),
        equation(A * C - PX - PY - B),
        equation(S - PX),
        equation(RING["c2"] - PX, angles=(TWO,)),
    ]
    found = linear_forms(STATE, given)
    assert list(found) == ["1", "2"]
    # constant factors first, then the shorter
    assert [form.equation for form in found["1"]] == [given[8], given[7], given[0]]
    first = found["1"][2]
    assert (first.a, first.b, first.e, first.angle, first.terms) == (PX, PY, A, ONE, 3)
    assert (found["1"][1].e, found["1"][1].b) == (PX + PY + B, RING.zero)


def test_a_view_sorts_equations_by_their_unknowns() -> None:
    slide = equation(RING["d3"] - PX, angles=(), lengths=("d3",))
    slides = equation(RING["d3"] - PX, angles=(), lengths=("d3", "d4"))
    squared = equation(RING["d3"] - PX, angles=(), lengths=("d3", "d4"), unit=2)
    two = equation(A * C + B * RING["c12"], angles=(ONE, BOTH))
    rotation = equation(A * C + B * RING["c12"], angles=(ONE, BOTH), unit=0)
    mixed = equation(A * C + B * RING["c12"], angles=(ONE, BOTH), lengths=("d3",))
    one = equation(A * C - B)
    # a second group of the same arm
    wrist = build_chain(load("puma560"))
    apart = tuple(next(a for a in wrist.angles.values() if a.label == label) for label in ("1", "2"))
    other = equation(A * C, angles=apart)
    view = View(STATE, [slide, slides, squared, two, rotation, mixed, one, other])
    assert view.of_lengths() == [slide]
    assert view.of_slides() == [slides]
    assert view.of_two_angles() == [two]
    assert [form.equation for forms in view.linear.values() for form in forms] == [one]


def test_names_are_free_and_counted_by_family() -> None:
    names = Names({"mu2", "a"})
    assert [names.fresh("mu"), names.fresh("mu"), names.fresh("nu"), names.fresh("mu")] == ["mu1", "mu3", "nu1", "mu4"]
    assert names.taken == {"a", "mu1", "mu2", "mu3", "mu4", "nu1"}
    assert [names.step(), names.step()] == [1, 2]


def test_only_what_is_longer_than_a_name_gets_one() -> None:
    names, made = Names(set()), list[Definition]()
    plain: list[Tree] = [ZERO, Sym("a"), negated(Sym("a"))]
    assert [names.short("mu", tree, made) for tree in plain] == plain
    assert made == []
    long = add(Sym("a"), Sym("b"))
    assert names.short("mu", long, made) == Sym("mu1")
    assert made == [Definition(name="mu1", value=long)]
    assert names.short("mu", Pow(Sym("a"), 2), made) == Sym("mu2")


@pytest.mark.parametrize(("unit", "text"), [(0, "tau"), (1, "tau*size"), (2, "tau*size^2")])
def test_a_tolerance_is_in_the_unit_of_the_equation(unit: int, text: str) -> None:
    assert WRITE(tolerance(unit)) == text


@pytest.mark.parametrize(
    ("left", "right", "text"),
    [
        (-PX, -A * C, "p04_x = a1*c1"),
        (-PX - PY, -A, "p04_x + p04_y = a1"),
        (-PX, RING.zero, "p04_x = 0"),
        (-PX, A, "-p04_x = a1"),
        (PX - PY, -A, "p04_x - p04_y = -a1"),
        (-PX, A - B, "-p04_x = a1 - a2"),
        (PX, -A, "p04_x = -a1"),
    ],
)
def test_an_equation_is_shown_without_a_minus_on_both_sides(left: Poly, right: Poly, text: str) -> None:
    found = shown(STATE, PoolEquation(left, right, 1, "source", (ONE,), ()))
    assert (f"{WRITE(found.lhs)} = {WRITE(found.rhs)}", found.source) == (text, "source")


def test_a_quotient_is_in_lowest_terms() -> None:
    assert divided(STATE, 2 * A * B, 2 * A) == Sym("a2")
    assert divided(STATE, 3 * A, RING.number(6)) == STATE.tree(A.quo_ground(2))
    assert divided(STATE, 2 * A * PX, 4 * A * B) == Quot(STATE.tree(PX), STATE.tree(2 * B))
    assert divided(STATE, RING.one * 4, RING.one * 2) == Num(2)
