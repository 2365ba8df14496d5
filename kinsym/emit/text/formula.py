"""Formulas as plain text: ``theta1 = Atan2(p_y, p_x) ± Atan2(sqrt(a^2 - e^2), e)``.

The names are the program's own (theta1, c23, kappa1), so that what a reader sees in the terminal can be searched
for in the generated source.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import ClassVar

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Tree
from kinsym.emit.printer import ATOM, PRODUCT, SUM, Printer, split_sign
from kinsym.emit.prose.wording import as_fraction, decimal


class ReaderPrinter(Printer):
    """What the printers for readers share: exact numbers, powers, and the sign ± inside sums."""

    plus_minus = "±"

    def _sum(self, terms: tuple[Tree, ...]) -> str:
        text = ""
        for term in terms:
            minus, body = split_sign(term)
            if isinstance(body, PlusMinus) and body.left is None:
                sign, body = self.plus_minus, body.right
            else:
                sign = "-" if minus else "+" if text else ""
            part = self._within(body, PRODUCT)
            text += f" {sign} {part}" if text else f"{sign}{part}"
        return text

    def _either(self, left: Tree | None, right: Tree) -> str:
        """``left ± right``; zero on the left is not written."""
        part = self._within(right, PRODUCT)
        if left is None or (isinstance(left, Num) and left.value == 0):
            return f"{self.plus_minus}{part}"
        return f"{self._signed(left)} {self.plus_minus} {part}"


class TextPrinter(ReaderPrinter):
    """Prints trees for a terminal; ``ascii`` writes ``+-`` where a terminal cannot show ``±``.

    >>> from kinsym.algebra.tree import Sym, mul, sub
    >>> TextPrinter()(mul(Sym("c1"), sub(Sym("a1"), Sym("b"))))
    'c1*(a1 - b)'
    """

    functions: ClassVar[Mapping[str, str]] = {"atan2": "Atan2"}
    pi = "pi"

    def __init__(self, *, ascii: bool = False) -> None:
        self.plus_minus = "+-" if ascii else "±"

    def _unsigned(self, body: Tree) -> tuple[str, int]:
        match body:
            case Num(value) if value.denominator != 1 and as_fraction(value):
                return f"{value.numerator}/{value.denominator}", PRODUCT
            case Num(value):
                return decimal(value), ATOM
            case Call("hypot", (x, y)):
                return self._unsigned(Call("sqrt", (Sum((Pow(x, 2), Pow(y, 2))),)))
            case Call(function, arguments):
                return f"{self.functions.get(function, function)}({', '.join(map(self._signed, arguments))})", ATOM
            case Pow(base, exponent):
                return f"{self._within(base, ATOM)}^{exponent}", ATOM
            case Quot(numerator, denominator):
                return f"{self._within(numerator, PRODUCT)}/{self._within(denominator, ATOM)}", PRODUCT
            case Prod((Num(value), *rest)) if value.denominator != 1 and as_fraction(value):
                return self._fraction(value, rest), PRODUCT
            case Prod(factors):
                return "*".join(self._within(factor, ATOM) for factor in factors), PRODUCT
            case PlusMinus(left, right):
                return self._either(left, right), SUM
            case Pi():
                return self.pi, ATOM
            case _:
                return super()._unsigned(body)

    def _fraction(self, value: Fraction, rest: Sequence[Tree]) -> str:
        """A fraction before a product: ``3*a*b/2``."""
        front = [] if value.numerator == 1 else [str(value.numerator)]
        return "*".join([*front, *(self._within(factor, ATOM) for factor in rest)]) + f"/{value.denominator}"
