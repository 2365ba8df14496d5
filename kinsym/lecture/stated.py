"""What kinsym states of a system by the lecture's methods, as forms of equations.

The methods that a chapter teaches are applied to its arm, and their numbered equations are collected. A side is a
shape, a matrix of shapes, or a product of named matrices, each with its mark for an inverse or a transpose.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any, TypeAlias

from kinsym.lecture.chapter import Chapter
from kinsym.lecture.notation import Apply, Binary, Grid, Name, Node
from kinsym.lecture.printed import Printed, chain_names
from kinsym.lecture.shape import NameOf, NoShape, Shape, number, shape_of_tree
from kinsym.lecture.system import System, system
from kinsym.methods import METHODS
from kinsym.methods.document import INVERSE, TRANSPOSE, Factor, Matrix, Product, Side
from kinsym.methods.half_angle import general
from kinsym.robot import bind

Form: TypeAlias = tuple[Any, ...]
"""``("scalar", shape)``, ``("matrix", rows)`` or ``("product", factors)``."""

GENERAL = "half_angle_of_any_equation"
"""The reduction of a cos(theta) + b sin(theta) = c with letters for its coefficients, which needs no arm."""

_LINK = re.compile(r"[TA]_([0-9])_([0-9])")
_MARKS = {"inv": INVERSE, "transpose": TRANSPOSE}


def equation(left: Form, right: Form) -> frozenset[Form] | tuple[Form, ...]:
    """An equation without regard to its sides, or to a sign on both of them."""
    if left[0] == right[0] == "scalar":
        zero = number(0)[1]
        (first, one), (second, other) = left[1], right[1]
        sign = 1 if zero in (one, other) else first * second
        return (sign, *sorted((one, other), key=repr))
    return frozenset((left, right))


@lru_cache(maxsize=64)
def stated(arm: System, methods: tuple[str, ...]) -> frozenset[Any]:
    """The equations that some methods state of an arm.

    Raises DoesNotApply where one of them does not fit the arm.
    """
    found: set[Any] = set()
    names = chain_names(arm.chain)
    for method in methods:
        derivation = general() if method == GENERAL else METHODS[method](arm.robot)
        for item in derivation.equations:
            if item.sign != "=":
                continue
            try:
                found.add(equation(side_form(item.left, names), side_form(item.right, names)))
            except NoShape:
                continue
    return frozenset(found)


def special(name: str, given: Mapping[str, str]) -> System:
    """The system of a robot with numbers for some of its parameters: the arm of a special case."""
    numbers = {text: Fraction(value) for text, value in given.items() if value.isdecimal()}
    return System(bind(system(name).robot, numbers)) if numbers else system(name)


def side_form(side: Side, names: NameOf) -> Form:
    match side:
        case Matrix(rows):
            return "matrix", tuple(tuple(plain(shape_of_tree(cell, names)) for cell in row) for row in rows)
        case Product(factors):
            return _single([_factor(factor, names) for factor in factors])
        case _:
            return "scalar", plain(shape_of_tree(side, names))


def _factor(factor: Factor | Matrix, names: NameOf) -> Any:
    return (canonical(factor.name), factor.mark) if isinstance(factor, Factor) else side_form(factor, names)


def _single(factors: list[Any]) -> Form:
    """A product of one matrix that is written out is that matrix."""
    return factors[0] if len(factors) == 1 and factors[0][0] == "matrix" else ("product", tuple(factors))


def canonical(name: str) -> str:
    """One name for a link and for a vector: T_0_1 is A_0_1, p_vec is p."""
    if found := _LINK.fullmatch(name):
        return f"T_{found[1]}_{found[2]}"
    return name.removesuffix("_vec")


def plain(shape: Shape) -> Shape:
    """A shape without the sign ± in front of it: the lecture lists such values as branches."""
    sign, key = shape
    if key[0] != "product" or ("name", "pm") not in key[2]:
        return shape
    above = tuple(factor for factor in key[2] if factor != ("name", "pm"))
    if key[1] == 1 and len(above) == 1 and not key[3]:
        return sign, above[0]
    return sign, ("product", key[1], above, key[3])


class Lecture:
    """The same forms of what the lecture writes."""

    def __init__(self, chapter: Chapter, arm: System, aliases: Mapping[str, str]) -> None:
        self.printed = Printed(chapter, arm)
        self.aliases = aliases

    def sides(self, node: Node) -> Iterator[Form]:
        """The forms that a member of an equation may be stated in: a vector's name is a symbol or a matrix."""
        shapes = self.printed.written(node, self.aliases)
        if isinstance(node, Grid):
            if shapes is not None:
                yield "matrix", shapes
            return
        factors = self._factors(node)
        if factors is not None:
            yield _single(factors)
        if shapes is not None:
            yield "scalar", plain(shapes[0][0])

    def _factors(self, node: Node) -> list[Any] | None:
        """A product of matrices as its factors; None for anything else."""
        match node:
            case Grid():
                shapes = self.printed.written(node, self.aliases)
                return None if shapes is None else [("matrix", shapes)]
            case Name(text) if self._is_matrix(text):
                return [(canonical(self.aliases.get(text, text)), "")]
            case Apply("hom", (vector,)):
                return self._factors(vector)
            case Apply("inv" | "transpose" as function, (matrix,)):
                inner = self._factors(matrix)
                if inner is None or any(mark for _, mark in inner):
                    return None
                return [(text, _MARKS[function]) for text, _ in reversed(inner)]
            case Binary("*", left, right):
                before, after = self._factors(left), self._factors(right)
                return None if before is None or after is None else before + after
            case _:
                return None

    def _is_matrix(self, text: str) -> bool:
        return (
            text.endswith("_vec") or re.fullmatch(r"[TAR]_\w+_\w+|[AR][1-9]|[uvwqp]0|P_\w+|p_in[0-9]", text) is not None
        )
