"""What is known of an expression where some names have values: a zero always, other values as far as they go."""

from __future__ import annotations

from fractions import Fraction

import pytest

from kinsym.algebra.field import PRIME
from kinsym.algebra.tree import ZERO, Call, Num, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.inverse.nonzero import _denominators, _value

A, B, NIL, U = Sym("a"), Sym("b"), Sym("zero"), Sym("unknown")
VALUES = {"a": 6, "b": PRIME - 2, "zero": 0}
ROOT, TWO = Call("sqrt", (A,)), Num(Fraction(2))


@pytest.mark.parametrize(
    ("tree", "value"),
    [
        (A, 6),
        (B, -2),
        (U, None),
        (TWO, 2),
        (Sum((A, B)), 4),
        (Sum((A, U)), None),
        (Sum((A, B, B, B)), 0),
        (Prod((A, B)), -12),
        (Prod((A, U)), None),
        (Prod((NIL, U)), 0),
        (Prod((U, NIL)), 0),
        (Prod((U, A, NIL, A)), 0),
        (Pow(B, 2), 4),
        (Pow(U, 2), None),
        (Quot(A, TWO), 3),
        (Quot(A, U), None),
        (Quot(U, A), None),
        (Quot(NIL, U), 0),
        (Quot(NIL, A), 0),
        (ROOT, None),
        (Call("sqrt", (NIL,)), 0),
        (Call("abs", (NIL,)), 0),
        (Call("abs", (A,)), None),
        (Quot(Sum((A, ROOT)), A), None),
    ],
)
def test_values_and_zeros(tree: Tree, value: int | None) -> None:
    assert _value(tree, VALUES) == (None if value is None else value % PRIME)


@pytest.mark.parametrize("below", [NIL, ZERO, Prod((U, NIL)), Call("abs", (NIL,))])
@pytest.mark.parametrize("above", [A, NIL, U])
def test_what_is_divided_by_zero_has_no_value(above: Tree, below: Tree) -> None:
    with pytest.raises(ZeroDivisionError):
        _value(Quot(above, below), VALUES)


def test_denominators_are_told_factor_by_factor_without_powers() -> None:
    inner = Quot(A, Call("abs", (Pow(B, 2),)))
    tree = Sum((Quot(inner, Prod((A, Pow(Sum((A, B)), 2), U))), Call("sqrt", (Quot(A, NIL),)), B))
    assert list(_denominators(tree)) == [A, Sum((A, B)), U, B, NIL]
    assert list(_denominators(Sum((A, Pow(B, 2))))) == []
