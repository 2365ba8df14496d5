"""A method of the lecture as Markdown.

Equations carry their own numbers and no labels, which all pages of a notebook would share.
"""

from __future__ import annotations

from kinsym.emit.latex.methods import MethodFragment
from kinsym.emit.markdown.words import words
from kinsym.methods.document import Equation, MethodDerivation


def method(derivation: MethodDerivation) -> str:
    """The derivation under a heading."""
    return _Page(derivation).text()


def equation(one: Equation) -> str:
    """One equation with its number."""
    alone = MethodDerivation(robot="", method="", title="", passages=(one,), solutions=(), conditions=())
    return "\n\n".join(_Page(alone).parts()[1:])


class _Page(MethodFragment):
    def __init__(self, derivation: MethodDerivation) -> None:
        super().__init__(derivation)
        self._numbers = {equation.name: equation.number for equation in derivation.equations}

    def text(self) -> str:
        """The page, a blank line between its parts."""
        return "\n\n".join(self.parts())

    def heading(self, text: str) -> str:
        """The heading of the page."""
        return f"**{text}**"

    def words(self, text: str) -> str:
        """Words between formulas."""
        return words(text)

    def reference(self, name: str) -> str:
        """An equation, in a sentence."""
        return f"({self._numbers[name]})"

    def numbered(self, name: str) -> str:
        """The number of an equation, at its end."""
        return f" \\tag{{{self._numbers[name]}}}"
