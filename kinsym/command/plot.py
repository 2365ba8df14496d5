"""``kinsym plot``: a picture of an arm at a posture, or of all solutions of a pose."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from kinsym.command.options import add_quiet, add_table
from kinsym.errors import KinsymError, RobotError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.live import Floats, LiveArm
    from kinsym.robot.model import Robot
    from kinsym.skeleton import Linkage

HELP = "draw the arm: a posture, or all solutions of a pose"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = "Draw the arm as PNG or SVG (pip install 'kinsym[plot]')."
    add_table(command)
    command.add_argument(
        "--joints",
        metavar="CELLS",
        help='joint values "0.1, deg(20), ..." (default: a posture that shows the arm well)',
    )
    command.add_argument(
        "--pose", metavar="CELLS", help='with --branch or --branches: "x, y, z" or "x, y, z, roll, pitch, yaw" instead'
    )
    which = command.add_mutually_exclusive_group()
    which.add_argument("--branches", action="store_true", help="all solutions of the pose, drawn over each other")
    which.add_argument(
        "--branch", metavar="N", type=int, help="the solution of the pose with this place in BRANCHES of the solver"
    )
    command.add_argument("--no-frames", action="store_true", help="without the frames")
    command.add_argument("--unit", default="", help="the unit of length, to write at the axes")
    command.add_argument("-o", "--output", metavar="FILE", help="a .svg or .png file (default: ./NAME.svg)")
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Read, solve if branches are asked for, draw, write."""
    from kinsym.command.output import PICTURES, kind_of, targets, write
    from kinsym.command.table import robot_of, say_notes

    if options.deadline is not None:
        raise KinsymError("--deadline belongs to kinsym derive. Leave it out.")
    if options.pose is not None and options.branch is None and not options.branches:
        raise KinsymError("--pose says which solutions to draw. Add --branches, or --branch N.")
    robot = robot_of(options)
    named = None if options.output is None else [options.output]
    (path,) = targets(named, [f"{robot.name}.svg"], PICTURES)
    say_notes(robot, screen)
    from kinsym.plot import plain_style, rendered

    with plain_style():
        content = rendered(_picture(robot, options, screen), kind_of(path))
    write({path: content})
    screen.say(f"Written\n-------\n  {path}")
    return 0


def _picture(robot: Robot, options: argparse.Namespace, screen: Screen) -> Any:
    from kinsym.command.cells import pose_of, posture_of
    from kinsym.command.output import unit_of
    from kinsym.live import live
    from kinsym.plot import branches, skeleton
    from kinsym.skeleton import linkage

    shape = linkage(robot)
    q = posture_of(robot, shape, options.joints)
    look: dict[str, Any] = {"frames": not options.no_frames, "unit": unit_of(options)}
    if options.branch is None and not options.branches:
        _say(screen, shape, q, "")
        return skeleton(robot, q, **look)
    screen.stage(f"deriving {robot.name}")
    arm = live(
        robot, {name: float(q[robot.variables.index(name)]) for name, cell in robot.locks.items() if cell is None}
    )
    pose = arm.fk(q) if options.pose is None else pose_of(options.pose)
    found = arm.solve(pose)
    for place, row in zip(found.branch, found.q, strict=True):
        if options.branch in (None, place):
            _say(screen, shape, row, f"{place}  {arm.module.BRANCHES[place]}")
    if options.branch is None:
        return branches(arm, pose, **look)
    return skeleton(arm, _of_branch(arm, found, options.branch), **look)


def _of_branch(arm: LiveArm, found: Any, branch: int) -> Floats:
    """The joint values of one branch; RobotError where the pose has none there."""
    places = [int(place) for place in found.branch]
    if branch in places:
        row: Floats = found.q[places.index(branch)]
        return row
    name = arm.robot.name
    if not 0 <= branch < len(arm.module.BRANCHES):
        raise RobotError(
            f"there is no branch {branch}", where=name, remedy=f"Give one from 0 to {len(arm.module.BRANCHES) - 1}."
        )
    if not places:
        raise RobotError("the pose is out of reach", where=name, remedy="Give another one.")
    listed = ", ".join(map(str, places))
    raise RobotError(f"the pose has no solution in branch {branch}", where=name, remedy=f"It has some in {listed}.")


def _say(screen: Screen, shape: Linkage, q: Floats, head: str) -> None:
    import math

    values = [
        f"{name} = {math.degrees(value):.2f} deg" if kind == "R" else f"{name} = {value:.6g}"
        for name, kind, value in zip(shape.variables, shape.kinds, q, strict=True)
    ]
    screen.say("\n".join([*([head] if head else []), "  " + ", ".join(values)]))
