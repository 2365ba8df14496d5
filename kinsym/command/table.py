"""The robot that the options name."""

from __future__ import annotations

import argparse
from dataclasses import replace
from fractions import Fraction

from kinsym.command.screen import Screen, filled
from kinsym.errors import KinsymError, RobotError
from kinsym.robot.files import from_inline
from kinsym.robot.loading import load
from kinsym.robot.locking import lock
from kinsym.robot.model import Robot, Task
from kinsym.robot.names import shown
from kinsym.robot.snapping import EXACT, ROUNDING, Snapping, snapping_of


def robot_of(options: argparse.Namespace) -> Robot:
    """Read TABLE or --dh with the options that say how."""
    if (options.table is None) == (options.dh is None):
        both = "both a table and --dh" if options.dh is not None else "no table"
        raise KinsymError(
            f"{both} given. Name a robot of the gallery or a file, or give --dh; list with: kinsym robots."
        )
    bindings = bindings_of(options.bind)
    snapping = snapping_from(options)
    common = {"convention": options.convention, "name": options.name, "bindings": bindings, "snapping": snapping}
    if options.dh is None:
        robot = load(options.table, base_link=options.base_link, tip_link=options.tip_link, **common)
    elif options.base_link is None and options.tip_link is None:
        robot = from_inline(options.dh, **common)
    else:
        raise KinsymError("--dh has no links. Leave out --base-link and --tip-link.")
    if options.lock:
        robot = lock(robot, locks_of(options.lock), where="--lock")
    robot = replace(robot, nominal=robot.nominal or options.nominal)
    return replace(robot, task=Task(options.task)) if options.task else robot


def locks_of(texts: list[str]) -> dict[str, str | None]:
    """The cells by joint from texts JOINT=VALUE, None from JOINT alone, which is an input.

    >>> locks_of(["theta3", "d1=0.2"])
    {'theta3': None, 'd1': '0.2'}
    """
    values: dict[str, str | None] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not name or (equals and not value):
            raise RobotError(
                f"{shown(text)} is neither JOINT nor JOINT=VALUE",
                where="--lock",
                remedy="Write, for example, --lock theta3 (an input) or --lock theta3=pi/4.",
            )
        if name in values:
            raise RobotError(f"{shown(name)[1:-1]} is locked twice", where="--lock", remedy="Lock each joint once.")
        values[name] = value or None
    return values


def snapping_from(options: argparse.Namespace) -> Snapping:
    """The policy of --exact and --snap; the usual one without them."""
    if options.exact:
        return EXACT
    return ROUNDING if options.snap is None else snapping_of(options.snap)


def say_notes(robot: Robot, screen: Screen) -> None:
    """What was read otherwise than written, and what looks like a slip."""
    if robot.notes:
        screen.heading("Notes")
        for note in robot.notes:
            screen.say("\n".join(f"  {line}" for line in filled(note, screen.width - 2)))
        screen.say()


def bindings_of(texts: list[str]) -> dict[str, Fraction]:
    """Exact numbers by parameter name from texts NAME=VALUE.

    >>> bindings_of(["a2=0.4318"])
    {'a2': Fraction(2159, 5000)}
    """
    from kinsym.robot.expressions import number

    values: dict[str, Fraction] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise RobotError(
                f"{shown(text)} is not NAME=VALUE", where="--bind", remedy="Write, for example, --bind a2=0.4318."
            )
        if name in values:
            raise RobotError(f"{shown(name)[1:-1]} is bound twice", where="--bind", remedy="Bind each parameter once.")
        values[name] = number(value, where=f"--bind {shown(name)[1:-1]}")
    return values
