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


#: How late an operator is taken for a cut; a space after a comma counts as 0.
_RANKS = {"+": 0, "-": 0, "&&": 0, "|": 0, ":": 0, "*": 1, "/": 1}


def _cuts(text: str) -> Iterator[tuple[int, int, int]]:
    """Places where a line may end: (depth of brackets, rank, position)."""
    depth = position = 0
    for word in text.split(" "):
        if position > 0 and (word in _RANKS or text[position - 2] == ","):
            yield depth, _RANKS.get(word, 0), position - 1
        depth += sum(word.count(mark) for mark in "([{") - sum(word.count(mark) for mark in ")]}")
        position += len(word) + 1


def cut(text: str, first: int, others: int | None = None) -> list[str]:
    """An expression in lines of at most ``first`` and then ``others`` letters, as far as it can be cut.

    >>> cut("a * (b + c) + d * (e + f)", 20)
    ['a * (b + c)', '+ d * (e + f)']
    """
    lines, width = [], first
    while len(text) > width:
        end = text.find(" ", width + 2)  # whole words, as far as a line can reach: expressions can be very long
        cuts = [place for place in _cuts(text[:end] if end > 0 else text) if place[2] <= width]
        good = [place for place in cuts if place[2] >= _SHORTEST * width] or cuts
        if not good:
            break
        _, _, position = min(good, key=lambda place: (place[0], place[1], -place[2]))
        lines.append(text[:position])
        text, width = text[position + 1 :], first if others is None else others
    return [*lines, text]


def fill(text: str, width: int) -> list[str]:
    """A comment in lines of at most ``width`` letters, cut between equations (after ``;``) where that is possible.

    >>> fill("(4) theta6: x = c6; y = s6; z = 0", 22)
    ['(4) theta6: x = c6;', 'y = s6; z = 0']
    """
    lines = [""]
    for part in text.split("; "):
        joined = f"{lines[-1]}; {part}" if lines[-1] else part
        if len(joined) <= width:
            lines[-1] = joined
            continue
        if lines[-1]:
            lines[-1] += ";"
            lines.append("")
        lines[-1:] = textwrap.wrap(part, width, break_long_words=False, break_on_hyphens=False) or [""]
    return lines
