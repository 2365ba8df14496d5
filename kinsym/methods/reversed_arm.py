"""An arm seen from its end: its joints in reverse order, and the inverse of its pose.

Each row of Craig's table, ``Rx(alpha) Dx(a) Rz(theta) Dz(d)``, has the inverse ``Dz(-d) Rz(-theta) Dx(-a) Rx(-alpha)``;
read from the last row to the first, their parts make the rows of a table again.
"""

from __future__ import annotations

from dataclasses import replace

from sympy import Expr, Integer

from kinsym.methods.tables import craig_table
from kinsym.robot.model import Joint, Matrix, Robot

_ZERO = Integer(0)


def reversed_arm(robot: Robot) -> Robot:
    """The arm whose base is the end of another, as a table in Craig's convention with the same joint variables.

    Raises :class:`kinsym.errors.RobotError` where the table cannot be written exactly.

    >>> from kinsym.robot import load
    >>> [str(joint.theta) for joint in reversed_arm(load("planar_rr")).joints if joint.variable]
    ['-theta2', '-theta1']
    """
    table = craig_table(robot)
    rows: list[Joint] = []
    alpha: Expr = _ZERO
    a: Expr = _ZERO
    for joint in reversed(table.joints):
        back = replace(joint, alpha=alpha, a=a, d=-(joint.d or _ZERO), theta=-(joint.theta or _ZERO), limits=None)
        if joint.variable is not None or any(cell != 0 for cell in (alpha, a, back.d, back.theta)):
            rows.append(back)
        alpha, a = -(joint.alpha or _ZERO), -(joint.a or _ZERO)
    if alpha != 0 or a != 0:
        rows.append(Joint(kind="fixed", variable=None, alpha=alpha, a=a, d=_ZERO, theta=_ZERO))
    return replace(table, joints=tuple(rows), base=_inverse(table.tool), tool=_inverse(table.base))


def _inverse(matrix: Matrix | None) -> Matrix | None:
    """The inverse of a rigid transform: its rotation transposed, its origin seen from there."""
    if matrix is None:
        return None
    columns = [[matrix[row][column] for row in range(3)] for column in range(4)]
    rows = []
    for column in columns[:3]:
        moved = -sum((x * y for x, y in zip(column, columns[3], strict=True)), _ZERO)
        rows.append((*column, moved))
    return (*rows, (_ZERO, _ZERO, _ZERO, Integer(1)))
