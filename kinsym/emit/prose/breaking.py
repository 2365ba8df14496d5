"""Long formulas broken into lines where a lecturer would break them.

A formula arrives as printed text. It may break before a ``+``, a ``-`` or a ``±`` that stands between spaces and
after a comma, and it prefers the break that is nested least: the reader then sees whole products, and a continuation
line moves right with every bracket that is open where it starts. A product is broken only if it fills a line alone.
Terminal text and LaTeX share this; only the measure of width differs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

#: A break earlier than this share of the line leaves a gap that reads worse than a deeper break.
_SHORTEST = 0.4


@dataclass(frozen=True)
class Line:
    """A line of a broken formula: the brackets open where it starts, and whether it starts inside a product."""

    depth: int
    text: str
    inside_product: bool = False


@dataclass(frozen=True, kw_only=True)
class Syntax:
    """What the breaker must know of a language: its signs, its brackets, and the braces that never break."""

    signs: tuple[str, ...]
    opening: tuple[str, ...] = ("(", "[")
    closing: tuple[str, ...] = (")", "]")
    solid: tuple[str, str] | None = None
    #: Words that stand between two factors; a line starts after them.
    between: tuple[str, ...] = ()


TEXT = Syntax(signs=("+", "-", "±", "+-"))
LATEX = Syntax(
    signs=("+", "-", r"\pm"),
    opening=("(", "[", r"\lbrace", r"\lvert"),
    closing=(")", "]", r"\rbrace", r"\rvert"),
    solid=("{", "}"),
    between=(r"\,", r"\cdot", "/"),
)


def _words(formula: str, syntax: Syntax) -> list[str]:
    """The formula cut at its spaces, except inside braces."""
    words: list[str] = []
    solid = 0
    for word in formula.split(" "):
        if solid:
            words[-1] += f" {word}"
        else:
            words.append(word)
        if syntax.solid:
            solid += word.count(syntax.solid[0]) - word.count(syntax.solid[1])
    return words


def _pieces(formula: str, syntax: Syntax) -> list[Line]:
    """The formula cut before every word that may start a line, each piece with its bracket depth.

    >>> [(piece.depth, piece.text, piece.inside_product) for piece in _pieces("a*(b - c) + d", TEXT)]
    [(0, 'a*(b', False), (1, '- c)', False), (0, '+ d', False)]
    """
    pieces: list[Line] = []
    depth = 0
    before = ""
    for word in _words(formula, syntax):
        apart = word in syntax.signs or (before.endswith(",") and before not in syntax.between)
        if not pieces or apart:
            pieces.append(Line(depth, word))
        elif before in syntax.signs or word in syntax.between or before.endswith(syntax.opening):
            pieces[-1] = Line(pieces[-1].depth, f"{pieces[-1].text} {word}", pieces[-1].inside_product)
        else:
            pieces.append(Line(depth, word, inside_product=True))
        depth += sum(word.count(mark) for mark in syntax.opening) - sum(word.count(mark) for mark in syntax.closing)
        before = word
    return pieces


def _end(pieces: Sequence[Line], ends: Sequence[float], room: float) -> int:
    """How many of the pieces that fit make the next line."""
    choices = range(1, len(ends) + 1)
    signs = [k for k in choices if not pieces[k].inside_product]
    long = [k for k in signs if ends[k - 1] >= _SHORTEST * room]
    return min(long or signs or choices, key=lambda k: (pieces[k].depth, -k))


def broken(
    formula: str, width: float, *, syntax: Syntax = TEXT, measure: Callable[[str], float] = len, indent: float = 2
) -> tuple[Line, ...]:
    """The lines of a formula, each at most ``width`` wide unless a single factor is wider.

    ``indent`` is the width by which a continuation line moves right for each open bracket.

    >>> [line.text for line in broken("a*(b - c) + d*(e - f)", 12)]
    ['a*(b - c)', '+ d*(e - f)']
    """
    rest = _pieces(formula, syntax)
    space = measure(" ")
    lines: list[Line] = []
    while rest:
        room = width - indent * rest[0].depth
        ends = [measure(rest[0].text)]
        for piece in rest[1:]:
            if ends[-1] + space + measure(piece.text) > room:
                break
            ends.append(ends[-1] + space + measure(piece.text))
        count = len(rest) if len(ends) == len(rest) else _end(rest, ends, room)
        lines.append(Line(rest[0].depth, " ".join(piece.text for piece in rest[:count]), rest[0].inside_product))
        rest = rest[count:]
    return tuple(lines)
