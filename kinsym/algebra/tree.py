"""Expressions as they are printed.

A polynomial says what a quantity is; a :class:`Tree` says how it is written. Every printer (terminal, NumPy, C,
LaTeX) walks the same tree, so the four of them show the same expression.

Names are plain identifiers. ``c23`` and ``s23`` are the cosine and sine of ``theta23`` = theta2 + theta3,
``p16_x`` is an entry of the pose T_1_6: the columns of a pose are u, v, w, p, its rows x, y, z.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any


class _Hashed:
    """An expression hashes its parts once: large ones are keys of dictionaries many times over."""

    def __hash__(self) -> int:
        stored: int | None = self.__dict__.get("_hash")
        if stored is None:
            stored = self.__dict__["_hash"] = hash((type(self).__name__, *self._parts()))
        return stored

    def __reduce__(self) -> tuple[Any, ...]:
        """Without the hash, which another process would calculate otherwise."""
        return type(self), self._parts()

    def _parts(self) -> tuple[Any, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]


@dataclass(frozen=True)
class Num(_Hashed):
    """An exact number."""

    value: Fraction
    __hash__ = _Hashed.__hash__


@dataclass(frozen=True)
class Sym:
    """A named quantity."""

    name: str


@dataclass(frozen=True)
class Sum(_Hashed):
    """Two or more terms; a term that is negative is a :class:`Prod` whose first factor is a negative Num."""

    terms: tuple[Tree, ...]
    __hash__ = _Hashed.__hash__


@dataclass(frozen=True)
class Prod(_Hashed):
    """Two or more factors; a sign or a number comes first."""

    factors: tuple[Tree, ...]
    __hash__ = _Hashed.__hash__


@dataclass(frozen=True)
class Pow:
    """A power with an integer exponent of two or more. Printers of code write it as a product."""

    base: Tree
    exponent: int


@dataclass(frozen=True)
class Quot:
    """A quotient."""

    numerator: Tree
    denominator: Tree


@dataclass(frozen=True)
class Call:
    """A function: sqrt, sin, cos, abs, sign, atan2(y, x), hypot(x, y)."""

    function: str
    arguments: tuple[Tree, ...]


@dataclass(frozen=True)
class PlusMinus:
    """``left ± right``; occurs in formulas shown to a reader, never in generated code."""

    left: Tree | None
    right: Tree


@dataclass(frozen=True)
class Pi:
    """The number pi."""


Tree = Num | Sym | Sum | Prod | Pow | Quot | Call | PlusMinus | Pi


@dataclass(frozen=True, kw_only=True)
class Definition:
    """``name = value``; everything in ``value`` is defined earlier, is an entry of the pose or a parameter."""

    name: str
    value: Tree


ZERO = Num(Fraction(0))
ONE = Num(Fraction(1))


def children(tree: Tree) -> tuple[Tree, ...]:
    """The direct parts of a tree."""
    match tree:
        case Sum(terms):
            return terms
        case Prod(factors):
            return factors
        case Pow(base, _):
            return (base,)
        case Quot(numerator, denominator):
            return (numerator, denominator)
        case Call(_, arguments):
            return arguments
        case PlusMinus(left, right):
            return (right,) if left is None else (left, right)
        case _:
            return ()


def symbols(tree: Tree) -> Iterator[str]:
    """Every name in a tree, in order of appearance, repeats included."""
    if isinstance(tree, Sym):
        yield tree.name
    for child in children(tree):
        yield from symbols(child)


def negative(tree: Tree) -> bool:
    """Whether a tree is written with a leading minus sign."""
    if isinstance(tree, Num):
        return tree.value < 0
    return isinstance(tree, Prod) and negative(tree.factors[0])


def negated(tree: Tree) -> Tree:
    """The same tree with the opposite sign."""
    match tree:
        case Num(value):
            return Num(-value)
        case Prod((Num(value), *rest)):
            factors = tuple(rest) if value == -1 else (Num(-value), *rest)
            return factors[0] if len(factors) == 1 else Prod(factors)
        case Prod(factors):
            return Prod((Num(Fraction(-1)), *factors))
        case Sum(terms):
            return Sum(tuple(negated(term) for term in terms))
        case _:
            return Prod((Num(Fraction(-1)), tree))


def opposite(tree: Tree) -> Tree:
    """The negative of a tree, zero included."""
    return tree if tree == ZERO else negated(tree)


def sum_of_squares(*trees: Tree) -> Tree:
    """``a^2 + b^2 + ...``, ordered by name; zeros vanish and signs drop out."""
    bases = sorted((negated(t) if negative(t) else t for t in trees), key=lambda t: tuple(symbols(t)))
    return add(*(mul(t, t) if isinstance(t, Num) else Pow(t, 2) for t in bases))


def add(*terms: Tree) -> Tree:
    """The sum of trees; nested sums are flattened, numbers are added up and come last, or first to save a minus."""
    total = Fraction(0)
    flat: list[Tree] = []
    for term in terms:
        for part in term.terms if isinstance(term, Sum) else (term,):
            if isinstance(part, Num):
                total += part.value
            else:
                flat.append(part)
    if total or not flat:
        flat.insert(0 if total > 0 and flat and negative(flat[0]) else len(flat), Num(total))
    return flat[0] if len(flat) == 1 else Sum(tuple(flat))


def sub(left: Tree, right: Tree) -> Tree:
    """``left - right``; equal trees cancel."""
    return ZERO if left == right else add(left, opposite(right))


def mul(*factors: Tree) -> Tree:
    """The product of trees; numbers are gathered in front, nested products are flattened."""
    number = Fraction(1)
    flat: list[Tree] = []
    for factor in factors:
        for part in factor.factors if isinstance(factor, Prod) else (factor,):
            if isinstance(part, Num):
                number *= part.value
            else:
                flat.append(part)
    if number == 0:
        return ZERO
    if number == -1 and len(flat) == 1 and isinstance(flat[0], Sum):
        return negated(flat[0])
    if number != 1 or not flat:
        flat.insert(0, Num(number))
    return flat[0] if len(flat) == 1 else Prod(tuple(flat))


def replaced(tree: Tree, values: Mapping[str, Tree]) -> Tree:
    """The tree with names replaced by other trees.

    >>> replaced(Quot(Sym("a"), Sym("b")), {"b": Sym("d")})
    Quot(numerator=Sym(name='a'), denominator=Sym(name='d'))
    """
    match tree:
        case Sym(name):
            return values.get(name, tree)
        case Sum(terms):
            return Sum(tuple(replaced(term, values) for term in terms))
        case Prod(factors):
            return Prod(tuple(replaced(factor, values) for factor in factors))
        case Pow(base, exponent):
            return Pow(replaced(base, values), exponent)
        case Quot(numerator, denominator):
            return Quot(replaced(numerator, values), replaced(denominator, values))
        case Call(function, arguments):
            return Call(function, tuple(replaced(argument, values) for argument in arguments))
        case _:
            return tree
