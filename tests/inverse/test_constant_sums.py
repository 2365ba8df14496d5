"""What does not change along a family, from speeds of the joints; and how what has to vanish is written."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from kinsym.algebra.field import PRIME
from kinsym.algebra.tree import Pow, Sym, Tree, add, mul, negated, sub
from kinsym.emit.text.formula import TextPrinter
from kinsym.inverse.families import _bare, _constant_sums, _squares, _written
from kinsym.kinematics.chain import build_chain
from kinsym.robot import load

WRITE = TextPrinter()
A, B, C = Sym("a"), Sym("b"), Sym("c")


@pytest.mark.parametrize(
    ("motions", "sums"),
    [
        ([(1, -1)], [{0: 1, 1: 1}]),
        ([(1, 1)], [{0: 1, 1: -1}]),
        ([(1, 2)], []),
        ([(1, 2, -3)], [{0: 1, 1: 1, 2: 1}]),
        ([(3, 1, 2)], [{0: 1, 1: -1, 2: -1}]),
        ([(1, 2, 4, -7)], [{0: 1, 1: 1, 2: 1, 3: 1}]),
        ([(1, 2, 4, 8, -15)], []),
        # every sum with a joint that the shorter ones lack
        ([(1, -1, 1)], [{0: 1, 1: 1}, {0: 1, 2: -1}]),
        ([(1, -1, 5, -5)], [{0: 1, 1: 1}, {2: 1, 3: 1}]),
        # in every posture
        ([(1, -1), (2, -2)], [{0: 1, 1: 1}]),
        ([(1, -1), (1, -2)], []),
        ([(1, PRIME - 1)], [{0: 1, 1: 1}]),
    ],
)
def test_sums_that_stay(motions: list[tuple[int, ...]], sums: list[dict[int, int]]) -> None:
    assert list(_constant_sums(list(range(len(motions[0]))), motions)) == sums


def test_joints_that_do_not_turn_are_in_no_sum() -> None:
    assert list(_constant_sums([0, 3], [(1, -1, 1, -1)])) == [{0: 1, 3: 1}]


@pytest.mark.parametrize(
    ("unknowns", "signed", "text"),
    [
        ((), {1: 1, 2: 1}, "theta2 + theta3"),
        (("theta23",), {1: 1, 2: 1}, "theta23"),
        (("theta23",), {1: 1, 2: -1}, "theta2 - theta3"),
        (("theta23",), {1: 1, 2: 1, 4: -1}, "theta23 - theta5"),
        (("theta234",), {1: 1, 2: 1, 3: 1, 5: 1}, "theta234 + theta6"),
        (("theta234",), {0: 1, 1: -1, 2: -1, 3: -1}, "theta1 - theta234"),
        (("theta2",), {1: -1, 2: 1}, "theta3 - theta2"),
    ],
)
def test_sums_that_the_plan_solves_for_keep_their_name(
    unknowns: tuple[str, ...], signed: dict[int, int], text: str
) -> None:
    chain = build_chain(load("ur5"))
    plan = SimpleNamespace(steps=[SimpleNamespace(unknown=name) for name in unknowns])
    assert WRITE(_written(chain, plan, [f"theta{i}" for i in range(1, 7)], signed)) == text


@pytest.mark.parametrize(
    ("tree", "bases"),
    [
        (add(Pow(A, 2), Pow(B, 2)), [A, B]),
        (Pow(sub(A, B), 2), [sub(A, B)]),
        (A, [A]),
        (add(Pow(A, 2), B), [A, B]),
        (mul(A, B), [mul(A, B)]),
    ],
)
def test_the_bases_of_a_sum_of_squares(tree: Tree, bases: list[Tree]) -> None:
    assert list(_squares(tree)) == bases


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (mul(A, B), "b"),
        (mul(A, B, C), "b*c"),
        (negated(B), "b"),
        (sub(negated(B), C), "b + c"),
        (sub(B, C), "b - c"),
        (negated(mul(A, B)), "b"),
        (B, "b"),
    ],
)
def test_what_has_to_vanish_is_bare_of_signs_and_of_what_never_does(tree: Tree, text: str) -> None:
    assert WRITE(_bare(tree, {"a"})) == text
