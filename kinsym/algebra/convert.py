"""From SymPy expressions to trees: cells of a table and constants derived from parameters."""

from __future__ import annotations

from fractions import Fraction

from sympy import Add, Expr, Function, Mul, Pow, Rational, Symbol, pi

from kinsym.algebra.tree import ONE, Call, Num, Pi, Quot, Sym, Tree, add, mul
from kinsym.algebra.tree import Pow as Power


def tree_of(expression: Expr) -> Tree:
    """An expression of a table as a tree.

    >>> from sympy import sqrt
    >>> tree_of(sqrt(2) * Symbol("a"))
    Prod(factors=(Call(function='sqrt', arguments=(Num(value=Fraction(2, 1)),)), Sym(name='a')))
    """
    if isinstance(expression, Rational):
        return Num(Fraction(int(expression.p), int(expression.q)))
    if isinstance(expression, Symbol):
        return Sym(expression.name)
    if expression == pi:
        return Pi()
    if isinstance(expression, Add):
        return add(*(tree_of(term) for term in expression.as_ordered_terms()))
    if isinstance(expression, Mul):
        above, below = expression.as_numer_denom()
        if below != 1:
            return Quot(tree_of(above), tree_of(below))
        return mul(*(tree_of(factor) for factor in expression.as_ordered_factors()))
    if isinstance(expression, Pow):
        return _power(tree_of(expression.base), expression.exp)
    if isinstance(expression, Function):
        return Call(expression.func.__name__, tuple(tree_of(argument) for argument in expression.args))
    raise TypeError(f"{expression} is no expression of a table")


def _power(base: Tree, exponent: Expr) -> Tree:
    value = Fraction(int(exponent.p), int(exponent.q))
    if value < 0:
        return Quot(ONE, _power(base, -exponent))
    if value.denominator == 2:
        root = Call("sqrt", (base,))
        return root if value.numerator == 1 else mul(_power(base, exponent - Rational(1, 2)), root)
    return base if value == 1 else Power(base, int(value))
