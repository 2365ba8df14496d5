"""A robot as Python that builds a DHRobot of the Robotics Toolbox (P. Corke, roboticstoolbox-python).

Its standard links (RevoluteDH, PrismaticDH) are Rz(theta) Tz(d) Tx(a) Rx(alpha), Paul's rows; its modified ones
(RevoluteMDH, PrismaticMDH) Rx(alpha) Tx(a) Rz(theta) Tz(d), Craig's. ``flip`` turns the sign of the joint variable
before ``offset`` is added.
"""

from __future__ import annotations

from dataclasses import replace

from sympy import Integer, Matrix, cos, sin

from kinsym import __version__
from kinsym.emit.environment import render
from kinsym.emit.source.banner import python_docstring, python_string
from kinsym.export.numbers import decimal, python_number, require_numbers
from kinsym.kinematics.links import offset
from kinsym.robot.files import from_draft
from kinsym.robot.geometry.arm import arm_of
from kinsym.robot.geometry.table import Tolerance, table_of
from kinsym.robot.model import Convention, Joint, Robot
from kinsym.robot.snapping import EXACT

_CLASSES = {
    (Convention.PAUL, "R"): "RevoluteDH",
    (Convention.PAUL, "P"): "PrismaticDH",
    (Convention.CRAIG, "R"): "RevoluteMDH",
    (Convention.CRAIG, "P"): "PrismaticMDH",
}


def rtb(robot: Robot) -> str:
    """The text of a Python file that defines ``robot``, a DHRobot.

    Rows without a joint have no place in a DHRobot: those behind the last joint of Craig's table become a part of the
    tool; any other table with such rows, and joint screws, are written anew in Paul's convention along the same axes.
    Raises :class:`RobotError` with the parameters that have no value.

    >>> from kinsym.robot import load
    >>> [line.strip() for line in rtb(load("ur5")).splitlines() if "RevoluteDH(" in line][1]
    'RevoluteDH(d=0, a=-0.425, alpha=0, offset=0),'
    """
    require_numbers(robot)
    robot = _without_last_rows(robot)
    if robot.convention is Convention.SCREW or len(robot.moving) < len(robot.joints):
        draft = {"name": robot.name, **table_of(arm_of(robot), _NOTHING).draft}
        table = from_draft(draft, where=robot.name, snapping=EXACT)
        robot = replace(table, title=robot.title)
    kinds = sorted({_CLASSES[robot.convention, joint.kind] for joint in robot.joints})
    frames = [(key, matrix) for key, matrix in (("base", robot.base), ("tool", robot.tool)) if matrix is not None]
    links = [_link(joint, robot) for joint in robot.joints]
    lines = [
        *(["from math import pi", ""] if any("pi" in link for link in links) else []),
        *(["import numpy as np"] if frames else []),
        f"from roboticstoolbox import DHRobot, {', '.join(kinds)}",
        *(["from spatialmath import SE3"] if frames else []),
    ]
    standard = robot.convention is Convention.PAUL
    return render(
        "export/robot_rtb.py.jinja",
        title=python_docstring(robot.title or robot.name),
        version=__version__,
        convention=f"{'Standard' if standard else 'Modified'} rows of {robot.convention.value.title()}'s convention",
        imports="\n".join(lines),
        links=links,
        name=python_string(robot.name),
        frames=[
            (key, [", ".join(python_number(cell, robot) for cell in row) for row in matrix]) for key, matrix in frames
        ],
    )


_NOTHING = Tolerance.of(0 * EXACT.within)


def _without_last_rows(robot: Robot) -> Robot:
    """Craig's table with the constant rows behind the last joint as a part of the tool."""
    count = len(robot.joints)
    while robot.convention is Convention.CRAIG and robot.joints[count - 1].kind == "fixed":
        count -= 1
    if count == len(robot.joints):
        return robot
    tool = Matrix.eye(4) if robot.tool is None else Matrix(robot.tool)
    for row in reversed(robot.joints[count:]):
        alpha, a, d, theta = (Integer(0) if cell is None else cell for cell in (row.alpha, row.a, row.d, row.theta))
        about_x = Matrix([[1, 0, 0, a], [0, cos(alpha), -sin(alpha), 0], [0, sin(alpha), cos(alpha), 0], [0, 0, 0, 1]])
        about_z = Matrix([[cos(theta), -sin(theta), 0, 0], [sin(theta), cos(theta), 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        tool = about_x * about_z * tool
    return replace(robot, joints=robot.joints[:count], tool=tuple(tuple(tool.row(i)) for i in range(4)))


def _link(joint: Joint, robot: Robot) -> str:
    slides = joint.kind == "P"
    cell = joint.d if slides else joint.theta
    if cell is None:
        raise TypeError(f"the row of {joint.variable} has no cell for its variable")
    factor, rest = offset(cell, joint)
    fixed = ("theta", joint.theta) if slides else ("d", joint.d)
    values = [(fixed[0], fixed[1]), ("a", joint.a), ("alpha", joint.alpha), ("offset", rest)]
    words = [f"{name}={python_number(value, robot)}" for name, value in values]
    words += ["flip=True"] if factor < 0 else []
    words += [f"qlim=[{', '.join(decimal(float(limit)) for limit in joint.limits)}]"] if joint.limits else []
    return f"{_CLASSES[robot.convention, joint.kind]}({', '.join(words)})"
