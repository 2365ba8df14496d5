"""``kinsym latex``: the derivation of one robot, one method of the lecture, or the whole lecture as LaTeX."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import add_quiet, add_table
from kinsym.command.show import METHODS
from kinsym.errors import KinsymError, OutputError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.robot.model import Robot

HELP = "write the equations as LaTeX, of one robot or of the whole lecture"
STANDARD_OUTPUT = "-"
LECTURE = "lecture"
_OF_ONE_ROBOT = (
    *("dh", "convention", "name", "task", "bind", "deadline", "lock", "nominal"),
    *("base_link", "tip_link", "exact", "snap", "method", "fragment"),
)
"""Options that say something of one robot; the lecture takes none of them."""


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_table(command)
    command.add_argument("--lecture", action="store_true", help="the whole chapter, every system with its derivation")
    command.add_argument("--method", metavar="NAME", help=f"one method of the lecture: {', '.join(METHODS)}")
    command.add_argument("--fragment", action="store_true", help="the body alone, for a document of your own")
    command.add_argument(
        "-o", "--output", metavar="FILE", help="the file to write, - for standard output (default: ./NAME.tex)"
    )
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Derive and write one file; one that is there is replaced only if ``--output`` names it."""
    from kinsym.command.screen import Screen
    from kinsym.write import write_set

    if options.lecture:
        _check_alone(options)
        target = _target(options, LECTURE)
        screen.stage("deriving the lecture")
        text = _chapter()
    else:
        _check_method(options)
        robot = _robot(options, screen)
        target = _target(options, robot.name if options.method is None else f"{robot.name}_{options.method}")
        screen.stage(f"deriving {robot.name}")
        text = _page(options, robot)
    if target is None:
        # what is asked for on standard output is no progress that --quiet keeps back
        Screen().say(text.rstrip("\n"))
        return 0
    paths = write_set(target.parent, {target.name: text}, anything=True)
    screen.say(f"Written\n-------\n  {paths[0]}")
    return 0


def _check_alone(options: argparse.Namespace) -> None:
    """KinsymError where something is asked for beside the whole lecture."""
    beside = {
        "TABLE": options.table,
        **{f"--{name.replace('_', '-')}": getattr(options, name) for name in _OF_ONE_ROBOT},
    }
    given = [name for name, value in beside.items() if value]
    if given:
        raise KinsymError(f"--lecture is the whole chapter. Leave out {', '.join(given)}.")


def _check_method(options: argparse.Namespace) -> None:
    """KinsymError with the nearest name where there is no such method, or it takes an option that does not fit."""
    from kinsym.robot.names import nearest, shown

    if options.method is None:
        return
    if options.method not in METHODS:
        hint = nearest(options.method, METHODS)
        raise KinsymError(f"{shown(options.method)} is no method. {hint}The methods: {', '.join(METHODS)}.")
    if options.deadline is not None:
        raise KinsymError("--deadline belongs to the usual derivation. Leave it out with --method.")


def _robot(options: argparse.Namespace, screen: Screen) -> Robot:
    """The robot; what was read otherwise than written is said where it does not get into the document."""
    from kinsym.command.table import robot_of, say_notes

    robot = robot_of(options)
    if options.output == STANDARD_OUTPUT:
        for note in robot.notes:
            screen.warn(note)
    else:
        say_notes(robot, screen)
    return robot


def _target(options: argparse.Namespace, name: str) -> Path | None:
    """The file to write, which can be written as far as can be told; None for standard output."""
    from kinsym.write import check_place

    if options.output == STANDARD_OUTPUT:
        return None
    target = Path(f"{name}.tex" if options.output is None else options.output)
    if options.output is None and target.exists():
        raise OutputError(f"{target} is there already. Name a file with --output; that one is then replaced.")
    if not target.name:
        raise OutputError(f"{target} is a folder. Name a file with --output.")
    check_place(target.parent, [target.name], anything=True)
    return target


def _chapter() -> str:
    from kinsym.lecture.latex import chapter_document
    from kinsym.lecture.verdict import verdicts

    return chapter_document(list(verdicts()))


def _page(options: argparse.Namespace, robot: Robot) -> str:
    if options.method is not None:
        from kinsym.emit.latex.method_document import method_document
        from kinsym.methods import METHODS as DERIVED

        return method_document(robot, DERIVED[options.method](robot), "fragment" if options.fragment else "article")
    from kinsym.deriving import derive
    from kinsym.emit.latex import document, fragment

    derivation = derive(robot, deadline=options.deadline)
    return fragment(derivation) if options.fragment else document(derivation)
