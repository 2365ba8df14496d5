"""Sentences about the lecture: words, and formulas in its notation between backticks."""

from __future__ import annotations

import re

_FORMULA = re.compile(r"`([^`]+)`")


def plain(text: str) -> str:
    """A sentence for a terminal.

    >>> plain("`s1` is printed twice")
    's1 is printed twice'
    """
    return text.replace("`", "")


def markdown(text: str) -> str:
    r"""A sentence for a cell of a Markdown table, its formulas as code.

    >>> markdown("`a*b` is printed as a*b")
    '`a*b` is printed as a\\*b'
    """
    parts = _FORMULA.split(text)
    return "".join(
        f"`{_cell(part)}`" if k % 2 else _cell(part).replace("*", "\\*").replace("_", "\\_")
        for k, part in enumerate(parts)
    )


def parts_of(text: str) -> list[tuple[bool, str]]:
    """The sentence in pieces, each with whether it is a formula.

    >>> parts_of("with `c5 != 0`")
    [(False, 'with '), (True, 'c5 != 0')]
    """
    return [(bool(k % 2), part) for k, part in enumerate(_FORMULA.split(text)) if part]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
