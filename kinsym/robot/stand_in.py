"""The nominal arm that stands in for one that is off by real millimetres: its closed form gives Newton's starts.

Angles of the stand-in count from the x axes of its table. A calibrated arm adds some 1e-3 rad or more to each, which
would stand in every equation as a sum of angles; here it is taken off the joint value once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction

from sympy import Expr, Integer, pi

from kinsym.errors import RobotError
from kinsym.robot.binding import bind
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Deviation, Joint, Robot
from kinsym.robot.nearby import nominal

ROOM = 4
"""How far beside a border of the nominal arm one of the true arm is looked for, in deviations."""


@dataclass(frozen=True, kw_only=True)
class StandIn:
    """``true`` is the robot with its numbers folded in, ``nominal`` the arm with the closed form.

    ``offsets`` holds what the nominal arm's joint values are ahead of the true arm's, by joint variable; joints of
    which they are the same are left out. ``deviation`` says where and by how much the two arms differ.
    """

    true: Robot
    nominal: Robot
    offsets: dict[str, Expr]
    deviation: Deviation

    @property
    def band(self) -> Fraction:
        """How far beside a border or a singular pose of the nominal arm a root is in doubt, as a share of the unit of
        its equation.

        The equations of the arms differ by about the deviation, in radians and sizes of the arm. A power of two, so
        that the last digits of a deviation that was sampled do not matter.
        """
        lengths = (abs(value) for value in self.nominal.parameters.values() if value is not None)
        moved = self.deviation.position / (float(sum(lengths)) or 1.0) + self.deviation.rotation
        return Fraction(2) ** math.ceil(math.log2(ROOM * moved))


def stand_in(robot: Robot) -> StandIn:
    """The nominal arm of a robot that asks for one.

    Raises RobotError for a parameter without a value, and where no number of the table is close to a special one
    without being it.

    >>> from kinsym.robot import from_inline
    >>> rows = "1.5712 0.0001 0.3 theta1; 0.0004 0.5 0 theta2+0.0021; 0 0.4 0 theta3"
    >>> found = stand_in(from_inline(rows, convention="paul"))
    >>> found.offsets, [str(joint.theta) for joint in found.nominal.joints]
    ({'theta2': 21/10000}, ['theta1', 'theta2', 'theta3'])
    """
    near = nominal(robot)
    if not near.deviation.changes:
        raise RobotError(
            "no twist and no common normal of its axes is off a special value by so little that it was meant to be it",
            where=f"nominal arm of {robot.name}",
            remedy="The arm is special as it stands, or like no special one. Leave --nominal (nominal = true) out.",
        )
    values = {name: value for name, value in robot.parameters.items() if value is not None}
    joints, offsets = [], {}
    for joint in near.nominal.joints:
        ahead = _ahead(joint)
        if joint.variable is None or joint.variable in robot.locks or (2 * ahead / pi).is_Integer:
            joints.append(joint)
        else:
            offsets[joint.variable] = ahead
            joints.append(replace(joint, theta=symbol(joint.variable)))
    return StandIn(
        true=bind(robot, values),
        nominal=replace(near.nominal, joints=tuple(joints)),
        offsets=offsets,
        deviation=near.deviation,
    )


def _ahead(joint: Joint) -> Expr:
    """What is added to the variable of a joint that turns; 0 for other rows."""
    if joint.kind != "R" or joint.variable is None or joint.theta is None:
        return Integer(0)
    return joint.theta - symbol(joint.variable)
