"""How wide a formula will be on paper, near enough to break it before TeX would let it stick out.

Widths are those of Computer Modern at 10 pt, rounded up.
"""

from __future__ import annotations

import re

_LETTERS = {"i": 3.7, "j": 4.6, "l": 3.3, "t": 3.9, "c": 4.5, "s": 4.9, "e": 4.9, "r": 5.0, "m": 9.0, "w": 7.4}
_SIGNS = {"+": 12.3, "-": 12.3, "=": 13.5, "<": 13.5, ">": 13.5, ",": 4.6, ".": 2.9, "(": 4.1, ")": 4.1, "/": 5.2}
_COMMANDS = {
    "pm": 12.3,
    "le": 13.5,
    "ge": 13.5,
    "ne": 13.5,
    "quad": 10.0,
    "qquad": 20.0,
    ",": 1.8,
    "lbrace": 5.2,
    "rbrace": 5.2,
    "lvert": 3.0,
    "rvert": 3.0,
    "sin": 14.5,
    "cos": 15.5,
    "infty": 10.0,
    "left": 0.0,
    "right": 0.0,
    "bigl": 1.0,
    "bigr": 1.0,
    "mathrm": 0.0,
    "operatorname": 2.0,
    "frac": 2.5,
    "tfrac": 2.5,
    "sqrt": 9.0,
    "_": 5.2,
}
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[{}_^]|\S")
_SCRIPT = 0.72


def width(latex: str) -> float:
    """The width of a formula in points at a type size of 10 pt.

    >>> width("c_{1}") < width("c_{12}") < width("c_{1} + c_{2}")
    True
    """
    tokens = _TOKEN.findall(latex)
    return _Reader(tokens).sequence() if tokens else 0.0


class _Reader:
    """Reads tokens from left to right; a group in braces is measured on its own."""

    def __init__(self, tokens: list[str]) -> None:
        self._tokens, self._at = tokens, 0

    def sequence(self) -> float:
        """The width up to the end or to the closing brace."""
        total = 0.0
        script = 0.0
        while self._at < len(self._tokens) and self._tokens[self._at] != "}":
            token = self._tokens[self._at]
            if token in "_^":
                self._at += 1
                # A subscript and a superscript of one letter stand above each other.
                wider = _SCRIPT * self._item() + 0.6
                total += max(0.0, wider - script)
                script = max(script, wider)
            else:
                script = 0.0
                total += self._item()
        return total

    def _item(self) -> float:
        token = self._tokens[self._at]
        self._at += 1
        if token == "{":
            total = self.sequence()
            self._at += 1
            return total
        if token in (r"\frac", r"\tfrac"):
            scale = _SCRIPT if token == r"\tfrac" else 1.0
            upper = self._item()
            return _COMMANDS["frac"] + scale * max(upper, self._item())
        if token[0] == "\\":
            return _COMMANDS.get(token[1:], 6.6)
        if token.isdigit():
            return 5.0
        return _SIGNS.get(token, _LETTERS.get(token, 8.6 if token.isupper() else 5.9))
