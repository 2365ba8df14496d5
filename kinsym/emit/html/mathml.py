"""Rows of MathML that a browser can break into lines.

Browsers do not break a formula. So a formula is a :class:`Row`: pieces that stay whole, each of them a ``math``
element of its own in the page, and between two of them a line may end. What is inside a root, a fraction or a
matrix is one piece.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape

from markupsafe import Markup

Row = tuple[str, ...]
"""MathML without the ``math`` element, in pieces between which a line may end; never empty."""

_LEAF = re.compile(r"</m[ino]>")
_FENCE = re.compile(r">([()\[\]{}])</mo>")
_BRACKETS = (("(", ")"), ("[", "]"), ("{", "}"))
#: A row with more leaves than this stands in brackets of plain height, between which lines can end.
_TALLEST = 20
#: A row with more leaves than this in all is given to the page in pieces.
_WHOLE = 26


def glued(*rows: Row) -> Row:
    """Rows one after the other, no line ending between them.

    >>> glued(("a", "b"), ("c", "d"))
    ('a', 'bc', 'd')
    """
    result: list[str] = [""]
    for first, *others in rows:
        result[-1] += first
        result += others
    return tuple(result)


def leaves(row: Row) -> int:
    """How many letters, numbers and signs a row has, which is near enough to how wide it is."""
    return sum(len(_LEAF.findall(piece)) for piece in row)


def grouped(row: Row) -> str:
    """A row as one element, for a place where a line cannot end."""
    return f"<mrow>{''.join(row)}</mrow>"


def identifier(letters: str, *, upright: bool = False) -> str:
    """A letter, slanted, or a word, upright."""
    variant = ' mathvariant="normal"' if upright and len(letters) == 1 else ""
    return f"<mi{variant}>{escape(letters)}</mi>"


def number(digits: str) -> str:
    """A number; a minus sign is none of its digits."""
    return f"<mn>{escape(digits)}</mn>"


def operator(sign: str, form: str = "infix") -> str:
    """A sign between two things: its space does not depend on where a line ends."""
    return f'<mo form="{form}">{escape(sign)}</mo>'


def fence(sign: str, *, stretchy: bool = False) -> str:
    """One bracket."""
    form = "prefix" if sign in "([{|" else "postfix"
    return f'<mo form="{form}" stretchy="{str(stretchy).lower()}">{sign}</mo>'


def bracketed(row: Row) -> Row:
    """A row in the brackets that its own brackets ask for: (a), [b (a)], {c [b (a)]}, as the lecture writes them."""
    depth = deepest = 0
    for mark in _FENCE.findall("".join(row)):
        depth += 1 if mark in "([{" else -1
        deepest = max(deepest, depth)
    left, right = _BRACKETS[deepest % len(_BRACKETS)]
    tall = "<mfrac" in "".join(row) and leaves(row) <= _TALLEST
    if tall:
        return (f"<mrow>{fence(left, stretchy=True)}{''.join(row)}{fence(right, stretchy=True)}</mrow>",)
    return glued((fence(left),), row, (fence(right),))


def matrix(rows: Iterable[Iterable[str]]) -> str:
    """A matrix of cells."""
    body = "".join("<mtr>" + "".join(f"<mtd>{cell}</mtd>" for cell in cells) + "</mtr>" for cells in rows)
    left, right = fence("[", stretchy=True), fence("]", stretchy=True)
    return f"<mrow>{left}<mtable>{body}</mtable>{right}</mrow>"


def math(row: Row) -> Markup:
    """A row for the page; a short one stays whole."""
    pieces = (grouped(row),) if leaves(row) <= _WHOLE else row
    return Markup("<wbr>".join(f"<math>{piece}</math>" for piece in pieces))
