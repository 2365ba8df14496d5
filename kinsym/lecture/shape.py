"""The form of a formula: its expression tree up to the order of terms and factors and the place of a minus sign.

The lecture's text and kinsym's trees become the same :data:`Shape` exactly if they are written alike. A bracket stays a
bracket: a (b + c) and a b + a c are two shapes. Shorthand stands for what it abbreviates, so that c12 is cos(theta1 +
theta2), and 1 - cos(theta) is what the lecture calls v(theta).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import Any, TypeAlias

from kinsym.algebra import tree as trees
from kinsym.lecture.notation import Apply, Binary, Name, Negative, Node, Number, Power

Key: TypeAlias = tuple[Any, ...]
Shape: TypeAlias = tuple[int, Key]
"""A sign and a form that begins without one."""
NameOf: TypeAlias = Callable[[str], Shape]


class NoShape(ValueError):
    """A formula of a kind that has no printed form of its own."""


def number(value: Fraction | int) -> Shape:
    """A number."""
    return (-1 if value < 0 else 1), ("number", abs(Fraction(value)))


def name(text: str) -> Shape:
    """A symbol."""
    return 1, ("name", text)


def circular(function: str, terms: Iterable[tuple[str, int]]) -> Shape:
    """A cosine or sine of a sum of angles."""
    return 1, (function, tuple(sorted(terms)))


def total(parts: Iterable[Shape]) -> Shape:
    """A sum; sums inside it are part of it."""
    flat: list[Shape] = []
    for sign, key in parts:
        if key[0] == "sum":
            flat += [(sign * inner, term) for inner, term in key[1]]
        elif key != ("number", Fraction(0)):
            flat.append((sign, key))
    flat.sort(key=lambda shape: repr(shape[1]))
    if not flat:
        return number(0)
    if len(flat) == 1:
        return flat[0]
    first = flat[0][0]
    return first, ("sum", tuple((sign * first, key) for sign, key in flat))


def product(above: Iterable[Shape], below: Iterable[Shape] = ()) -> Shape:
    """A product of factors over a product of others; products and quotients inside it are part of it."""
    sign, value = 1, Fraction(1)
    over: list[Key] = []
    under: list[Key] = []
    for factors, top, bottom in ((above, over, under), (below, under, over)):
        for factor, key in factors:
            sign *= factor
            inner, more, less = _parts(key)
            value = value * inner if top is over else value / inner
            top.extend(more)
            bottom.extend(less)
    if not value:
        return number(0)
    if ("name", "pm") in over:
        sign = 1
    if value == 1 and not under and len(over) == 1:
        return sign, over[0]
    if not over and not under:
        return sign, ("number", value)
    return sign, ("product", value, tuple(sorted(over, key=repr)), tuple(sorted(under, key=repr)))


def _parts(key: Key) -> tuple[Fraction, tuple[Key, ...], tuple[Key, ...]]:
    """A factor as a number, factors and divisors."""
    if key[0] == "product":
        return key[1:]
    return (key[1], (), ()) if key[0] == "number" else (Fraction(1), (key,), ())


def power(base: Shape, exponent: int) -> Shape:
    """A power is a product of equal factors."""
    return product([base] * exponent)


def minus(shape: Shape) -> Shape:
    """The same with the other sign."""
    return -shape[0], shape[1]


def call(function: str, arguments: Iterable[Shape]) -> Shape:
    """A function of arguments."""
    return 1, ("call", function, tuple(arguments))


def shape_of_node(node: Node, name_of: NameOf) -> Shape:
    """The shape of a formula of the lecture; NoShape for matrices."""

    def inner(part: Node) -> Shape:
        return shape_of_node(part, name_of)

    match node:
        case Number(value):
            return number(value)
        case Name(text):
            return name_of(text)
        case Negative(body):
            return minus(inner(body))
        case Power(base, exponent):
            return power(inner(base), exponent)
        case Binary("+", left, right):
            return total((inner(left), inner(right)))
        case Binary("-", left, right):
            return total((inner(left), minus(inner(right))))
        case Binary("*", left, right):
            return product((inner(left), inner(right)))
        case Binary(_, left, right):
            return product((inner(left),), (inner(right),))
        case Apply("v", (angle,)):
            return total((number(1), minus(circular("cos", _terms(angle)))))
        case Apply("cos" | "sin" as function, (angle,)):
            return circular(function, _terms(angle))
        case Apply(function, arguments) if function in ("sqrt", "acos", "asin", "atan", "atan2", "tan"):
            return call(function, map(inner, arguments))
        case _:
            raise NoShape("a matrix")


def _terms(node: Node) -> list[tuple[str, int]]:
    """The angles in a sum."""
    match node:
        case Name(text):
            return [(text, 1)]
        case Apply("deg", (Number(value),)) if value == 180:
            return [("pi", 1)]
        case Negative(body):
            return [(text, -count) for text, count in _terms(body)]
        case Binary("+", left, right):
            return _terms(left) + _terms(right)
        case Binary("-", left, right):
            return _terms(left) + _terms(Negative(right))
        case _:
            raise NoShape("an angle that is no sum")


def _tree_terms(tree: trees.Tree) -> list[tuple[str, int]]:
    """The angles in a sum that is a tree."""
    match tree:
        case trees.Sym(text):
            return [(text, 1)]
        case trees.Pi():
            return [("pi", 1)]
        case trees.Prod((trees.Num(value), trees.Sym(text))) if value == -1:
            return [(text, -1)]
        case trees.Sum(terms):
            return [pair for term in terms for pair in _tree_terms(term)]
        case _:
            raise NoShape("an angle that is no sum")


def shape_of_tree(tree: trees.Tree, name_of: NameOf) -> Shape:
    """The shape of a tree as kinsym prints it."""

    def inner(part: trees.Tree) -> Shape:
        return shape_of_tree(part, name_of)

    match tree:
        case trees.Num(value):
            return number(value)
        case trees.Sym(text):
            return name_of(text)
        case trees.Sum(terms):
            return total(map(inner, terms))
        case trees.Prod(factors):
            return product(map(inner, factors))
        case trees.Pow(base, exponent):
            return power(inner(base), exponent)
        case trees.Quot(numerator, denominator):
            return product((inner(numerator),), (inner(denominator),))
        case trees.PlusMinus(left, right):
            either = product((name("pm"), inner(right)))
            return either if left is None else total((inner(left), either))
        case trees.Call("v", (trees.Sym(angle),)):
            return total((number(1), minus(circular("cos", [(angle, 1)]))))
        case trees.Call("cos" | "sin" as function, (angle,)):
            return circular(function, _tree_terms(angle))
        case trees.Call(function, arguments):
            return call(function, map(inner, arguments))
        case _:
            raise NoShape("pi")


_SHORTHAND = re.compile(r"([cs])([1-9]+)")


def lecture_names(base: str, aliases: Mapping[str, str] = MappingProxyType({})) -> NameOf:
    """The lecture's symbols; ``base`` is what its shorthand calls an angle, theta or q, ``aliases`` other names."""

    def name_of(text: str) -> Shape:
        found = _SHORTHAND.fullmatch(text)
        if not found:
            return name(aliases.get(text, text))
        return circular("cos" if found[1] == "c" else "sin", [(base + digit, 1) for digit in found[2]])

    return name_of
