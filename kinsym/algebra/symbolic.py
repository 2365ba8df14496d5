"""From trees to SymPy expressions, for a user who goes on calculating with them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy
from sympy import Expr, Rational, Symbol

from kinsym.algebra.tree import Call, Num, Pi, Pow, Prod, Quot, Sum, Sym, Tree

_FUNCTIONS: Mapping[str, Callable[..., Expr]] = {
    "sqrt": sympy.sqrt,
    "sin": sympy.sin,
    "cos": sympy.cos,
    "abs": sympy.Abs,
    "sign": sympy.sign,
    "atan2": sympy.atan2,
    "hypot": lambda x, y: sympy.sqrt(x**2 + y**2),
}


def expression(tree: Tree, names: Mapping[str, Expr]) -> Expr:
    """A tree as an expression; ``names`` says what a name stands for, any other is a symbol.

    >>> from kinsym.algebra.tree import mul
    >>> expression(mul(Sym("a2"), Sym("c2")), {"c2": sympy.cos(Symbol("theta2"))})
    a2*cos(theta2)
    """
    match tree:
        case Num(value):
            return Rational(value.numerator, value.denominator)
        case Pi():
            return sympy.pi
        case Sym(name):
            return names.get(name, Symbol(name))
        case Sum(terms):
            return sympy.Add(*(expression(term, names) for term in terms))
        case Prod(factors):
            return sympy.Mul(*(expression(factor, names) for factor in factors))
        case Pow(base, exponent):
            return expression(base, names) ** exponent
        case Quot(numerator, denominator):
            return expression(numerator, names) / expression(denominator, names)
        case Call(function, arguments):
            return _FUNCTIONS[function](*(expression(argument, names) for argument in arguments))
    raise TypeError(f"{tree} has two values, an expression has one")
