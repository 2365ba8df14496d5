"""Trees as MathML, bracketed as the lecture brackets them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.emit.html.mathml import Row, bracketed, fence, glued, grouped, identifier, leaves, number, operator
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names
from kinsym.emit.printer import ATOM, PRODUCT, SUM, split_sign
from kinsym.emit.prose.wording import as_fraction, decimal

_FUNCTIONS = {"atan2": "Atan2", "sign": "sgn"}
_THIN = '<mspace width="0.17em"></mspace>'
_COMMA = operator(",", "postfix") + '<mspace width="0.17em"></mspace>'
#: A root or a fraction with more leaves than this is written so that a line can end in it: (...)^1/2, (...)/(...).
_WIDEST_SOLID = 24

PI = identifier("π")


class MathPrinter:
    """Prints trees as rows of MathML over the names of one derivation.

    >>> from kinsym.algebra.tree import Sym, mul
    >>> MathPrinter(Names([]))(mul(Sym("a"), Sym("b")))
    ('<mi>a</mi><mspace width="0.17em"></mspace><mi>b</mi>',)
    """

    def __init__(self, names: Names) -> None:
        self.names = names

    def __call__(self, tree: Tree) -> Row:
        """The formula, without brackets around it."""
        minus, body = split_sign(tree)
        if not minus:
            return self._within(body, SUM)
        return glued((operator("−", "prefix"),), self._within(body, PRODUCT))

    def name(self, name: str) -> Row:
        """A name of the program."""
        return mathml(self.names[name])

    def _within(self, body: Tree, least: int) -> Row:
        row, strength = self._unsigned(body)
        return row if strength >= least else bracketed(row)

    def _unsigned(self, body: Tree) -> tuple[Row, int]:
        match body:
            case Sym(name):
                return self.name(name), ATOM
            case Pi():
                return (PI,), ATOM
            case Num(value) if value.denominator != 1 and as_fraction(value):
                above, below = number(str(value.numerator)), number(str(value.denominator))
                return (f"<mfrac>{above}{below}</mfrac>",), ATOM
            case Num(value):
                return (number(decimal(value)),), ATOM
            case Sum(terms):
                return self._sum(terms), SUM
            case Prod(factors):
                return self._product(factors), PRODUCT
            case Pow(base, exponent):
                return self._power(base, exponent), ATOM
            case Quot(numerator, denominator):
                return self._quotient(numerator, denominator)
            case PlusMinus(left, right):
                return self._either(left, right), SUM
            case Call(function, arguments):
                return self._call(function, arguments), ATOM

    def _sum(self, terms: Sequence[Tree]) -> Row:
        row: Row = ()
        for term in terms:
            minus, body = split_sign(term)
            if isinstance(body, PlusMinus) and body.left is None:
                sign, body = "±", body.right
            else:
                sign = "−" if minus else "+" if row else ""
            part = self._within(body, PRODUCT)
            if sign:
                part = glued((operator(sign, "infix" if row else "prefix"),), part)
            row += part
        return row

    def _either(self, left: Tree | None, right: Tree) -> Row:
        """``left ± right``; zero on the left is not written."""
        part = self._within(right, PRODUCT)
        if left is None or (isinstance(left, Num) and left.value == 0):
            return glued((operator("±", "prefix"),), part)
        return self(left) + glued((operator("±"),), part)

    def _product(self, factors: Sequence[Tree]) -> Row:
        parts = [self._within(factor, ATOM) for factor in factors]
        row = parts[0]
        for before, part in pairwise(parts):
            both = before[-1].endswith(("</mn>", "</mfrac>")) and part[0].startswith(("<mn>", "<mfrac>"))
            row = glued(row, (operator("·") if both else _THIN,), part)
        return row

    def _power(self, base: Tree, exponent: int) -> Row:
        row = self._within(base, ATOM)
        if isinstance(base, (Quot, Call, Pow)):
            row = bracketed(row)
        # The exponent goes with the last bracket, so that a line can end inside a long base.
        above = number(str(exponent))
        if len(row) == 1:
            return (f"<msup>{grouped(row)}{above}</msup>",)
        return glued(row, (f"<msup><mrow></mrow>{above}</msup>",))

    def _quotient(self, numerator: Tree, denominator: Tree) -> tuple[Row, int]:
        upper, lower = self(numerator), self(denominator)
        if max(leaves(upper), leaves(lower)) <= _WIDEST_SOLID:
            return (f"<mfrac>{grouped(upper)}{grouped(lower)}</mfrac>",), ATOM
        slash = (operator("/"),)
        return glued(self._within(numerator, PRODUCT), slash, self._within(denominator, ATOM)), PRODUCT

    def _call(self, function: str, arguments: tuple[Tree, ...]) -> Row:
        if function == "hypot":
            x, y = arguments
            return self._call("sqrt", (Sum((Pow(x, 2), Pow(y, 2))),))
        rows = [self(argument) for argument in arguments]
        if function == "sqrt":
            if leaves(rows[0]) <= _WIDEST_SOLID:
                return (f"<msqrt>{grouped(rows[0])}</msqrt>",)
            half = f"{number('1')}{operator('/')}{number('2')}"
            return glued(bracketed(rows[0]), (f"<msup><mrow></mrow><mrow>{half}</mrow></msup>",))
        if function == "abs":
            return glued((fence("|"),), rows[0], ('<mo form="postfix" stretchy="false">|</mo>',))
        name = (identifier(_FUNCTIONS.get(function, function)),)
        if function in ("sin", "cos") and isinstance(arguments[0], (Sym, Pi)):
            return glued(name, (_THIN,), rows[0])
        inside = rows[0]
        for row in rows[1:]:
            inside = glued(inside, (_COMMA,)) + row
        return glued(name, bracketed(inside))
