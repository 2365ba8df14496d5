"""The objects above the emitters as plain text: what their notebook page is where nothing is typeset."""

from __future__ import annotations

from kinsym.emit.text.methods import equation_text, method_text
from kinsym.emit.text.page import Page
from kinsym.methods.document import Equation, MethodDerivation
from kinsym.robot.model import Robot
from kinsym.robot.summary import table_lines


def text_of(thing: object) -> str:
    """The page of a robot, of a method or of one of its equations."""
    match thing:
        case Robot():
            return "\n".join([thing.title or thing.name, *table_lines(thing)])
        case MethodDerivation():
            return method_text(thing).rstrip("\n")
        case Equation():
            return equation_text(thing, Page())
    raise TypeError(f"a {type(thing).__name__} has no page")
