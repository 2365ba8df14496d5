"""The command line: ``kinsym derive``, ``show``, ``import``, ``robots``, ``check`` and ``lecture``.

Only the parser lives here, and it loads nothing that calculates, so that ``kinsym --help`` answers at once. Exit
status: 0 done and checked, 1 no closed form or a check failed, 2 the input is wrong, 130 interrupted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from kinsym import __version__
from kinsym.errors import KinsymError

TASKS = ("pose", "position", "orientation", "planar", "scara", "position_axis")
CONVENTIONS = ("paul", "craig", "screw")
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
TARGETS = ("numpy", "c", "latex", "extension")
INTERRUPTED = 130

_DESCRIPTION = "Closed-form kinematics of serial robots: equations, NumPy and C that are checked against each other."
_EXAMPLES = """\
examples:
  kinsym derive fanuc_s900w                 a robot of the gallery, into ./fanuc_s900w
  kinsym derive my_robot.toml -o out        a robot file, into ./out
  kinsym derive table.csv --convention craig
  kinsym derive --dh "pi/2 0 d1 theta1; 0 a2 0 theta2" --convention paul --name two_links
  kinsym derive kuka_iiwa --lock theta3     an arm with seven joints: theta3 is an input
  kinsym derive arm.urdf --tip-link tool0   a chain of a URDF file
  kinsym import arm.urdf --tip-link tool0   the same as a robot file, to read and edit
  kinsym show ur5                           the equations only
  kinsym check out                          the checks again, on the files in ./out
  kinsym lecture                            every equation of the lecture, derived and compared

exit status: 0 done and checked; 1 no closed form, or a check failed; 2 the input is wrong
"""


def parser() -> argparse.ArgumentParser:
    """The parser of the whole command line."""
    top = argparse.ArgumentParser(
        prog="kinsym", description=_DESCRIPTION, epilog=_EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    top.add_argument("--version", action="version", version=f"kinsym {__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)

    derive = commands.add_parser("derive", help="derive, check and write a robot's kinematics", allow_abbrev=False)
    _add_table(derive)
    derive.add_argument("-o", "--output", metavar="DIR", help="where to write (default: ./NAME)")
    derive.add_argument(
        "--target",
        action="append",
        choices=TARGETS,
        help="write this only (repeatable; default: numpy, c and latex); extension is a Python package around the C",
    )
    derive.add_argument("--no-check", action="store_true", help="write the files without checking them")
    derive.add_argument("--quiet", action="store_true", help="print errors only")

    show = commands.add_parser("show", help="print the equations, write nothing", allow_abbrev=False)
    _add_table(show)
    show.add_argument("--full", action="store_true", help="with link transforms and Jacobian")
    show.add_argument("--method", choices=METHODS, help="one method of the lecture instead, step by step")

    imported = commands.add_parser("import", help="write a chain of a URDF file as a robot file", allow_abbrev=False)
    imported.add_argument("file", metavar="FILE", help="a .urdf file")
    imported.add_argument("--name", help="name of the robot, and of the file")
    imported.add_argument("-o", "--output", metavar="FILE", help="the robot file to write (default: ./NAME.toml)")
    imported.add_argument("--quiet", action="store_true", help="print errors only")
    _add_reading(imported)

    commands.add_parser("robots", help="list the robots of the gallery", allow_abbrev=False)

    check = commands.add_parser(
        "check",
        help="repeat the checks on files already there",
        description="Repeat the checks on the files in DIR. This runs the Python and C code found there.",
        allow_abbrev=False,
    )
    check.add_argument("folder", metavar="DIR", help="a folder that kinsym derive has written")
    check.add_argument("--quiet", action="store_true", help="print errors only")

    lecture = commands.add_parser(
        "lecture", help="hold the lecture's equations against what kinsym derives", allow_abbrev=False
    )
    lecture.add_argument("system", metavar="SYSTEM", nargs="?", help="one system of the lecture (default: all)")
    lecture.add_argument("--errata", action="store_true", help="list the lecture's mistakes with the reason")
    lecture.add_argument("--markdown", action="store_true", help="print docs/lecture.md, the sections beside kinsym")
    lecture.add_argument("--quiet", action="store_true", help="print errors only")
    return top


def _add_table(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "table", metavar="TABLE", nargs="?", help="a robot of the gallery, or a .toml, .csv or .urdf file"
    )
    command.add_argument("--dh", metavar="ROWS", help='rows "alpha a d theta; ..." instead of TABLE')
    command.add_argument("--convention", choices=CONVENTIONS, help="how to read a CSV table or --dh")
    command.add_argument("--name", help="name of the robot, and of the files")
    command.add_argument("--task", choices=TASKS, help="what of the pose to reach (default: what the arm can)")
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
    _add_reading(command)


def _add_reading(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--base-link", metavar="LINK", help="where the chain of a URDF file begins (default: its root)"
    )
    command.add_argument("--tip-link", metavar="LINK", help="where it ends (default: its only leaf that moves)")
    numbers = command.add_mutually_exclusive_group()
    numbers.add_argument("--exact", action="store_true", help="take rounded numbers as they are: 1.5708 is not pi/2")
    numbers.add_argument(
        "--snap", metavar="TOL", help="read angles as multiples of 15 degrees, and lengths as 0, if off by at most TOL"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status.

    >>> main(["robots"]) == 0  # doctest: +ELLIPSIS
    abb_irb120 ...
    True
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        _suggest(given)
        options = parser().parse_args(given)
        return _run(options)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 2
    except KinsymError as error:
        print(f"kinsym: {error}", file=sys.stderr)
        return error.exit_status
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(options: argparse.Namespace) -> int:
    from kinsym.command.screen import Screen

    screen = Screen(quiet=getattr(options, "quiet", False))
    try:
        match options.command:
            case "derive":
                from kinsym.command.derive import derive

                return derive(options, screen)
            case "show":
                from kinsym.command.show import show

                return show(options, screen)
            case "import":
                from kinsym.command.importing import import_robot

                return import_robot(options, screen)
            case "check":
                from kinsym.command.check import check

                return check(options, screen)
            case "lecture":
                from kinsym.command.lecture import lecture

                return lecture(options, screen)
            case _:
                from kinsym.command.robots import robots

                return robots(screen)
    finally:
        screen.flush()


def _suggest(given: list[str]) -> None:
    """Stop at a first word that is no command, with the nearest one, or the command that a table's name lacks."""
    commands = ("derive", "show", "import", "robots", "check", "lecture")
    if not given or given[0].startswith("-") or given[0] in commands:
        return
    from kinsym.robot import gallery
    from kinsym.robot.names import nearest, shown

    word = given[0]
    if word in gallery() or word.endswith((".toml", ".csv", ".urdf")):
        raise KinsymError(f"{shown(word)} is no command. Did you mean: kinsym derive {word}?")
    hint = nearest(word, commands)
    raise KinsymError(f"{shown(word)} is no command. {hint}The commands: {', '.join(commands)}.")
