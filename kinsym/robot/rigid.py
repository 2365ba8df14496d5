"""Exact rigid transforms: the home frame of a screw table, the base and the tool.

A direction or a rotation must be one exactly: 0.7071 is not the sine of 45 degrees, and a table that is off by
1e-5 would make every equation derived from it wrong by as much.
"""

from __future__ import annotations

import sympy
from sympy import Expr, Integer

from kinsym.errors import RobotError
from kinsym.robot.expressions import LONGEST_TEXT, is_zero, names, writable
from kinsym.robot.model import Matrix, Vector

_EXACT_HINT = 'Write exact numbers, for example "sqrt(2)/2", "cos(deg(20))" or "3/5".'


def check_direction(direction: Vector, *, where: str) -> None:
    """Raise RobotError unless a screw axis is a constant vector of length one, exactly."""
    _check_constant(direction, "the direction of a screw axis", where)
    square = sum((part**2 for part in direction), Integer(0))
    if is_zero(square):
        raise RobotError("the screw axis has no direction", where=where, remedy='Write a unit vector: ["0", "0", "1"].')
    if not is_zero(square - 1):
        length = float(sympy.N(sympy.sqrt(square), 15))
        raise RobotError(
            f"the screw axis is not a unit vector: its length is {length:.9g}",
            where=where,
            remedy=f"Divide it by its length. {_EXACT_HINT}",
        )


def check_rotation(columns: tuple[Vector, Vector, Vector], *, what: str, where: str) -> None:
    """Raise RobotError unless three columns are a constant right-handed orthonormal frame, exactly."""
    for column in columns:
        _check_constant(column, what, where)
    u, v, w = columns
    determinant = dot(cross(u, v), w)
    if is_zero(determinant):
        raise RobotError(
            f"{what} is singular: its axes lie in one plane", where=where, remedy="Give three independent axes."
        )
    products = (dot(u, u) - 1, dot(v, v) - 1, dot(w, w) - 1, dot(u, v), dot(v, w), dot(w, u))
    if not all(is_zero(product) for product in products):
        raise RobotError(f"{what} is not orthonormal", where=where, remedy=_EXACT_HINT)
    if float(sympy.N(determinant, 15)) < 0:
        raise RobotError(f"{what} is left-handed", where=where, remedy="Reverse one axis, or exchange two.")


def from_rpy(roll: Expr, pitch: Expr, yaw: Expr, *, where: str) -> tuple[Vector, Vector, Vector]:
    """The columns of Rz(yaw) Ry(pitch) Rx(roll): turns about the fixed axes x, y, z in this order, as in URDF."""
    _check_constant((roll, pitch, yaw), "rpy", where)
    cr, sr, cp, sp, cy, sy = values = [f(angle) for angle in (roll, pitch, yaw) for f in (sympy.cos, sympy.sin)]
    # SymPy turns cos(deg(1.5)) into a page of roots; the product of three of them would be a book.
    if sum(len(str(value)) for value in values) <= 2 * LONGEST_TEXT:
        u = _expanded((cy * cp, sy * cp, -sp))
        v = _expanded((cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr))
        w = _expanded((cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr))
        if all(writable(cell) for cell in (*u, *v, *w)):
            return u, v, w
    raise RobotError(
        "the sines and cosines of these angles have too many roots",
        where=where,
        remedy="Write the angles as decimals in radians, or in steps of 15 degrees.",
    )


def transform(columns: tuple[Vector, Vector, Vector], origin: Vector) -> Matrix:
    """The 4x4 matrix with these columns, as rows."""
    rows = tuple((*(column[i] for column in columns), origin[i]) for i in range(3))
    return (*rows, (Integer(0), Integer(0), Integer(0), Integer(1)))


def dot(a: Vector, b: Vector) -> Expr:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _expanded(vector: Vector) -> Vector:
    x, y, z = (sympy.expand(part) for part in vector)
    return x, y, z


def _check_constant(cells: tuple[Expr, ...], what: str, where: str) -> None:
    for cell in cells:
        if cell.free_symbols:
            raise RobotError(
                f"{what} depends on {names(cell)[0]}",
                where=where,
                remedy="Directions and rotations are numbers here; a Denavit-Hartenberg table may hold named twists.",
            )
