"""What the printers of a method share: a sentence in pieces, of words, of mathematics and of references."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

_PIECE = re.compile(r"`([^`]+)`|{([^{}]+)}")


@dataclass(frozen=True)
class Piece:
    """A part of a sentence: words as they are, mathematics in the program's names, or the name of an equation."""

    kind: Literal["words", "math", "reference"]
    text: str


def pieces(sentence: str) -> Iterator[Piece]:
    """The parts of a sentence.

    >>> [piece.kind for piece in pieces("With `theta3` in {r},")]
    ['words', 'math', 'words', 'reference', 'words']
    """
    end = 0
    for match in _PIECE.finditer(sentence):
        if match.start() > end:
            yield Piece("words", sentence[end : match.start()])
        yield Piece("math", match[1]) if match[1] else Piece("reference", match[2])
        end = match.end()
    if end < len(sentence):
        yield Piece("words", sentence[end:])
