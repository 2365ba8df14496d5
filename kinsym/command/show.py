"""``kinsym show``: the equations on the terminal."""

from __future__ import annotations

import argparse

from kinsym.command.screen import Screen
from kinsym.command.table import robot_of, say_notes
from kinsym.errors import KinsymError


def show(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and print, the usual way or by one method of the lecture; nothing is written."""
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
    derivation = derive(robot, deadline=options.deadline)
    screen.say(equations(derivation, width=screen.width, ascii=screen.ascii, full=options.full).rstrip("\n"))
    return 0
