"""A method of the lecture as Markdown.

Equations carry their own numbers and no labels, which all pages of a notebook would share.
"""

from __future__ import annotations

from kinsym.emit.latex.methods import MethodPage
from kinsym.emit.markdown.words import words
from kinsym.methods.document import Equation, MethodDerivation, Sentence


def method(derivation: MethodDerivation) -> str:
    """The derivation under a heading."""
    heading = f"**{words(derivation.title)}: {words(derivation.robot)}**"
    return "\n\n".join([heading, *_Page(derivation).lines()])


def equation(one: Equation) -> str:
    """One equation with its number."""
    alone = MethodDerivation(robot="", method="", title="", passages=(one,), solutions=(), conditions=())
    return "\n\n".join(_Page(alone).lines())


class _Page(MethodPage):
    def __init__(self, derivation: MethodDerivation) -> None:
        super().__init__(derivation)
        self._numbers = {equation.name: equation.number for equation in derivation.equations}

    def label(self, name: str) -> str:
        """The number of an equation; matrices that share a line have that of the first of them."""
        return str(self._numbers[self._first.get(name, name)])

    def reference(self, name: str) -> str:
        """An equation, in a sentence."""
        return f"({self.label(name)})"

    def numbered(self, name: str) -> str:
        """The number of an equation, at its end."""
        return f" \\tag{{{self.label(name)}}}"

    def words(self, text: str) -> str:
        """Words between formulas."""
        return words(text)

    def sentence(self, sentence: Sentence) -> str:
        """A sentence on one line: the beginning of another one might be read as a mark."""
        return " ".join(super().sentence(sentence).splitlines())
