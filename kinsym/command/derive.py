"""``kinsym derive``: the main job, from a table to checked files."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import add_json, add_quiet, add_table
from kinsym.command.rendering import REALS

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

TARGETS = ("numpy", "c", "latex", "extension", "cpp", "ikfast")


HELP = "derive, check and write a robot's kinematics"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_table(command)
    command.add_argument("-o", "--output", metavar="DIR", help="where to write (default: ./NAME)")
    command.add_argument(
        "--target",
        action="append",
        choices=TARGETS,
        help="write this only (repeatable; default: numpy, c and latex); extension is a Python package around the C,"
        " cpp a header of C++, ikfast a solver for MoveIt and OpenRAVE",
    )
    command.add_argument(
        "--real",
        choices=REALS,
        default=REALS[0],
        help="the type of the numbers in NAME.c and NAME.h; float is for processors without double precision, with"
        " tolerances of its own",
    )
    command.add_argument("--no-check", action="store_true", help="write the files without checking them")
    add_quiet(command)
    add_json(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Derive, print, emit, check, write; 1 if a check failed, in which case the report says which."""
    from kinsym.check.report import SUFFIX
    from kinsym.check.reporting import report_of
    from kinsym.command.outcome import say_checks, say_operations, verdict
    from kinsym.command.rendering import check_real, file_names, of_real, rendered
    from kinsym.command.table import robot_of, say_notes
    from kinsym.deriving import derive as derivation_of
    from kinsym.emit.program import build_schedule
    from kinsym.emit.text import equations
    from kinsym.write import check_place, put_back, write_set

    check_real(options.real, options.target)
    screen.stage("reading the table")
    robot = robot_of(options)
    folder = Path(options.output if options.output is not None else robot.name)
    put_back(folder)
    check_place(folder, [*file_names(robot.name, options.target), robot.name + SUFFIX])
    say_notes(robot, screen)
    screen.flush()
    screen.stage(f"deriving {robot.name}")
    derivation = derivation_of(robot, deadline=options.deadline)
    if screen.speaks:
        screen.say(equations(derivation, width=screen.width, ascii=screen.ascii))
        screen.flush()
    screen.stage("writing the sources")
    schedule = of_real(options.real, build_schedule(derivation))
    sources = rendered(derivation, schedule, options.target)
    findings = None
    if not options.no_check:
        from kinsym.check.compare import compare

        findings = compare(derivation.robot, schedule, sources, screen.stage)
    report = report_of(derivation.robot, schedule, sources, findings)
    paths = write_set(folder, {**sources, robot.name + SUFFIX: report.text()})
    say_operations(report, screen)
    say_checks(report, screen)
    screen.heading("Written")
    for path in paths:
        screen.say(f"  {path}")
    status = verdict(report, folder, screen)
    if options.json:
        from kinsym.command.as_json import derived

        screen.give(derived(derivation, report, paths, status))
    return status
