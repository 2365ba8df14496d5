"""Expressions are built as a person would write them, and count as what they are."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest

from kinsym.algebra.tree import (
    ONE,
    ZERO,
    Call,
    Num,
    Pi,
    PlusMinus,
    Pow,
    Prod,
    Quot,
    Sum,
    Sym,
    Tree,
    add,
    children,
    mul,
    negated,
    negative,
    opposite,
    replaced,
    sub,
    sum_of_squares,
    symbols,
)
from kinsym.emit.text.formula import TextPrinter

WRITE = TextPrinter()
A, B, C = Sym("a"), Sym("b"), Sym("c")
HALF = Num(Fraction(1, 2))


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (add(), "0"),
        (add(A), "a"),
        (add(A, ZERO), "a"),
        (add(A, ONE), "a + 1"),
        (add(ONE, A), "a + 1"),
        # a number in front saves a minus there, also a small one
        (add(negated(A), ONE), "1 - a"),
        (add(negated(A), HALF), "1/2 - a"),
        (add(negated(A), negated(ONE)), "-a - 1"),
        (add(A, negated(HALF)), "a - 1/2"),
        (add(A, add(B, ONE), ONE), "a + b + 2"),
        (add(ONE, negated(ONE)), "0"),
        (sub(A, A), "0"),
        (sub(A, B), "a - b"),
        (sub(A, ZERO), "a"),
        (sub(ZERO, A), "-a"),
        (sub(A, add(B, ONE)), "a - b - 1"),
        (mul(), "1"),
        (mul(A), "a"),
        (mul(A, ONE), "a"),
        (mul(A, ZERO, B), "0"),
        (mul(A, HALF, mul(Num(Fraction(3)), B)), "3*a*b/2"),
        (mul(HALF, Num(Fraction(2))), "1"),
        (mul(Num(Fraction(-1)), add(A, negated(B))), "-a + b"),
        (mul(Num(Fraction(-1)), A), "-a"),
        (mul(Num(Fraction(-2)), add(A, B)), "-2*(a + b)"),
        (negated(HALF), "-1/2"),
        (negated(A), "-a"),
        (negated(mul(A, B)), "-a*b"),
        (negated(mul(HALF, A)), "-a/2"),
        (negated(mul(Num(Fraction(-1)), A, B)), "a*b"),
        (negated(mul(Num(Fraction(-2)), A)), "2*a"),
        (negated(add(A, negated(B))), "-a + b"),
        (opposite(ZERO), "0"),
        (opposite(negated(A)), "a"),
        (sum_of_squares(B, A), "a^2 + b^2"),
        (sum_of_squares(negated(B), ZERO, Num(Fraction(-3)), A), "a^2 + b^2 + 9"),
    ],
)
def test_what_is_built_is_short(tree: Tree, text: str) -> None:
    assert WRITE(tree) == text
    assert plain(tree)


def plain(tree: Tree) -> bool:
    """Whether sums and products have two parts or more, none of their own kind and no number that does nothing."""
    match tree:
        case Sum(terms):
            numbers = [term for term in terms if isinstance(term, Num)]
            good = len(terms) > 1 and len(numbers) < 2 and ZERO not in terms
        case Prod(factors):
            good = len(factors) > 1 and ONE not in factors and not any(isinstance(f, Num) for f in factors[1:])
        case _:
            return True
    return good and all(type(part) is not type(tree) and plain(part) for part in children(tree))


@pytest.mark.parametrize(
    ("tree", "sign"),
    [(Num(Fraction(-1)), True), (ZERO, False), (ONE, False), (negated(A), True), (mul(HALF, A), False), (A, False)],
)
def test_a_leading_minus_is_seen(tree: Tree, sign: bool) -> None:
    assert negative(tree) is sign


EVERY = [
    (Num(Fraction(2)), ()),
    (A, ()),
    (Pi(), ()),
    (Sum((A, B)), (A, B)),
    (Prod((B, A)), (B, A)),
    (Pow(A, 2), (A,)),
    (Quot(A, B), (A, B)),
    (Call("atan2", (B, A)), (B, A)),
    (PlusMinus(None, A), (A,)),
    (PlusMinus(B, A), (B, A)),
]


@pytest.mark.parametrize(("tree", "parts"), EVERY)
def test_the_parts_of_every_kind(tree: Tree, parts: tuple[Tree, ...]) -> None:
    assert children(tree) == parts
    assert list(symbols(tree)) == ([tree.name] if isinstance(tree, Sym) else [part.name for part in parts])


def test_names_are_told_as_often_as_they_stand() -> None:
    assert list(symbols(add(mul(B, A), Pow(B, 2), Quot(C, A)))) == ["b", "a", "b", "c", "a"]


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (A, "c"),
        (add(A, B), "c + b"),
        (mul(A, B), "c*b"),
        (Pow(A, 2), "c^2"),
        (Quot(B, A), "b/c"),
        (Quot(A, B), "c/b"),
        (Call("hypot", (A, B)), "sqrt(c^2 + b^2)"),
        (HALF, "1/2"),
    ],
)
def test_a_name_is_replaced_wherever_it_stands(tree: Tree, text: str) -> None:
    assert WRITE(replaced(tree, {"a": C})) == text


@pytest.mark.parametrize("tree", [tree for tree, _ in EVERY])
def test_equal_trees_count_once_also_those_of_another_process(tree: Tree) -> None:
    hash(tree)
    again = pickle.loads(pickle.dumps(tree))
    assert "_hash" not in vars(again)
    assert {tree, again} == {tree}


def test_a_sum_is_no_product_though_its_parts_are_the_same() -> None:
    assert Sum((A, B)) != Prod((A, B))
    assert hash(Sum((A, B))) != hash(Prod((A, B)))
    assert hash(Num(Fraction(2))) != hash(Num(Fraction(3)))
