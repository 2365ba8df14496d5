"""Derivations as Markdown with LaTeX mathematics, which is what a notebook typesets.

Formulas, their layout and the words of each step are those of the LaTeX document.
"""

from __future__ import annotations

from kinsym.emit.markdown.methods import equation, method
from kinsym.emit.markdown.robot import robot
from kinsym.methods.document import Equation, MethodDerivation
from kinsym.robot.model import Robot


def markdown_of(thing: object) -> str:
    """The page of a robot, of a method or of one of its equations."""
    match thing:
        case Robot():
            return robot(thing)
        case MethodDerivation():
            return method(thing)
        case Equation():
            return equation(thing)
    raise TypeError(f"a {type(thing).__name__} has no page")
