"""Exact numbers and cells as the user would write them: decimals as decimals, pi as pi."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from sympy import Expr, Pow, Rational
from sympy.printing.str import StrPrinter

MOST_PLACES = 64


def value_text(value: Fraction) -> str:
    """An exact number as a decimal where it ends, as a quotient otherwise.

    >>> value_text(Fraction(2159, 5000)), value_text(Fraction(-1, 3)), value_text(Fraction(2))
    ('0.4318', '-1/3', '2')
    """
    for places in range(MOST_PLACES):
        if 10**places % value.denominator == 0:
            digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
            text = f"{digits[:-places]}.{digits[-places:]}" if places else digits
            return f"-{text}" if value < 0 else text
    return str(value)


def cell_text(cell: Expr) -> str:
    """A cell as text that :func:`kinsym.robot.parse` reads back as the same cell.

    >>> from kinsym.robot import parse
    >>> cell_text(parse("d3 + 0.10")), cell_text(parse("deg(30)"))
    ('d3 + 0.1', 'pi/6')
    """
    return str(_PRINTER.doprint(cell))


class _CellPrinter(StrPrinter):  # type: ignore[misc]
    def _print_Rational(self, value: Any) -> str:
        return value_text(Fraction(int(value.p), int(value.q)))

    def _print_Pow(self, power: Any, rational: bool = False) -> str:
        top, bottom = (int(power.exp.p), int(power.exp.q)) if power.exp.is_Rational else (1, 1)
        if bottom & (bottom - 1) == 0 and (bottom > 2 or (bottom == 2 and abs(top) > 1)):
            # SymPy keeps roots of roots, and powers of roots, as powers such as 3**(1/4); a cell has only sqrt.
            root = f"sqrt({self._print(Pow(power.base, Rational(2, bottom)))})"
            return root if top == 1 else f"{root}**({top})"
        return str(super()._print_Pow(power, rational))


_PRINTER = _CellPrinter()
