"""A table with the special values that its numbers round: twists, offsets, and lengths that are next to zero.

Each cell is looked at alone, so that the user's rows and names stay. :mod:`kinsym.robot.nearby` goes further and puts
axes in order that are off by real millimetres.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from sympy import Expr, Integer, Rational

from kinsym.robot.binding import bind
from kinsym.robot.expressions import names
from kinsym.robot.geometry.arm import arm_of, difference
from kinsym.robot.model import Change, Deviation, Joint, Robot
from kinsym.robot.snapping import Snapping
from kinsym.robot.text import value_text


def special(
    robot: Robot, snapping: Snapping, *, written: Robot | None = None, earlier: tuple[Change, ...] = ()
) -> Robot:
    """The robot with its cells and parameters read under a policy, with its deviation and notes.

    ``earlier`` are changes already made, to base and tool; ``written`` is then the robot before them.

    >>> from kinsym.robot import from_inline
    >>> from kinsym.robot.snapping import EXACT, ROUNDING
    >>> robot = from_inline("1.5708 0 0 theta1; 0 1 0 theta2", convention="paul", snapping=EXACT)
    >>> special(robot, ROUNDING).joints[0].alpha
    pi/2
    """
    size = _size(robot)
    changes = list(earlier)
    tiny = [name for name in robot.parameters if _tiny(robot, name, size, snapping)]
    for name in tiny:
        changes.append(_to_zero(f"parameter {name}", robot.parameters[name] or Fraction(0)))
    bound = bind(robot, dict.fromkeys(tiny, Fraction(0)))
    joints = tuple(_row(joint, i, size, snapping, changes) for i, joint in enumerate(bound.joints, start=1))
    if not changes:
        return robot
    result = replace(bound, joints=joints)
    position, rotation = difference(arm_of(written or robot), arm_of(result))
    deviation = Deviation(changes=tuple(changes), position=position, rotation=rotation)
    return replace(result, notes=(*robot.notes, *change_notes(deviation)), deviation=deviation)


NOTED = 1e-9
"""A smaller change is the rounding of a program's numbers and is counted, not told one by one."""


def change_notes(deviation: Deviation) -> tuple[str, ...]:
    """The changes worth a line, then the deviation in one sentence."""
    told = [change for change in deviation.changes if change.difference > NOTED]
    lines = [
        f"{change.where}: {change.written} is read as {change.read_as} (off by {change.difference:.1e})."
        for change in told
    ]
    return (*lines, deviation.sentence())


def _row(joint: Joint, row: int, size: Fraction, snapping: Snapping, changes: list[Change]) -> Joint:
    def length(cell: Expr, column: str) -> Expr:
        constant, rest = cell.as_coeff_Add()
        if not isinstance(constant, Rational) or not snapping.negligible(value := _fraction(constant), size):
            return cell
        changes.append(_to_zero(f"row {row}, {column}", value))
        return rest

    if joint.s0 is not None:
        x, y, z = joint.s0
        return replace(joint, s0=(length(x, "s0"), length(y, "s0"), length(z, "s0")))
    if joint.alpha is None or joint.theta is None or joint.a is None or joint.d is None:
        return joint
    cells = {"a": length(joint.a, "a"), "d": length(joint.d, "d")}
    for column, cell in (("alpha", joint.alpha), ("theta", joint.theta)):
        cells[column], change = snapping.angle(cell, where=f"row {row}, {column}")
        changes += [change] if change else []
    return replace(joint, **cells)


def _to_zero(where: str, value: Fraction) -> Change:
    return Change(where=where, written=value_text(value), read_as="0", difference=abs(float(value)))


def _tiny(robot: Robot, name: str, size: Fraction, snapping: Snapping) -> bool:
    """Whether a parameter is read as zero: as an angle if it stands in one, as a length otherwise."""
    value = robot.parameters[name]
    angle = any(
        name in names(cell) for joint in robot.joints for cell in (joint.alpha, joint.theta) if cell is not None
    )
    return value is not None and snapping.negligible(value, Fraction(1) if angle else size)


def _size(robot: Robot) -> Fraction:
    """The sum of the lengths of a table as far as they are numbers."""
    numbers = [value for value in robot.parameters.values() if value is not None]
    for joint in robot.joints:
        for cell in (joint.a or Integer(0), joint.d or Integer(0), *(joint.s0 or ())):
            constant = cell.as_coeff_Add()[0]
            numbers += [_fraction(constant)] if isinstance(constant, Rational) else []
    return sum((abs(value) for value in numbers), Fraction(0))


def _fraction(value: Rational) -> Fraction:
    return Fraction(int(value.p), int(value.q))
