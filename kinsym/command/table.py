"""The robot that the options name."""

from __future__ import annotations

import argparse
from dataclasses import replace
from fractions import Fraction

from kinsym.errors import KinsymError, RobotError
from kinsym.robot.files import from_inline, load
from kinsym.robot.locking import lock
from kinsym.robot.model import Robot, Task


def robot_of(options: argparse.Namespace) -> Robot:
    """Read TABLE or --dh with --convention, --name, --bind, --lock and --task."""
    if (options.table is None) == (options.dh is None):
        both = "both a table and --dh" if options.dh is not None else "no table"
        raise KinsymError(
            f"{both} given. Name a robot of the gallery or a file, or give --dh; list with: kinsym robots."
        )
    bindings = bindings_of(options.bind)
    if options.dh is not None:
        robot = from_inline(options.dh, convention=options.convention, name=options.name, bindings=bindings)
    else:
        robot = load(options.table, convention=options.convention, name=options.name, bindings=bindings)
    if options.lock:
        robot = lock(robot, locks_of(options.lock), where="--lock")
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
                f"{text!r} is neither JOINT nor JOINT=VALUE",
                where="--lock",
                remedy="Write, for example, --lock theta3 (an input) or --lock theta3=pi/4.",
            )
        if name in values:
            raise RobotError(f"{name} is locked twice", where="--lock", remedy="Lock each joint once.")
        values[name] = value or None
    return values


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
                f"{text!r} is not NAME=VALUE", where="--bind", remedy="Write, for example, --bind a2=0.4318."
            )
        if name in values:
            raise RobotError(f"{name} is bound twice", where="--bind", remedy="Bind each parameter once.")
        values[name] = number(value, where=f"--bind {name}")
    return values
