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
from kinsym.command import (
    check,
    completion,
    derive,
    explain,
    exporting,
    importing,
    latex,
    lecture,
    new,
    plot,
    report,
    robots,
    show,
    workspace,
)
from kinsym.command.parsing import Parser, parsed
from kinsym.command.screen import Screen
from kinsym.errors import KinsymError

COMMANDS = {
    "derive": derive,
    "show": show,
    "explain": explain,
    "latex": latex,
    "plot": plot,
    "report": report,
    "workspace": workspace,
    "new": new,
    "import": importing,
    "export": exporting,
    "robots": robots,
    "check": check,
    "lecture": lecture,
    "completion": completion,
}
INTERRUPTED = 130

_DESCRIPTION = """\
Closed-form kinematics of serial robots: equations, NumPy and C that are
checked against each other."""
_EXAMPLES = """\
examples:
  kinsym derive fanuc_s900w                a robot of the gallery, ./fanuc_s900w
  kinsym derive my_robot.toml -o out       a robot file, into ./out
  kinsym derive table.csv --convention craig
  kinsym derive --dh "pi/2 0 d1 theta1; 0 a2 0 theta2" --convention paul
  kinsym derive kuka_iiwa --lock theta3    seven joints: theta3 is an input
  kinsym derive arm.urdf --tip-link tool0  a chain of a URDF file
  kinsym derive ur5 --target extension     a package around the C, for pip
  kinsym derive ur5 --target ikfast        what MoveIt's generator reads
  kinsym derive ur5 --json                 the result for a program
  kinsym show ur5                          the equations only
  kinsym explain ur5 theta3                how theta3 is found, and why so
  kinsym latex --lecture                   the chapter of the lecture, in LaTeX
  kinsym plot ur5 --branches               all solutions of a pose, drawn
  kinsym report ur5                        one page: arm, equations, code
  kinsym workspace puma560                 a map of what the arm reaches
  kinsym new my_robot --convention paul    a robot file to start from
  kinsym import arm.urdf --tip-link tool0  a robot file from URDF
  kinsym export ur5 --to urdf              and the other way
  kinsym robots wrist                      the gallery, or a part of it
  kinsym check out                         the checks again, on files in ./out
  kinsym lecture                           the lecture's equations, compared
  kinsym completion bash                   for source <(kinsym completion bash)

exit status: 0 done and checked; 1 no closed form, or a check failed; 2 the
input is wrong; 130 interrupted. NO_COLOR=1 takes colour away.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status.

    With ``--json`` standard output holds one JSON object, whatever happens: the command's, or
    ``{"status": ..., "error": {"kind": ..., "message": ...}}``.

    >>> main(["robots", "ur5e"])  # doctest: +ELLIPSIS
    name  joints ...
    0
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    screen = Screen(quiet="--quiet" in given, as_json="--json" in given)
    try:
        return _run(given, screen)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 2
    except KinsymError as error:
        return _refused(screen, type(error).__name__, str(error), error.exit_status)
    except KeyboardInterrupt:
        # Where a text was being executed (dataclasses make their methods so), CPython takes the interrupt for unhandled
        # and would end with the status of the signal; the next text that is executed takes that back.
        exec("")
        return _refused(screen, "Interrupted", "interrupted", INTERRUPTED)
    finally:
        screen.end()


def _run(given: list[str], screen: Screen) -> int:
    """Understand the words and do what they say."""
    _suggest(given)
    top = Parser(
        prog="kinsym",
        description=_DESCRIPTION,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"kinsym {__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        module.add_options(commands.add_parser(name, help=module.HELP, allow_abbrev=False))
    options = parsed(top, commands.choices, given)
    status: int = COMMANDS[options.command].run(options, screen)
    return status


def _refused(screen: Screen, kind: str, message: str, status: int) -> int:
    """Say why nothing came out."""
    screen.end()
    screen.warn(message)
    screen.refuse(kind, message, status)
    return status


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
