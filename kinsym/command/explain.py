"""``kinsym explain``: how one angle is found, or all of them, with the reasons."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from kinsym.command.options import add_table

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.derivation import Derivation

_NOMINAL = (
    "This arm has no closed form of its own. What follows is that of the special arm next to it, from whose solutions"
    " Newton's steps lead to those of this one; kinsym show tells in what they differ."
)

HELP = "walk through the derivation of an angle, with the reasons"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = (
        "Walk through the derivation equation by equation: what is known, which equation is taken and by which rule,"
        " why this one, the solution, its branches and its special cases. With UNKNOWN only the steps that it needs."
    )
    add_table(command)
    command.add_argument(
        "unknown", metavar="UNKNOWN", nargs="?", help="a joint such as theta3, or a sum such as theta234 (default: all)"
    )


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and explain; nothing is written."""
    from kinsym.command.table import robot_of, say_notes
    from kinsym.deriving import derive

    if options.dh is not None and options.unknown is None:
        options.table, options.unknown = None, options.table
    robot = robot_of(options)
    say_notes(robot, screen)
    screen.stage(f"deriving {robot.name}")
    screen.say(_explained(derive(robot, deadline=options.deadline), options.unknown, screen).rstrip("\n"))
    return 0


def _explained(derivation: Derivation, unknown: str | None, screen: Screen) -> str:
    from kinsym.command.screen import filled
    from kinsym.emit.text.explain import explanation
    from kinsym.emit.text.explain_general import elimination
    from kinsym.emit.text.page import Page
    from kinsym.inverse.needed import check_unknown, solvable

    if derivation.nominal is not None:
        screen.say("\n".join(filled(_NOMINAL, screen.width)) + "\n")
        derivation = derivation.nominal.derivation
    robot, plan, general = derivation.robot, derivation.plan, derivation.general
    known = solvable(plan) if plan else tuple(joint.variable for joint in derivation.solved.joints)
    if unknown is not None:
        check_unknown(unknown, robot, known)
    page = Page(width=screen.width, ascii=screen.ascii)
    wanted = known if unknown is None else (unknown,)
    if plan is not None:
        return explanation(derivation, plan, wanted, page)
    return elimination(derivation, general, wanted, page) if general is not None else ""
