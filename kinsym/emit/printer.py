"""Trees as source code, with the parentheses and minus signs that a person would write.

A sign is split off before anything is printed, so that ``a + (-1)*b`` becomes ``a - b`` wherever the minus hides: in
a product, in a quotient's numerator, in an odd power. What differs between languages is the name of a function and
of pi; a language is a subclass that states them.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import ClassVar

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.errors import KinsymError

SUM, PRODUCT, ATOM = 1, 2, 3


def decimal(value: Fraction) -> str:
    """The shortest decimal that reads back as the double nearest to a rational number.

    >>> decimal(Fraction(1, 3)), decimal(Fraction(2)), decimal(Fraction(1, 2**46))
    ('0.3333333333333333', '2.0', '1.4210854715202004e-14')
    """
    try:
        nearest = value.numerator / value.denominator
    except OverflowError:
        nearest = float("inf")
    if abs(nearest) == float("inf") or (nearest == 0 and value != 0):
        raise KinsymError("a number is outside the range of double precision. Use another unit of length")
    return repr(nearest)


def split_sign(tree: Tree) -> tuple[bool, Tree]:
    """Whether a tree is negative as it is written, and the tree without that sign.

    >>> from kinsym.algebra.tree import negated
    >>> split_sign(Quot(negated(Sym("a")), Sym("b")))
    (True, Quot(numerator=Sym(name='a'), denominator=Sym(name='b')))
    """
    match tree:
        case Num(value):
            return value < 0, Num(abs(value))
        case Prod(factors):
            parts = [_split_factor(factor) for factor in factors]
            bodies = [body for _, body in parts if body != Num(Fraction(1))] or [Num(Fraction(1))]
            minus = sum(sign for sign, _ in parts) % 2 == 1
            return minus, bodies[0] if len(bodies) == 1 else Prod(tuple(bodies))
        case Quot(numerator, denominator):
            (above, top), (below, bottom) = _split_factor(numerator), _split_factor(denominator)
            return above != below, Quot(top, bottom)
        case Pow(base, exponent):
            minus, body = split_sign(base)
            return minus and exponent % 2 == 1, Pow(body, exponent)
        case _:
            return False, tree


def _split_factor(tree: Tree) -> tuple[bool, Tree]:
    """The same for a factor: a sum of negative terms only becomes minus the sum of their opposites."""
    if isinstance(tree, Sum) and all(split_sign(term)[0] for term in tree.terms):
        return True, Sum(tuple(split_sign(term)[1] for term in tree.terms))
    return split_sign(tree)


class Printer:
    """Prints a tree as an expression of a language with the usual infix operators."""

    functions: ClassVar[Mapping[str, str]]
    pi: ClassVar[str]

    def __call__(self, tree: Tree) -> str:
        """The expression, without parentheses around it."""
        return self._signed(tree)

    def _signed(self, tree: Tree) -> str:
        minus, body = split_sign(tree)
        return "-" + self._within(body, PRODUCT) if minus else self._within(body, SUM)

    def _within(self, body: Tree, least: int) -> str:
        """A tree without a sign of its own, in parentheses if it binds weaker than ``least``."""
        text, strength = self._unsigned(body)
        return text if strength >= least else f"({text})"

    def _unsigned(self, body: Tree) -> tuple[str, int]:
        match body:
            case Num(value):
                return decimal(value), ATOM
            case Sym(name):
                return name, ATOM
            case Pi():
                return self.pi, ATOM
            case Call(function, arguments):
                return f"{self.functions[function]}({', '.join(map(self._signed, arguments))})", ATOM
            case Sum(terms):
                return self._sum(terms), SUM
            case Prod(factors):
                return " * ".join(self._within(factor, PRODUCT) for factor in factors), PRODUCT
            case Pow(base, exponent):
                return " * ".join([self._within(base, PRODUCT)] * exponent), PRODUCT
            case Quot(numerator, denominator):
                return f"{self._within(numerator, PRODUCT)} / {self._within(denominator, ATOM)}", PRODUCT
            case PlusMinus():
                raise TypeError("a formula with two signs is for readers; code has branches")

    def _sum(self, terms: tuple[Tree, ...]) -> str:
        text = ""
        for term in terms:
            minus, body = split_sign(term)
            # A sum under a plus needs no parentheses; it is flattened so that its own first sign is seen.
            if not minus and isinstance(body, Sum):
                inner = self._sum(body.terms)
                text += inner if not text else f" - {inner[1:]}" if inner.startswith("-") else f" + {inner}"
            elif text:
                text += f" {'-' if minus else '+'} {self._within(body, PRODUCT)}"
            else:
                text = f"{'-' if minus else ''}{self._within(body, PRODUCT)}"
        return text
