"""What a method says: sentences and numbered equations, which the terminal and LaTeX print alike.

A side of an equation is a :data:`~kinsym.algebra.tree.Tree`, a matrix of trees, or a product of named matrices such as
``A1^-1 p = A2 A3 A4 p0``. A sentence refers to an equation as ``{name}``; the printers put its number there.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from kinsym.algebra.tree import Tree
from kinsym.display import Displayed

INVERSE, TRANSPOSE = "-1", "T"


@dataclass(frozen=True)
class Matrix:
    """A matrix, row by row; a column has rows of one entry."""

    rows: tuple[tuple[Tree, ...], ...]


@dataclass(frozen=True)
class Factor:
    """A named matrix or column: ``T_0_1``, ``A1``, ``p``; ``mark`` is INVERSE, TRANSPOSE or empty."""

    name: str
    mark: str = ""


@dataclass(frozen=True)
class Product:
    """A product of matrices in their order; what has no name stands there written out."""

    factors: tuple[Factor | Matrix, ...]


Side = Tree | Matrix | Product


@dataclass(frozen=True, kw_only=True)
class Equation(Displayed):
    """``left sign right`` under a number and a name, such as ``f1`` or ``loop.x``."""

    number: int
    name: str
    left: Side
    right: Side
    sign: str = "="


@dataclass(frozen=True)
class Sentence:
    """A sentence, or several; ``{name}`` refers to an equation."""

    text: str

    @property
    def references(self) -> tuple[str, ...]:
        """The names of the equations it refers to."""
        return tuple(re.findall(r"{([^{}]+)}", self.text))


@dataclass(frozen=True, kw_only=True)
class Solution:
    """One unknown: the equations that give its values, how many there are, and what must hold for that.

    An equation with a sign ± or a root of a polynomial gives several values.
    """

    unknown: str
    equations: tuple[Equation, ...]
    branches: int
    conditions: tuple[Equation, ...] = ()


Passage = Sentence | Equation


@dataclass(frozen=True, kw_only=True)
class MethodDerivation(Displayed):
    """A method of the lecture applied to one robot.

    ``passages`` are in the order of reading and hold every equation; ``solutions`` and ``conditions`` pick those that
    solve an unknown, and those that must hold, out of them.
    """

    robot: str
    method: str
    title: str
    passages: tuple[Passage, ...]
    solutions: tuple[Solution, ...]
    conditions: tuple[Equation, ...]

    @property
    def equations(self) -> tuple[Equation, ...]:
        """The equations alone, in order."""
        return tuple(passage for passage in self.passages if isinstance(passage, Equation))

    def equation(self, name: str) -> Equation:
        """The equation of a name.

        Raises :class:`KeyError` with the names there are.
        """
        for equation in self.equations:
            if equation.name == name:
                return equation
        raise KeyError(f"{name!r} is none of {', '.join(equation.name for equation in self.equations)}")
