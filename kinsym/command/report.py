"""``kinsym report``: everything about a robot on one page that opens from disk."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import add_quiet, add_table
from kinsym.errors import OutputError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

HELP = "write one page with the arm drawn, its equations, checks and code"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = (
        "Write one HTML file that loads nothing: the arm drawn in space, which the reader can turn and move, all"
        " solutions of its pose, the derivation, singular poses, a slice of the workspace, the checks and the code."
    )
    add_table(command)
    command.add_argument("-o", "--output", metavar="FILE", help="the page to write (default: ./NAME.html)")
    command.add_argument("--no-check", action="store_true", help="write the page without checking the code in it")
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Derive, check, draw, write; a page that is there is replaced only if ``--output`` names it."""
    from kinsym.check.reporting import report_of
    from kinsym.command.outcome import verdict
    from kinsym.command.rendering import rendered
    from kinsym.command.table import robot_of, say_notes
    from kinsym.deriving import derive
    from kinsym.emit.live import live_module
    from kinsym.emit.program import build_schedule
    from kinsym.page import page
    from kinsym.page.shown import shown
    from kinsym.write import check_place, write_set

    screen.stage("reading the table")
    robot = robot_of(options)
    target = Path(f"{robot.name}.html" if options.output is None else options.output)
    if options.output is None and target.exists():
        raise OutputError(f"{target} is there already. Name a file with --output; that one is then replaced.")
    check_place(target.parent, [target.name], anything=True)
    say_notes(robot, screen)
    screen.flush()
    screen.stage(f"deriving {robot.name}")
    derivation = derive(robot, deadline=options.deadline)
    schedule = build_schedule(derivation)
    sources = rendered(derivation, schedule, ("numpy", "c"))
    findings = None
    if not options.no_check:
        from kinsym.check.compare import compare

        findings = compare(derivation.robot, schedule, sources, screen.stage)
    report = report_of(derivation.robot, schedule, sources, findings)
    screen.stage("drawing the page")
    text = page(derivation, schedule, sources, report, shown(derivation, live_module(schedule)))
    paths = write_set(target.parent, {target.name: text}, anything=True)
    screen.say(f"Written\n-------\n  {paths[0]}")
    return verdict(report, target.parent, screen)
