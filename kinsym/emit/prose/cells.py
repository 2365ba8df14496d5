"""What a user's table says, as trees, so that a cell is printed by the same printer as every equation."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import sympy as sp

from kinsym.algebra.tree import ONE, Call, Num, Pi, Pow, Quot, Sum, Sym, Tree, mul


def _power(base: Tree, exponent: Fraction) -> Tree:
    """``base**exponent`` for a positive exponent that is a multiple of one half."""
    whole, half = divmod(exponent, 1)
    factors: list[Tree] = []
    if whole:
        factors.append(base if whole == 1 else Pow(base, int(whole)))
    if half:
        if half != Fraction(1, 2):
            raise TypeError(f"no printed form for the exponent {exponent}")
        factors.append(Call("sqrt", (base,)))
    return mul(*factors)


def _product(factors: Iterable[sp.Expr]) -> Tree:
    above: list[Tree] = []
    below: list[Tree] = []
    for factor in factors:
        base, exponent = factor.as_base_exp()
        if isinstance(factor, sp.Rational):
            above.append(Num(Fraction(int(factor.p), int(factor.q))))
        elif isinstance(exponent, sp.Rational):
            power = Fraction(int(exponent.p), int(exponent.q))
            (above if power > 0 else below).append(_power(cell_tree(base), abs(power)))
        else:
            raise TypeError(f"no printed form for the factor {factor}")
    return Quot(mul(*above) if above else ONE, mul(*below)) if below else mul(*above)


def cell_tree(expression: sp.Expr) -> Tree:
    """The tree of an exact cell: rationals, pi, names, sums, products, powers, roots, sines and cosines.

    >>> cell_tree(sp.Symbol("a1") - 2)
    Sum(terms=(Sym(name='a1'), Num(value=Fraction(-2, 1))))
    """
    expression = sp.sympify(expression)
    match expression:
        case sp.Rational():
            return Num(Fraction(int(expression.p), int(expression.q)))
        case sp.Symbol():
            return Sym(expression.name)
        case _ if expression is sp.pi:
            return Pi()
        case sp.Add():
            return Sum(tuple(cell_tree(term) for term in expression.as_ordered_terms()))
        case sp.Mul():
            return _product(expression.as_ordered_factors())
        case sp.Pow():
            return _product((expression,))
        case sp.sin() | sp.cos():
            return Call(expression.func.__name__, tuple(cell_tree(part) for part in expression.args))
        case _:
            raise TypeError(f"no printed form for {expression}")
