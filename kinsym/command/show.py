"""``kinsym show``: the equations on the terminal."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from kinsym.command.options import add_table
from kinsym.errors import KinsymError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

METHODS = (
    "loop_closure",
    "craig",
    "paul",
    "screws",
    "frames",
    "workspace",
    "screws_inverse",
    "algebraic",
    "geometric",
    "half_angle",
    "pieper",
    "zyz",
    "decoupled",
)


HELP = "print the equations, write nothing"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_table(command)
    command.add_argument("--full", action="store_true", help="with link transforms and Jacobian")
    command.add_argument(
        "--method", metavar="METHOD", choices=METHODS, help=f"one method of the lecture instead: {', '.join(METHODS)}"
    )


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and print, the usual way or by one method of the lecture; nothing is written."""
    from kinsym.command.table import robot_of, say_notes
    from kinsym.deriving import derive
    from kinsym.emit.text import equations

    robot = robot_of(options)
    say_notes(robot, screen)
    if options.method is not None:
        if options.deadline is not None or options.full:
            raise KinsymError("--deadline and --full belong to the usual derivation. Leave them out with --method.")
        from kinsym.emit.text.methods import method_text
        from kinsym.methods import METHODS

        screen.say(method_text(METHODS[options.method](robot), width=screen.width, ascii=screen.ascii).rstrip("\n"))
        return 0
    screen.stage(f"deriving {robot.name}")
    derivation = derive(robot, deadline=options.deadline)
    screen.say(equations(derivation, width=screen.width, ascii=screen.ascii, full=options.full).rstrip("\n"))
    return 0
