"""Mutants of a generated NumPy module, by its syntax tree; the text around a change stays as it is."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from tests.sabotage.mutant import (
    BRANCH,
    CONSTANT,
    GUARD,
    PARAMETER,
    SIGN,
    TRIG,
    Change,
    Mutant,
    nudged,
    other,
    text_mutants,
    turned,
)

LANGUAGE = "numpy"

_SIGNS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+")}
_WAVES = {"cos": "sin", "sin": "cos"}
_FUNCTION = re.compile(r"^def (\w+)", re.MULTILINE)
_LEAVES = (ast.Return, ast.Raise, ast.Continue, ast.Break)


def mutants(text: str, parameters: tuple[str, ...]) -> list[Mutant]:
    """Every mutant of one module."""
    return text_mutants(LANGUAGE, text, _Changes(text, parameters).all(), _FUNCTION)


class _Changes:
    def __init__(self, text: str, parameters: tuple[str, ...]) -> None:
        self._text, self._parameters = text, parameters
        self._tree = ast.parse(text)
        self._lines = [0]
        for line in text.splitlines(keepends=True):
            self._lines.append(self._lines[-1] + len(line))
        self._names = {node.id for node in ast.walk(self._tree) if isinstance(node, ast.Name)}

    def all(self) -> Iterator[Change]:
        """Every change, in the order of the tree."""
        for node in ast.walk(self._tree):
            match node:
                case ast.BinOp(op=ast.Add() | ast.Sub()):
                    yield self._operator(node.left, node.right, *_SIGNS[type(node.op)])
                case ast.BinOp(op=ast.BitAnd() | ast.BitOr()):
                    yield GUARD, self._end(node.left), self._end(node.right), ""
                case ast.AugAssign(op=ast.Add() | ast.Sub()):
                    old, new = _SIGNS[type(node.op)]
                    yield self._operator(node.target, node.value, f"{old}=", f"{new}=")
                case ast.AugAssign(op=ast.BitAnd()):
                    yield GUARD, self._start(node), self._end(node), "pass"
                case ast.UnaryOp(op=ast.USub()):
                    yield SIGN, self._start(node), self._start(node.operand), ""
                case ast.BoolOp(values=[*_, left, right]):
                    yield GUARD, self._end(left), self._end(right), ""
                case ast.Constant(value=float() as value):
                    yield CONSTANT, self._start(node), self._end(node), repr(nudged(value))
                case ast.Attribute(attr=("cos" | "sin") as wave):
                    yield TRIG, self._end(node) - len(wave), self._end(node), _WAVES[wave]
                case ast.Name(ctx=ast.Load()):
                    yield from self._name(node)
                case ast.If():
                    leaves = isinstance(node.body[0], _LEAVES)
                    yield GUARD if leaves else BRANCH, self._start(node.test), self._end(node.test), "False"
                case ast.IfExp():
                    for value in ("False", "True"):
                        yield BRANCH, self._start(node.test), self._end(node.test), value
                case ast.For(iter=ast.Call(func=ast.Name(id="enumerate"))):
                    start, end = self._start(node.iter), self._end(node.iter)
                    yield BRANCH, start, end, f"list({self._text[start:end]})[:-1]"
                case ast.Return(value=ast.Tuple(elts=[ast.Tuple() as one, ast.Tuple() as two])):
                    yield BRANCH, self._end(one), self._end(two), ","

    def _name(self, node: ast.Name) -> Iterator[Change]:
        for kind, name in ((TRIG, turned(node.id)), (PARAMETER, other(node.id, self._parameters))):
            if name in self._names:
                yield kind, self._start(node), self._end(node), str(name)

    def _operator(self, left: ast.expr, right: ast.expr, old: str, new: str) -> Change:
        place = self._text.index(old, self._end(left), self._start(right))
        return SIGN, place, place + len(old), new

    def _start(self, node: ast.expr | ast.stmt) -> int:
        return self._offset(node.lineno, node.col_offset)

    def _end(self, node: ast.expr | ast.stmt) -> int:
        return self._offset(node.end_lineno or 0, node.end_col_offset or 0)

    def _offset(self, line: int, column: int) -> int:
        """A place in the text; the tree counts columns in bytes."""
        start = self._lines[line - 1]
        row = self._text[start : self._lines[line]]
        return start + len(row.encode()[:column].decode())
