"""The command line: which commands there are, and what becomes of their errors.

A command is a module of :mod:`kinsym.command` with ``HELP``, ``add_options`` and ``run``. None of them loads what
calculates before it runs, so that ``kinsym --help`` answers at once. Exit status: 0 done and checked, 1 no closed form
or a check failed, 2 the input is wrong, 130 interrupted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from kinsym import __version__
from kinsym.command import check, derive, exporting, importing, lecture, robots, show
from kinsym.errors import KinsymError

COMMANDS = {
    "derive": derive,
    "show": show,
    "import": importing,
    "export": exporting,
    "robots": robots,
    "check": check,
    "lecture": lecture,
}
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
  kinsym export ur5 --to urdf               the chain for another program
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
    for name, module in COMMANDS.items():
        module.add_options(commands.add_parser(name, help=module.HELP, allow_abbrev=False))
    return top


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
        status: int = COMMANDS[options.command].run(options, screen)
        return status
    finally:
        screen.flush()


def _suggest(given: list[str]) -> None:
    """Stop at a first word that is no command, with the nearest one, or the command that a table's name lacks."""
    if not given or given[0].startswith("-") or given[0] in COMMANDS:
        return
    from kinsym.robot import gallery
    from kinsym.robot.names import nearest, shown

    word = given[0]
    if word in gallery() or word.endswith((".toml", ".csv", ".urdf")):
        raise KinsymError(f"{shown(word)} is no command. Did you mean: kinsym derive {word}?")
    hint = nearest(word, tuple(COMMANDS))
    raise KinsymError(f"{shown(word)} is no command. {hint}The commands: {', '.join(COMMANDS)}.")
