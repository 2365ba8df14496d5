"""Locked joints: what an arm with more joints than its task fixes needs before it can be solved.

A locked joint moves the arm like any other; only the inverse kinematics does not look for it. It is held at a value
of the table (exact, as a cell) or it is an input: the caller of the solver says where it is.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import sympy
from sympy import Expr

from kinsym.errors import RobotError
from kinsym.robot.expressions import names, parse
from kinsym.robot.model import Joint, Robot
from kinsym.robot.names import nearest, shown
from kinsym.robot.text import cell_text

INPUT = "input"
"""What a robot file writes for a locked joint that the caller of the solver gives."""

_DEGREES = re.compile(r"(?P<number>[-+]?[0-9.]+)\s*(deg|°)")
_UNIT = re.compile(r"[-+]?[0-9.]+\s*(?P<unit>(?!pi\b)[A-Za-z]+)")


def lock(robot: Robot, values: Mapping[str, object], *, where: str = "lock") -> Robot:
    """The robot with these joints locked, and no others.

    ``values`` maps joint variables to the value a joint is held at, a cell such as ``"pi/4"``, ``"deg(30)"`` or
    ``0.5`` (radians, the table's unit of length), or to None for an input. Raises RobotError for what is no joint, for
    a value that is none of its kind or outside its limits, and where no joint is left to solve for.

    >>> from kinsym.robot import load
    >>> lock(load("puma560"), {"theta6": "pi/4", "theta1": None}).locks
    {'theta1': None, 'theta6': pi/4}
    """
    joints = {joint.variable: joint for joint in robot.moving if joint.variable is not None}
    for name in values:
        if name not in joints:
            raise RobotError(
                f"{robot.name} has no joint {shown(name)}",
                where=where,
                remedy=f"{nearest(name, joints)}Its joints: {', '.join(joints)}.",
            )
    if len(values) == len(joints):
        raise RobotError(
            "every joint is locked, so none is left to solve for", where=where, remedy="Leave at least one unlocked."
        )
    held = {
        name: None if values[name] is None else joint_value(values[name], joint, f"{where} {name}", input=True)
        for name, joint in joints.items()
        if name in values
    }
    return replace(robot, locks=held)


def lock_text(value: Expr | None) -> str:
    """A lock as the robot file states it: the cell, or ``input``."""
    return INPUT if value is None else cell_text(value)


def joint_value(cell: object, joint: Joint, where: str, *, input: bool = False) -> Expr:
    """The value that a cell gives a joint, in radians or the table's unit of length.

    Raises RobotError for what is no number of the joint's kind or outside its limits; ``input`` lets the message say
    that a lock can do without a value.
    """
    revolute = joint.kind == "R"
    value = parse(_plain(cell, revolute, where), where=where)
    if value.free_symbols:
        raise RobotError(
            f"the value of a {'lock' if input else 'joint'} depends on {names(value)[0]}",
            where=where,
            remedy=f"Write a number, or lock {joint.variable} without a value: then it is an input of the solver."
            if input
            else "Write a number.",
        )
    if not revolute and value.has(sympy.pi):
        raise RobotError(
            f"{joint.variable} is a length and {shown(str(cell))} an angle",
            where=where,
            remedy="Write a number in the table's unit of length.",
        )
    if revolute and abs(value) > 2 * sympy.pi:
        number = cell_text(value)
        raise RobotError(
            f"{number} radians are more than a turn", where=where, remedy=f"Write deg({number}) for degrees."
        )
    if joint.limits is not None and not joint.limits[0] <= value <= joint.limits[1]:
        low, high = (f"{float(limit):.6g}" for limit in joint.limits)
        raise RobotError(
            f"{cell_text(value)} is outside the limits of {joint.variable}",
            where=where,
            remedy=f"Give a value from {low} to {high}.",
        )
    return value


def _plain(cell: object, revolute: bool, where: str) -> object:
    """The cell without a unit: 30deg is deg(30), and any other unit is refused by name."""
    if not isinstance(cell, str):
        return cell
    text = cell.strip()
    if match := _DEGREES.fullmatch(text):
        return f"deg({match['number']})"
    if match := _UNIT.fullmatch(text):
        kind = "an angle is in radians, or in degrees as deg(30)" if revolute else "a length is in the table's unit"
        raise RobotError(
            f"{shown(text)} has the unit {match['unit']}", where=where, remedy=f"Leave the unit out: {kind}."
        )
    return text
