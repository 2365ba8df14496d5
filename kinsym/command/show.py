"""``kinsym show``: the equations on the terminal."""

from __future__ import annotations

import argparse

from kinsym.command.screen import Screen
from kinsym.command.table import robot_of, say_notes


def show(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and print; nothing is written."""
    from kinsym.deriving import derive
    from kinsym.emit.text import equations

    robot = robot_of(options)
    say_notes(robot, screen)
    derivation = derive(robot, deadline=options.deadline)
    screen.say(equations(derivation, width=screen.width, ascii=screen.ascii, full=options.full).rstrip("\n"))
    return 0
