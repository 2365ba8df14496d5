"""Statements of Python that fit a page: heads of functions, assignments, comments, tuples of names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from kinsym.emit.source.banner import python_comment
from kinsym.emit.source.wrapping import WIDTH, cut, fill


def head(name: str, positional: list[str], keywords: Sequence[str] = ()) -> str:
    """The first line of a function, or its lines if it is long.

    >>> head("fk", ["q"], ["a2=0.5"])
    'def fk(q, *, a2=0.5):'
    """
    arguments = ", ".join([*positional, *(["*", *keywords] if keywords else [])])
    line = f"def {name}({arguments}):"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"def {name}(", *(f"    {part}" for part in cut(arguments, WIDTH - 4)), "):"])


def code(target: str, value: str, depth: int = 1) -> str:
    """An assignment, or a bare call without a target; a long value goes on lines of its own, inside its brackets."""
    indent = " " * 4 * depth
    target = indent + (f"{target} = " if target and target != "return" else f"{target} ".lstrip())
    line = target + value
    if len(line) <= WIDTH:
        return line
    called, bracket, arguments = value.partition("(")
    if bracket and called.replace(".", "").replace("_", "").isalnum() and _closes_last(arguments):
        opening, body = f"{target}{called}(", arguments[:-1]
    else:
        opening, body = f"{target}(", value
    return "\n".join([opening, *(f"{indent}    {part}" for part in cut(body, WIDTH - len(indent) - 4)), f"{indent})"])


def _closes_last(text: str) -> bool:
    """Whether the bracket that is open before a text is closed by its last letter."""
    depth = 1
    for position, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if depth == 0:
            return position == len(text) - 1
    return False


def comment(text: str, depth: int = 1) -> str:
    """A comment at a depth of blocks."""
    indent = " " * 4 * depth
    return "\n".join(f"{indent}# {line}" for line in fill(python_comment(text), WIDTH - len(indent) - 2))


def names_tuple(names: Iterable[str]) -> str:
    """A tuple of strings."""
    items = [f'"{name}"' for name in names]
    return f"({', '.join(items)}{',' if len(items) == 1 else ''})"
