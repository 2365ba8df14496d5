"""``kinsym new``: a commented robot file to start from."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import CONVENTIONS
from kinsym.errors import OutputError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

JOINTS = (2, 3, 4, 5, 6, 7)

HELP = "write a commented robot file to start from"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = (
        "Write NAME.toml, a robot file with a comment on every key, which can be derived as it stands. A file that is"
        " there is never replaced."
    )
    command.add_argument("name", metavar="NAME", nargs="?", default="my_robot", help="name of the robot (my_robot)")
    command.add_argument("--convention", choices=CONVENTIONS, default="paul", help="of the table (default: paul)")
    command.add_argument(
        "--joints", type=int, choices=JOINTS, default=6, help="how many joints the arm has (default: 6)"
    )


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Write the file into the working folder."""
    from kinsym.command.starters import starter_file
    from kinsym.robot.model import Convention
    from kinsym.write import write_set

    name = options.name.removesuffix(".toml")
    text = starter_file(name, Convention(options.convention), options.joints)
    path = Path(f"{name}.toml")
    if path.exists():
        raise OutputError(f"{path} is there already and is left as it is. Give another name: kinsym new NAME.")
    write_set(path.parent, {path.name: text}, anything=True)
    screen.heading("Written")
    screen.say(f"  {path}\n\nEdit it, then: kinsym derive {path}")
    return 0
