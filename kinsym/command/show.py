"""``kinsym show``: the equations on the terminal."""

from __future__ import annotations

import argparse

from kinsym.command.screen import Screen
from kinsym.command.table import robot_of


def show(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and print; nothing is written."""
    from kinsym.derivation import derive
    from kinsym.emit.text import equations

    robot = robot_of(options)
    derivation = derive(robot, deadline=options.deadline)
    screen.say(equations(derivation, width=screen.width, ascii=screen.ascii, full=options.full).rstrip("\n"))
    return 0
