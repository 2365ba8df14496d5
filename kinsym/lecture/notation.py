"""The lecture's notation, read safely.

A formula is text such as ``c1*(a1 + a2*c2) - s1*d2`` or ``inv(T_0_1)*T_0_6``. Python's ``ast`` parses it, a whitelist
turns it into the few kinds of :data:`Node`, and nothing is ever evaluated as Python. What a name means is not decided
here.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from fractions import Fraction

from kinsym.errors import KinsymError

LONGEST = 400
DEEPEST = 40
LARGEST_POWER = 4

FUNCTIONS = {
    "sin": 1,
    "cos": 1,
    "tan": 1,
    "asin": 1,
    "acos": 1,
    "atan": 1,
    "atan2": 2,
    "sqrt": 1,
    "v": 1,
    "deg": 1,
    "R_X": 1,
    "R_Y": 1,
    "R_Z": 1,
    "D_X": 1,
    "D_Z": 1,
    "Screw_X": 2,
    "Screw_Z": 2,
    "inv": 1,
    "transpose": 1,
    "det": 1,
    "rot": 1,
    "vec": 3,
    "hom": 1,
    "dot": 2,
    "block": 2,
    "unit": 1,
    "frame_angle": 3,
    "x_angle": 1,
    "moved": 1,
    "abs": 1,
}
"""Functions and how many arguments they take: ``v`` is 1 - cos, ``R_X`` to ``Screw_Z`` are elementary transforms,
``unit(n)`` is the unit matrix, ``rot`` the rotation part of a transform, ``hom`` a vector with a 1 below it,
``block(R, p)`` a transform from its parts, ``frame_angle(a, b, n)`` the angle from a to b about n ``x_angle(T)``
that of T's x axis about z, and ``moved`` the value at another posture."""

OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
RELATIONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


@dataclass(frozen=True)
class Number:
    """An exact number."""

    value: Fraction


@dataclass(frozen=True)
class Name:
    """A named quantity of the lecture."""

    name: str


@dataclass(frozen=True)
class Negative:
    """``-body``."""

    body: Node


@dataclass(frozen=True)
class Binary:
    """``left + right``, and so on for ``-``, ``*`` (of matrices in this order) and ``/``."""

    operator: str
    left: Node
    right: Node


@dataclass(frozen=True)
class Power:
    """A power with a small whole exponent."""

    base: Node
    exponent: int


@dataclass(frozen=True)
class Apply:
    """A function of :data:`FUNCTIONS`."""

    function: str
    arguments: tuple[Node, ...]


@dataclass(frozen=True)
class Part:
    """An entry ``T[0, 3]`` of a matrix, counted from 0, a column ``T[:, 3]`` or the upper part ``T[:3, 3]`` of one."""

    base: Node
    row: int | str
    column: int


@dataclass(frozen=True)
class Grid:
    """A matrix written row by row."""

    rows: tuple[tuple[Node, ...], ...]


Node = Number | Name | Negative | Binary | Power | Apply | Part | Grid


class NotationError(KinsymError):
    """A formula of the lecture's data is not in its notation."""


def parse(text: str) -> Node:
    """The formula that a text states.

    Raises NotationError for whatever is not in the lecture's notation.

    >>> parse("a2*c2 - 1")
    Binary(operator='-', left=Binary(operator='*', left=Name(name='a2'), right=Name(name='c2')), \
right=Number(value=Fraction(1, 1)))
    """
    return _walk(_syntax(text), text, 0)


@dataclass(frozen=True)
class Relation:
    """A chain of comparisons ``a <= b <= c`` or a single formula compared with nothing."""

    members: tuple[Node, ...]
    signs: tuple[str, ...]


def parse_relation(text: str) -> Relation:
    """A condition such as ``l1 - l2 <= r <= l1 + l2``."""
    syntax = _syntax(text)
    if not isinstance(syntax, ast.Compare) or any(type(op) not in RELATIONS for op in syntax.ops):
        raise NotationError(f"{text!r} is no comparison. Write, for example, 'a < b'.")
    members = tuple(_walk(part, text, 0) for part in (syntax.left, *syntax.comparators))
    return Relation(members, tuple(RELATIONS[type(op)] for op in syntax.ops))


def parse_any(cells: object) -> Node:
    """A formula from a text, or a matrix from lists of rows; a list of texts is a column."""
    if isinstance(cells, str):
        return parse(cells)
    if isinstance(cells, list) and cells and all(isinstance(row, list) and row for row in cells):
        if len({len(row) for row in cells}) == 1:
            return Grid(tuple(tuple(parse(cell) for cell in row) for row in cells))
    elif isinstance(cells, list) and cells and all(isinstance(cell, str) for cell in cells):
        return Grid(tuple((parse(cell),) for cell in cells))
    raise NotationError(f"{cells!r} is neither a formula nor a matrix. Write a text, or rows of equal length.")


def names_of(node: Node) -> tuple[str, ...]:
    """Every name in a formula, in order of appearance, repeats included.

    >>> names_of(parse("c1*(a1 + c1)"))
    ('c1', 'a1', 'c1')
    """
    if isinstance(node, Name):
        return (node.name,)
    return tuple(name for child in children(node) for name in names_of(child))


def children(node: Node) -> tuple[Node, ...]:
    """The direct parts of a formula."""
    match node:
        case Negative(body):
            return (body,)
        case Binary(_, left, right):
            return (left, right)
        case Power(base, _) | Part(base, _, _):
            return (base,)
        case Apply(_, arguments):
            return arguments
        case Grid(rows):
            return tuple(cell for row in rows for cell in row)
        case _:
            return ()


def _syntax(text: str) -> ast.expr:
    if len(text) > LONGEST or not re.fullmatch(r"[A-Za-z0-9_+\-*/()\[\]:<>=!., ]+", text):
        raise NotationError(f"{text[:60]!a} is not in the lecture's notation. Write names, + - * / ** and ().")
    try:
        return ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise NotationError(f"{text!r} is not a formula. Look for a bracket or an operator too many.") from None


def _walk(syntax: ast.expr, text: str, depth: int) -> Node:
    if depth > DEEPEST:
        raise NotationError(f"{text!r} is nested too deeply. Name its parts.")

    def inner(part: ast.expr) -> Node:
        return _walk(part, text, depth + 1)

    match syntax:
        case ast.Constant(value=int(value)) if not isinstance(value, bool):
            return Number(Fraction(value))
        case ast.Name(id=name):
            return Name(name)
        case ast.UnaryOp(op=ast.USub(), operand=body):
            return Negative(inner(body))
        case ast.BinOp(left=base, op=ast.Pow(), right=ast.Constant(value=int(exponent))):
            if not 2 <= exponent <= LARGEST_POWER:
                raise NotationError(f"{text!r} has the power {exponent}. Powers go from 2 to {LARGEST_POWER}.")
            return Power(inner(base), exponent)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return Binary(OPERATORS[type(op)], inner(left), inner(right))
        case ast.Call(func=ast.Name(id=function), args=arguments, keywords=[]) if function in FUNCTIONS:
            if len(arguments) != FUNCTIONS[function]:
                raise NotationError(f"{text!r}: {function} takes {FUNCTIONS[function]} arguments.")
            return Apply(function, tuple(map(inner, arguments)))
        case ast.Subscript(value=base, slice=ast.Tuple(elts=[row, ast.Constant(value=int(column))])):
            return Part(inner(base), _row(row, text), column)
        case _:
            raise NotationError(f"{text!r} holds {ast.unparse(syntax)!r}, which the lecture's notation does not have.")


def _row(syntax: ast.expr, text: str) -> int | str:
    match syntax:
        case ast.Constant(value=int(row)):
            return row
        case ast.Slice(lower=None, upper=None, step=None):
            return ":"
        case ast.Slice(lower=None, upper=ast.Constant(value=3), step=None):
            return ":3"
        case _:
            raise NotationError(f"{text!r} takes a part that is neither an entry nor a column.")
