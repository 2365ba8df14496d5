"""``kinsym import``: a chain of a URDF file as a robot file, with how far it is from what it was read from."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym import __version__
from kinsym.command.options import add_quiet, add_reading
from kinsym.errors import OutputError, RobotError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.robot.model import Robot


HELP = "write a chain of a URDF file as a robot file"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("file", metavar="FILE", help="a .urdf file")
    command.add_argument("--name", help="name of the robot, and of the file")
    command.add_argument("-o", "--output", metavar="FILE", help="the robot file to write (default: ./NAME.toml)")
    add_quiet(command)
    add_reading(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Convert, say what was changed, write; a file that is there is replaced only if ``--output`` names it."""
    from kinsym.command.table import say_notes, snapping_from
    from kinsym.robot.loading import URDF_SUFFIX, load
    from kinsym.robot.names import shown
    from kinsym.write import write_set

    if not options.file.lower().endswith(URDF_SUFFIX):
        raise RobotError(
            f"{shown(options.file)} is no .urdf file", remedy="Name one; a .toml or .csv table needs no import."
        )
    robot = load(
        options.file,
        name=options.name,
        base_link=options.base_link,
        tip_link=options.tip_link,
        snapping=snapping_from(options),
    )
    target = Path(f"{robot.name}.toml" if options.output is None else options.output)
    if options.output is None and target.exists():
        raise OutputError(f"{target} is there already. Name a file with --output; that one is then replaced.")
    say_notes(robot, screen)
    paths = write_set(target.parent, {target.name: robot_file(robot)}, anything=True)
    screen.say(f"Written\n-------\n  {paths[0]}")
    return 0


def robot_file(robot: Robot) -> str:
    """The text of a robot file whose head tells where the robot comes from and what was changed.

    >>> from kinsym.robot import load
    >>> print(robot_file(load("planar_rr")).splitlines()[1])
    name = "planar_rr"
    """
    from kinsym.robot.summary import to_toml

    head = [f"Read by kinsym {__version__} from {robot.source}" if robot.source else f"Written by kinsym {__version__}"]
    return "".join(f"# {line}\n" for line in (*head, *robot.notes)) + to_toml(robot)
