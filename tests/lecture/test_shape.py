"""When two formulas have the same form."""

from __future__ import annotations

import pytest

from kinsym.algebra.tree import PlusMinus, Quot, Sym, add, mul, negated
from kinsym.lecture.notation import parse
from kinsym.lecture.shape import lecture_names, shape_of_node, shape_of_tree
from kinsym.lecture.stated import plain

NAMES = lecture_names("theta")


def shape(text: str) -> object:
    """The shape of a text."""
    return shape_of_node(parse(text), NAMES)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("a*b + c", "c + b*a"),
        ("a - b", "-(b - a)"),
        ("c1*(a - b)", "-c1*(b - a)"),
        ("(a*b)*c", "a*(b*c)"),
        ("a + (b + c)", "(a + b) + c"),
        ("c12", "cos(theta1 + theta2)"),
        ("a*v(theta2)", "(1 - c2)*a"),
        ("a**2", "a*a"),
        ("a/(b*c)", "(a/b)/c"),
        ("(x - y)/c", "-(y - x)/c"),
        ("atan2(a + b, c)", "atan2(b + a, c)"),
        ("a - 0", "a"),
    ],
)
def test_the_same_form(one: str, other: str) -> None:
    """Order, brackets of sums in sums and the place of a minus sign do not count."""
    assert shape(one) == shape(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("a*(b + c)", "a*b + a*c"),
        ("a - b", "a + b"),
        ("c1*c2 - s1*s2", "c12"),
        ("a/b", "b/a"),
        ("a**2", "a"),
        ("2*a", "a"),
        ("atan2(a, b)", "atan2(b, a)"),
        ("(a + b)/c", "a/c + b/c"),
        ("c1*(c2*(a + b))", "c1*c2*a + c1*c2*b"),
        ("a*(1 - c2)", "a - a*c2"),
    ],
)
def test_another_form(one: str, other: str) -> None:
    """What is multiplied out, or is another formula, has another form."""
    assert shape(one) != shape(other)


def test_trees_and_texts_meet() -> None:
    """kinsym's trees have the shapes of the lecture's texts."""
    tree = add(mul(Sym("c1"), add(Sym("a1"), negated(Sym("a2")))), Quot(Sym("x"), Sym("y")))
    assert shape_of_tree(tree, NAMES) == shape("x/y - (a2 - a1)*c1")


def test_a_sign_of_two_branches() -> None:
    """The sign in front of a value is one of its branches; inside a formula it stays."""
    either = shape_of_tree(PlusMinus(None, Sym("a")), NAMES)
    assert plain(either) == shape("a")
    inside = shape_of_tree(PlusMinus(Sym("b"), Sym("a")), NAMES)
    assert plain(inside) == shape("b + pm*a") != shape("b + a")
