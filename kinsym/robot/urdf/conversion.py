"""One chain of a URDF file as a robot: an exact table in Paul's convention, and how far it is from the file.

The numbers of the file are exact decimals. Angles that round a multiple of 15 degrees, axes that are parallel or meet
but for rounding, and vectors that are not quite of length one become exact (:mod:`kinsym.robot.snapping`); fixed
joints are folded in. What the conversion changes is measured: the forward kinematics of the chain as written against
that of the table.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import sympy
from sympy import Expr, Rational

from kinsym.errors import RobotError
from kinsym.robot.files import from_draft
from kinsym.robot.geometry.arm import Arm, Axis, arm_of, difference, mpf
from kinsym.robot.geometry.frames import CONTEXT, DIGITS, UNIT, Number, Vector, along, from_rpy, norm, unit
from kinsym.robot.geometry.table import Tolerance, table_of
from kinsym.robot.model import Change, Deviation, Robot
from kinsym.robot.names import check_robot_name, shown
from kinsym.robot.snapping import EXACT, ROUNDING, Snapping
from kinsym.robot.special import change_notes
from kinsym.robot.text import value_text
from kinsym.robot.urdf.document import LONGEST_NAME, Triple, UrdfJoint, read_urdf
from kinsym.robot.urdf.path import joints_between


def from_urdf(
    path: Path,
    *,
    base_link: str | None = None,
    tip_link: str | None = None,
    name: str | None = None,
    snapping: Snapping = ROUNDING,
    shown_as: str | None = None,
) -> Robot:
    """The robot between two links of a URDF file, its frame of reference that of ``base_link``.

    The joint variables are theta1, theta2, d3 and so on and are zero where the file's are; lengths are parameters
    with the file's values (metres); limits are carried over. Raises RobotError.
    """
    where = str(path) if shown_as is None else shown_as
    urdf = read_urdf(path, shown_as=where)
    joints = joints_between(urdf, base_link, tip_link, where=where)
    changes: list[Change] = []
    written, read = _arm(joints, EXACT, []), _arm(joints, snapping, changes)
    table = table_of(read, Tolerance.of(snapping.within))
    links = f"{joints[0].parent} to {joints[-1].child}"
    draft = {
        "name": name if name is not None else _safe_name(urdf.name, path.stem),
        "title": _printable(urdf.name),
        "source": _printable(f"{path.name}, {links}"),
        **table.draft,
    }
    robot = from_draft(draft, where=where, snapping=EXACT)
    position, rotation = difference(written, arm_of(robot))
    deviation = Deviation(changes=(*changes, *table.changes), position=position, rotation=rotation)
    notes = (*_names(joints, robot), *_limitless(joints), *robot.notes, *change_notes(deviation))
    return replace(robot, deviation=deviation, notes=notes)


def _arm(joints: tuple[UrdfJoint, ...], snapping: Snapping, changes: list[Change]) -> Arm:
    """The axes at home in the frame of the first link; ``changes`` receives what is read otherwise than written."""
    here = UNIT
    axes: list[Axis] = []
    for joint in joints:
        where = f"joint {_printable(joint.name)}, rpy"
        roll, pitch, yaw = (_angle(value, where, snapping, changes) for value in joint.rpy)
        here = here.then(from_rpy(_numbers(joint.xyz), (roll, pitch, yaw)))
        if joint.kind == "fixed":
            continue
        direction = _direction(joint, snapping, changes)
        kind = "P" if joint.kind == "prismatic" else "R"
        variable = f"{'d' if kind == 'P' else 'theta'}{len(axes) + 1}"
        frame = here.then(along(direction, UNIT.origin))
        axes.append(Axis(name=variable, kind=kind, frame=frame, limits=joint.limits))
    return Arm(axes=tuple(axes), tip=here)


def _numbers(triple: Triple) -> tuple[Number, Number, Number]:
    x, y, z = (mpf(value) for value in triple)
    return x, y, z


def _angle(value: Fraction, where: str, snapping: Snapping, changes: list[Change]) -> Number:
    cell, change = snapping.angle(Rational(value.numerator, value.denominator), where=where)
    if change:
        changes.append(change)
    return _value(cell)


def _value(cell: Expr) -> Number:
    return CONTEXT.mpf(str(sympy.N(cell, DIGITS)))


def _direction(joint: UrdfJoint, snapping: Snapping, changes: list[Change]) -> Vector:
    """The axis as a unit vector; readers differ on what a slide along a longer one means, so that a change is told."""
    where = f"joint {_printable(joint.name)}, axis"
    x, y, z = (Rational(value.numerator, value.denominator) for value in joint.axis)
    exact, change = snapping.direction((x, y, z), where=where)
    if change:
        changes.append(change)
        x, y, z = (_value(cell) for cell in exact)
        return x, y, z
    axis = _numbers(joint.axis)
    excess = abs(norm(axis) - 1)
    if excess:
        written = " ".join(value_text(value) for value in joint.axis)
        changes.append(Change(where=where, written=written, read_as="a unit vector", difference=float(excess)))
    return unit(axis)


def _names(joints: tuple[UrdfJoint, ...], robot: Robot) -> tuple[str, ...]:
    moving = [joint for joint in joints if joint.kind != "fixed"]
    pairs = zip(robot.variables, moving, strict=True)
    return tuple(f"{variable} is the joint {_printable(joint.name)}." for variable, joint in pairs)


def _limitless(joints: tuple[UrdfJoint, ...]) -> tuple[str, ...]:
    """Joints that should have a range and have none."""
    return tuple(
        f"joint {_printable(joint.name)}: its limit gives no range, so it has none here."
        for joint in joints
        if joint.kind in ("revolute", "prismatic") and joint.limits is None
    )


def _printable(text: str) -> str:
    return text if text.isprintable() and len(text) <= LONGEST_NAME else shown(text, longest=LONGEST_NAME)[1:-1]


def _safe_name(text: str, stem: str) -> str:
    """A name for files and functions from the robot's name in the file, or from the file's."""
    for candidate in (text, stem, f"{text}_arm", f"{stem}_arm"):
        # Letters with marks are taken apart first: u-umlaut becomes u.
        letters = re.sub(r"[\u0300-\u036f]", "", unicodedata.normalize("NFKD", candidate))
        plain = re.sub(r"[^A-Za-z0-9]+", "_", letters).strip("_")[:40].rstrip("_")
        try:
            return check_robot_name(plain, where="")
        except RobotError:
            continue
    return "urdf_arm"
