"""Sentences of a plan with their names set as mathematics, and words of the user, escaped."""

from __future__ import annotations

import re
from collections.abc import Callable

from markupsafe import Markup, escape

from kinsym.emit.html.mathml import math
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names, link, pose
from kinsym.emit.latex.sentences import TOKEN, is_symbol

#: What stands for a formula while the words around it are escaped.
_MARK = "\ufffc"


def sentence(text: str, names: Names) -> Markup:
    """A sentence of the plan: poses, links and names are formulas, all else is words.

    >>> print(sentence("a < b of T_0_6", Names([])).partition("<math>")[0])
    a &lt; b of\N{SPACE}
    """
    parts: list[Markup] = []
    for token in TOKEN.finditer(text):
        tex = ""
        if token["pose"]:
            tex = pose(int(token["left"]), int(token["right"]))
        elif token["link"]:
            tex = link(token["link"]) + ("^{-1}" if token["inverse"] else "")
        elif token["name"] and is_symbol(token["name"], names):
            tex = names[token["name"]] + (f"^{{{token['power'][1:]}}}" if token["power"] else "")
        parts.append(math(mathml(tex)) if tex else escape(token[0]))
    return Markup("").join(parts)


class Placeholders:
    """Formulas inside sentences that :mod:`kinsym.emit.prose` builds of plain text.

    >>> held = Placeholders()
    >>> print(held.filled("a < " + held.put(Markup("<math></math>"))))
    a &lt; <math></math>
    """

    def __init__(self) -> None:
        self._formulas: list[Markup] = []

    def put(self, formula: Markup) -> str:
        """What stands for a formula."""
        self._formulas.append(formula)
        return f"{_MARK}{len(self._formulas) - 1}{_MARK}"

    def filled(self, text: str) -> Markup:
        """A sentence with its formulas in their places."""
        parts = re.split(f"{_MARK}(\\d+){_MARK}", text)
        return Markup("").join(self._formulas[int(part)] if k % 2 else escape(part) for k, part in enumerate(parts))


def braced(text: str, formula: Callable[[str], Markup]) -> Markup:
    """A sentence in which braces hold mathematics.

    >>> print(braced("at {x} > 0", lambda part: Markup(f"<i>{part}</i>")))
    at <i>x</i> &gt; 0
    """
    parts = re.split(r"\{(.*?)\}", text)
    return Markup("").join(formula(part) if k % 2 else escape(part) for k, part in enumerate(parts))


def capital(words: Markup) -> Markup:
    """A sentence with a capital at its beginning, unless it begins with mathematics."""
    return Markup(words[:1].upper() + words[1:])
