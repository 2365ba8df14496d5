"""Lines of code that fit a page.

A long expression is cut where it is nested least, before an operator or after a comma, as a programmer would do by
hand; the text of a comment is filled like prose.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

WIDTH = 110
#: A cut before this share of the line leaves a gap that reads worse than a deeper cut.
_SHORTEST = 0.45


def _cuts(text: str) -> Iterator[tuple[int, int, int]]:
    """Places where a line may end: (depth of brackets, 0 for + - && and commas but 1 for * /, position)."""
    depth = 0
    for position, letter in enumerate(text):
        if letter in "([{":
            depth += 1
        elif letter in ")]}":
            depth -= 1
        elif letter == " ":
            if text[position - 1] == ",":
                yield depth, 0, position
            elif text[position + 1 : position + 3] in ("+ ", "- "):
                yield depth, 0, position
            elif text[position + 1 : position + 4] == "&& ":
                yield depth, 0, position
            elif text[position + 1 : position + 3] in ("* ", "/ "):
                yield depth, 1, position


def cut(text: str, first: int, others: int | None = None) -> list[str]:
    """An expression in lines of at most ``first`` and then ``others`` letters, as far as it can be cut.

    >>> cut("a * (b + c) + d * (e + f)", 20)
    ['a * (b + c)', '+ d * (e + f)']
    """
    lines, width = [], first
    while len(text) > width:
        cuts = [place for place in _cuts(text) if place[2] <= width]
        good = [place for place in cuts if place[2] >= _SHORTEST * width] or cuts
        if not good:
            break
        _, _, position = min(good, key=lambda place: (place[0], place[1], -place[2]))
        lines.append(text[:position])
        text, width = text[position + 1 :], first if others is None else others
    return [*lines, text]


def fill(text: str, width: int) -> list[str]:
    """Prose in lines of at most ``width`` letters; a word that is longer stays whole."""
    return textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False) or [""]
