"""Options that several commands share: which table, and how it is read.

The choices repeat names of the model, so that the parser loads nothing that calculates; a test compares them.
"""

from __future__ import annotations

import argparse

TASKS = ("pose", "position", "orientation", "planar", "scara", "position_axis")
CONVENTIONS = ("paul", "craig", "screw")


def add_table(command: argparse.ArgumentParser) -> None:
    """TABLE or --dh, and everything that says how it is read and what is asked of the arm."""
    command.add_argument(
        "table", metavar="TABLE", nargs="?", help="a robot of the gallery, or a .toml, .csv or .urdf file"
    )
    command.add_argument("--dh", metavar="ROWS", help='rows "alpha a d theta; ..." instead of TABLE')
    command.add_argument("--convention", choices=CONVENTIONS, help="how to read a CSV table or --dh")
    command.add_argument("--name", help="name of the robot, and of the files")
    command.add_argument(
        "--task", metavar="TASK", choices=TASKS, help=f"what to reach: {', '.join(TASKS)} (default: what the arm can)"
    )
    command.add_argument(
        "--bind", metavar="NAME=VALUE", action="append", default=[], help="fold a parameter's number in (repeatable)"
    )
    command.add_argument(
        "--deadline", metavar="SECONDS", type=float, help="give the derivation up after this time (default: no limit)"
    )
    command.add_argument(
        "--lock",
        metavar="JOINT[=VALUE]",
        action="append",
        default=[],
        help="do not solve for a joint: it is an input, or held at VALUE (repeatable; instead of the file's locks)",
    )
    command.add_argument(
        "--nominal",
        action="store_true",
        help="an arm off a special one by real millimetres: that one's closed form, then Newton steps (docs/urdf.md)",
    )
    add_reading(command)


def add_reading(command: argparse.ArgumentParser) -> None:
    """The links of a URDF file, and which numbers are read as special values."""
    command.add_argument(
        "--base-link", metavar="LINK", help="where the chain of a URDF file begins (default: its root)"
    )
    command.add_argument("--tip-link", metavar="LINK", help="where it ends (default: its only leaf that moves)")
    numbers = command.add_mutually_exclusive_group()
    numbers.add_argument("--exact", action="store_true", help="take rounded numbers as they are: 1.5708 is not pi/2")
    numbers.add_argument(
        "--snap", metavar="TOL", help="read angles as multiples of 15 degrees, and lengths as 0, if off by at most TOL"
    )


def add_quiet(command: argparse.ArgumentParser) -> None:
    """--quiet, of every command that prints what nobody may want to read."""
    command.add_argument("--quiet", action="store_true", help="print errors only")


def add_json(command: argparse.ArgumentParser) -> None:
    """--json, of every command whose result a program may want to read."""
    command.add_argument("--json", action="store_true", help="print one JSON object instead, an error as well")
