"""Formulas as LaTeX, bracketed as the lecture brackets them: c_1[c_2(c_4 c_5 c_6 - s_4 s_6) - s_2 s_5 c_6]."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import ClassVar

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree, children
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.names import Names
from kinsym.emit.printer import ATOM, PRODUCT, SUM
from kinsym.emit.prose.wording import as_fraction, decimal
from kinsym.emit.text.formula import ReaderPrinter

#: Brackets by the number of brackets inside them.
_BRACKETS = (("(", ")"), (r"\bigl[", r"\bigr]"), (r"\bigl\lbrace ", r"\bigr\rbrace "), (r"\Bigl(", r"\Bigr)"))
_AROUND_FRACTION = (r"\biggl(", r"\biggr)")
#: A root or a fraction wider than this (points) is written so that it can be broken: (...)^{1/2}, (...)/(...).
_WIDEST_SOLID = 260.0
_RELATIONS = {"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "==": "=", "<": "<", ">": ">", "=": "="}
#: Factors that would run into what stands before them without a space.
_APART = re.compile(r"\{\}\^|\\mathrm|\\operatorname|\\sin|\\cos|[cs]\\[a-z]")


def relation_sign(sign: str) -> str:
    """A relation of the plan as LaTeX."""
    return _RELATIONS[sign]


def bracketed(text: str) -> str:
    r"""A formula in the brackets that its own brackets ask for.

    >>> bracketed("a + b"), bracketed("a (b + c)")
    ('(a + b)', '\\bigl[a (b + c)\\bigr]')
    """
    depth = deepest = 0
    for mark in re.findall(r"\\lbrace|\\rbrace|[()\[\]]", text):
        depth += 1 if mark in ("(", "[", r"\lbrace") else -1
        deepest = max(deepest, depth)
    opening, closing = _AROUND_FRACTION if r"\frac" in text else _BRACKETS[min(deepest, len(_BRACKETS) - 1)]
    return f"{opening}{text}{closing}"


class LatexPrinter(ReaderPrinter):
    r"""Prints trees as LaTeX mathematics over the names of one document.

    >>> from kinsym.algebra.tree import Sym, mul, sub
    >>> LatexPrinter(Names([]))(mul(Sym("c1"), sub(Sym("a1"), Sym("b"))))
    'c_{1} (a_{1} - b)'
    """

    functions: ClassVar[Mapping[str, str]] = {"atan2": "Atan2", "sign": "sgn"}
    pi = r"\pi"
    plus_minus = r"\pm"

    def __init__(self, names: Names) -> None:
        self._names = names

    def _within(self, body: Tree, least: int) -> str:
        text, strength = self._unsigned(body)
        return text if strength >= least else bracketed(text)

    def _either(self, left: Tree | None, right: Tree) -> str:
        return super()._either(left, right).replace(r"\pm\op", r"\pm \op")

    def _unsigned(self, body: Tree) -> tuple[str, int]:
        match body:
            case Sym(name):
                return self._names[name], ATOM
            case Num(value) if value.denominator != 1 and as_fraction(value):
                return f"\\tfrac{{{value.numerator}}}{{{value.denominator}}}", ATOM
            case Num(value):
                return decimal(value), ATOM
            case Call(function, arguments):
                return self._call(function, arguments), ATOM
            case Pow(base, exponent):
                text = self._within(base, ATOM)
                if isinstance(base, (Quot, Call, Pow)):
                    text = bracketed(text)
                return f"{text}^{{{exponent}}}", ATOM
            case Quot(numerator, denominator):
                return self._quotient(numerator, denominator)
            case Prod(factors):
                return self._product(factors), PRODUCT
            case PlusMinus(left, right):
                return self._either(left, right), SUM
            case Pi():
                return self.pi, ATOM
            case _:
                return super()._unsigned(body)

    def _product(self, factors: Sequence[Tree]) -> str:
        match factors:
            case (Num(value), Pi()) if value.denominator != 1:
                return f"{'' if value.numerator == 1 else value.numerator}\\pi/{value.denominator}"
        parts = [self._within(factor, ATOM) for factor in factors]
        text = parts[0]
        for before, part in pairwise(parts):
            if before[-1].isdigit() and part[0].isdigit():
                text += r" \cdot "
            elif _APART.match(part) or before.startswith(r"\mathrm") or _APART.match(before):
                text += r" \, "
            else:
                text += " "
            text += part
        return text

    def _quotient(self, numerator: Tree, denominator: Tree) -> tuple[str, int]:
        upper, lower = self._signed(numerator), self._signed(denominator)
        if Pi() in (numerator, *children(numerator)) and isinstance(denominator, Num):
            return f"{upper}/{lower}", PRODUCT
        if max(width(upper), width(lower)) <= _WIDEST_SOLID:
            return f"\\frac{{{upper}}}{{{lower}}}", ATOM
        return f"{self._within(numerator, PRODUCT)} / {self._within(denominator, ATOM)}", PRODUCT

    def _call(self, function: str, arguments: tuple[Tree, ...]) -> str:
        if function == "hypot":
            x, y = arguments
            return self._call("sqrt", (Sum((Pow(x, 2), Pow(y, 2))),))
        texts = [self._signed(argument) for argument in arguments]
        if function == "sqrt":
            solid = width(texts[0]) <= _WIDEST_SOLID
            return f"\\sqrt{{{texts[0]}}}" if solid else f"{bracketed(texts[0])}^{{1/2}}"
        if function == "abs":
            size = ("\\biggl", "\\biggr") if r"\frac" in texts[0] else ("", "")
            return f"{size[0]}\\lvert {texts[0]} {size[1]}\\rvert"
        if function in ("sin", "cos"):
            plain = isinstance(arguments[0], (Sym, Pi))
            return f"\\{function} {texts[0]}" if plain else f"\\{function}{bracketed(texts[0])}"
        # A left superscript after a comma needs air.
        separator = r",\, " if any(text.startswith("{}^") for text in texts[1:]) else ", "
        return f"\\operatorname{{{self.functions.get(function, function)}}}{bracketed(separator.join(texts))}"
