"""Words and tables in Markdown."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

#: What Markdown, HTML or a reader of mathematics would take for a mark of their own.
_MARKS = re.compile(r"[\\`*_{}\[\]<>#|$&~]")


def words(text: str) -> str:
    r"""Any text as words on one line: no mark of Markdown, of HTML or of mathematics is left in it.

    >>> words("50% of $x_1$\n<b>")
    '50% of &#36;x&#95;1&#36; &#60;b&#62;'
    """
    letters = (letter for letter in text if letter.isspace() or unicodedata.category(letter) not in ("Cc", "Cf"))
    return _MARKS.sub(lambda mark: f"&#{ord(mark[0])};", " ".join("".join(letters).split()))


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; its cells are words or formulas without a vertical bar.

    >>> print(table(("i", "d"), [("1", "$d_1$")]))
    | i | d |
    |:-:|:-:|
    | 1 | $d_1$ |
    """
    lines = [head, [":-:"] * len(head), *rows]
    return "\n".join(f"|{'|'.join(cells)}|" if k == 1 else f"| {' | '.join(cells)} |" for k, cells in enumerate(lines))
