"""``kinsym workspace``: what an arm reaches, as a picture and as data."""

from __future__ import annotations

import argparse
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.command.options import add_quiet, add_table
from kinsym.errors import KinsymError, RobotError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.robot.model import Robot
    from kinsym.workspace.sweeping import Question, Workspace

HELP = "what the arm reaches: a map of a slice, a volume, data"
KINDS = ("reachable", "dexterous", "constant")
ORIENTATIONS = 100
POINTS, POINTS_OF_VOLUME = 101, 31


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = (
        "Evaluate the workspace on a grid and draw it (PNG or SVG, pip install 'kinsym[plot]') or write it as data "
        "(.npz or .csv). A sweep that was stopped goes on where it was when the same command is given again."
    )
    add_table(command)
    command.add_argument(
        "--kind", choices=KINDS, help="with some orientation, with every one, or with one (default: reachable)"
    )
    command.add_argument(
        "--orientation", metavar="CELLS", help='"roll, pitch, yaw" of the constant one, as in URDF (default: "0, 0, 0")'
    )
    command.add_argument(
        "--count", metavar="N", type=int, default=ORIENTATIONS, help=f"orientations to try (default: {ORIENTATIONS})"
    )
    command.add_argument("--no-limits", action="store_true", help="leave out the limits of the joints")
    where = command.add_mutually_exclusive_group()
    where.add_argument("--slice", metavar="AXIS=CELL", help="a plane, such as z=0.3 (default: y=0, or the arm's plane)")
    where.add_argument("--volume", action="store_true", help="the whole box around the workspace")
    command.add_argument(
        "--points",
        metavar="N",
        type=int,
        help=f"along the longest side of the grid (default: {POINTS}, of a volume {POINTS_OF_VOLUME})",
    )
    command.add_argument("--jobs", metavar="N", type=int, default=1, help="processes (default: 1)")
    command.add_argument("--scheduler", metavar="ADDRESS", help="a Dask cluster instead (pip install 'kinsym[dask]')")
    command.add_argument("--unit", default="", help="the unit of length, to write at the axes")
    command.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        action="append",
        help="a .svg, .png, .npz or .csv file (repeatable; default: ./NAME_workspace.svg and .npz)",
    )
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Read, evaluate, write; what was found of a sweep that is stopped stays in a file beside the first output."""
    from kinsym.command.bar import Bar
    from kinsym.command.output import PICTURES, kind_of, targets, unit_of, write
    from kinsym.command.table import robot_of, say_notes
    from kinsym.workspace.files import FORMATS, data
    from kinsym.workspace.partial import forget
    from kinsym.workspace.sweeping import sweep

    _check(options)
    robot = robot_of(options)
    usual = [f"{robot.name}_workspace.{kind}" for kind in ("svg", "npz")]
    paths = targets(options.output, usual, (*PICTURES, *FORMATS))
    keep = paths[0].with_name(paths[0].stem + ".partial.npz")
    if keep in paths:
        raise KinsymError(f"{keep} is the name under which an unfinished sweep is kept. Choose another with --output.")
    say_notes(robot, screen)
    question = _question(robot, options, screen)
    if keep.exists():
        screen.stage(f"going on with {keep}")
    screen.stage(f"evaluating {' x '.join(str(n) for n in question.shape if n > 1)} points")
    bar = Bar(quiet=options.quiet)
    try:
        found = sweep(question, jobs=options.jobs, scheduler=options.scheduler, keep=keep, progress=bar)
    finally:
        bar.clear()
    files = {path: data(found, kind_of(path)) for path in paths if kind_of(path) in FORMATS}
    pictures = [path for path in paths if kind_of(path) in PICTURES]
    if pictures:
        from kinsym.plot import plain_style, rendered, workspace

        with plain_style():
            drawn = workspace(found, unit=unit_of(options))
            files |= {path: rendered(drawn, kind_of(path)) for path in pictures}
    write(files)
    forget(keep)
    _say(found, paths, unit_of(options), screen)
    return 0


def _check(options: argparse.Namespace) -> None:
    if options.deadline is not None:
        raise KinsymError("--deadline belongs to kinsym derive. Leave it out.")
    if options.orientation is not None and options.kind not in (None, "constant"):
        raise KinsymError(f"--orientation is for --kind constant, not {options.kind}. Leave out one of both.")
    if options.count < 1:
        raise KinsymError(f"--count {options.count} orientations are none. Ask for one or more.")
    if options.jobs < 1:
        raise KinsymError(f"--jobs {options.jobs} processes are none. Ask for one or more.")
    if options.scheduler is not None and options.jobs > 1:
        raise KinsymError("--jobs are processes here and --scheduler a cluster elsewhere. Give one of both.")


def _question(robot: Robot, options: argparse.Namespace, screen: Screen) -> Question:
    from kinsym.command.cells import numbers, rotation
    from kinsym.skeleton import linkage
    from kinsym.workspace.asking import ask
    from kinsym.workspace.grids import endless

    kind = options.kind or ("reachable" if options.orientation is None else "constant")
    question = ask(
        robot,
        kind,
        plane=_plane(options.slice),
        volume=options.volume,
        points=options.points,
        count=options.count,
        rotation=rotation(numbers(options.orientation or "0, 0, 0", (3,), "--orientation"))
        if kind == "constant"
        else None,
        limits=not options.no_limits,
    )
    without = endless(linkage(robot))
    if without:
        have = "has" if len(without) == 1 else "have"
        screen.say(f"{', '.join(without)} {have} no limits: the picture ends where the grid does, not the workspace.")
    return question


def _plane(text: str | None) -> tuple[str, float] | None:
    from kinsym.robot.expressions import number

    if text is None:
        return None
    name, equals, value = (part.strip() for part in text.partition("="))
    if name not in ("x", "y", "z") or not equals:
        raise RobotError(f"{text!r} is no plane", where="--slice", remedy="Write, for example, --slice z=0.3.")
    return name, float(number(value, where="--slice"))


def _say(found: Workspace, paths: list[Path], unit: str, screen: Screen) -> None:
    inside, total = int(found.inside.sum()), found.inside.size
    steps = [axis[1] - axis[0] for axis in (found.question.x, found.question.y, found.question.z) if len(axis) > 1]
    measure = "an area" if len(steps) == 2 else "a volume"
    size = f"{inside * prod(steps):.4g}" + (f" {unit}^{len(steps)}" if unit else "")
    screen.say(f"{inside} of {total} points are inside: {measure} of about {size}.")
    if found.border:
        radii = " and ".join(f"{radius:.6g}" for radius in found.border)
        screen.say(f"In closed form its border is the circle{'s' * (len(found.border) > 1)} of radius {radii}.")
    screen.say("\n".join(["Written", "-------", *(f"  {path}" for path in paths)]))
