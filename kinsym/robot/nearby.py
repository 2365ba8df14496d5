"""The special arm next to a given one: the nominal table of an arm that was calibrated, or measured, or built askew.

A calibrated arm is off its drawing by some 1e-3 rad and tenths of a millimetre. No two of its axes are parallel or
meet, so that only the general solver of a polynomial of degree 16 applies to it; its nominal neighbour has a closed
form, whose solutions lead to those of the true arm in a few Newton steps. This module finds the neighbour.

Nothing is refused here and nothing is hidden: :class:`Nearly` holds both arms and every number in which they differ.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from kinsym.errors import RobotError
from kinsym.robot.files import from_draft
from kinsym.robot.geometry.arm import arm_of, difference
from kinsym.robot.geometry.table import Tolerance, table_of
from kinsym.robot.model import Deviation, Robot
from kinsym.robot.snapping import EXACT, LARGEST_TOLERANCE, ROUNDING
from kinsym.robot.special import change_notes

TWISTS = Fraction(1, 50)
"""1.15 degrees; a UR10 was measured with axes 0.0135 rad off parallel."""
NORMALS = Fraction(1, 200)
"""5 mm in an arm of 1 m; designed offsets are larger (20 mm, Puma 560)."""


@dataclass(frozen=True, kw_only=True)
class Nearly:
    """An arm, its special neighbour with the same joint variables, and how far they are apart."""

    true: Robot
    nominal: Robot
    deviation: Deviation


def nominal(robot: Robot, *, twists: Fraction = TWISTS, normals: Fraction = NORMALS) -> Nearly:
    """The special arm next to a robot, a table in Paul's convention.

    Between two joint axes, twists that are off a multiple of 15 degrees by at most ``twists`` (radians) are set to it
    and common normals of at most ``normals`` (a share of the arm's size) to zero, so that axes become parallel or
    meet; so is the distance of two feet on an axis whose neighbours meet it. Other lengths, and the offsets of the
    joint angles, stay as they are. Base and tool stay but for rounding.

    Raises RobotError for a parameter without a value and for a tolerance outside of (0, 0.1].

    >>> from kinsym.robot import from_inline
    >>> arm = from_inline("1.5712 0.0001 0.3 theta1; 0.0004 0.5 0 theta2; 0 0.4 0 theta3", convention="paul")
    >>> [str(joint.alpha) for joint in nominal(arm).nominal.joints]
    ['pi/2', '0', '0']
    """
    if not all(0 < tolerance <= LARGEST_TOLERANCE for tolerance in (twists, normals)):
        raise RobotError("a tolerance is not above 0 and at most 0.1", where="nominal", remedy="Give radians.")
    missing = next((name for name, value in robot.parameters.items() if value is None), None)
    if missing is not None:
        raise RobotError(
            f"the parameter {missing} has no value",
            where=f"nominal arm of {robot.name}",
            remedy="Only numbers can be near to special ones; give it a value or bind it.",
        )
    true = arm_of(robot)
    table = table_of(true, Tolerance(twists=twists, normals=normals, rest=ROUNDING.within))
    draft = {"name": robot.name, "title": robot.title, "source": robot.source, **table.draft}
    neighbour = from_draft(draft, where=f"nominal arm of {robot.name}", snapping=EXACT)
    neighbour = replace(neighbour, task=robot.task, locks=robot.locks)
    position, rotation = difference(true, arm_of(neighbour))
    deviation = Deviation(changes=table.changes, position=position, rotation=rotation)
    notes = (*neighbour.notes, *change_notes(deviation))
    return Nearly(true=robot, nominal=replace(neighbour, notes=notes, deviation=deviation), deviation=deviation)
