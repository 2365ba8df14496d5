"""``kinsym export``: a robot with numbers as a file of another program."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import add_quiet, add_table
from kinsym.errors import OutputError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

FORMATS = ("urdf", "rtb")


HELP = "write a robot for another program: URDF, Robotics Toolbox"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_table(command)
    command.add_argument(
        "--to", choices=FORMATS, required=True, help="a URDF skeleton, or a DHRobot of roboticstoolbox-python"
    )
    command.add_argument(
        "-o", "--output", metavar="FILE", help="the file to write (default: ./NAME.urdf, ./NAME_rtb.py)"
    )
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Write the file; one that is there is replaced only if ``--output`` names it."""
    from kinsym.command.table import robot_of, say_notes
    from kinsym.export import FORMATS as formats
    from kinsym.write import write_set

    robot = robot_of(options)
    chosen = formats[options.to]
    target = Path(chosen.file.format(robot.name) if options.output is None else options.output)
    if options.output is None and target.exists():
        raise OutputError(f"{target} is there already. Name a file with --output; that one is then replaced.")
    say_notes(robot, screen)
    paths = write_set(target.parent, {target.name: chosen.text(robot)}, anything=True)
    screen.say(f"Written\n-------\n  {paths[0]}")
    return 0
