"""Forward kinematics straight from the table, joint by joint, with 50 digits.

Nothing of the derivation takes part: no chain, no polynomial, no tree. So a slip in the conversion of a convention
or in the closed form shows as a difference. Lecture: Paul's link transform Rz(theta) Tz(d) Tx(a) Rx(alpha) and
Craig's Rx(alpha) Tx(a) Rz(theta) Tz(d) (sections 3.2.2, 3.2.3), successive screw displacements (section 3.3).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kinsym.check.evaluate import exact
from kinsym.check.task import POSITION
from kinsym.robot.model import Convention, Home, Joint, Matrix, Robot

if TYPE_CHECKING:
    from sympy import Expr

Value = Any
Pose = list[list[Value]]
Cell = Callable[[Sequence[Value]], Value]


class TableKinematics:
    """The pose of a robot's last frame in its base, from the rows of its table alone."""

    def __init__(self, robot: Robot, parameters: Mapping[str, Fraction]) -> None:
        self.ctx, numbers = exact()
        self._robot = robot
        self._values = {name: numbers.number(value) for name, value in parameters.items()}
        self._names = robot.variables
        self._rows = [self._row(joint) for joint in robot.joints]
        self._before = self._matrix(robot.base)
        self._after = self._matrix(robot.tool)
        self._home = self._home_pose(robot.home)

    def forward(self, q: Sequence[Value]) -> Pose:
        """The 4x4 pose at the joint values ``q`` (radians, the table's unit of length)."""
        values = [self.ctx.mpf(value) for value in q]
        pose = self._before
        for row in self._rows:
            pose = _product(pose, row(values))
        if self._home is not None:
            pose = _product(pose, self._home)
        return _product(pose, self._after)

    def _row(self, joint: Joint) -> Callable[[Sequence[Value]], Pose]:
        ctx = self.ctx
        if self._robot.convention is Convention.SCREW:
            return self._screw(joint)
        theta, d, a, alpha = (self._cell(cell) for cell in (joint.theta, joint.d, joint.a, joint.alpha))

        def transform(q: Sequence[Value]) -> Pose:
            about_z = _rotation(ctx, "z", theta(q))
            about_z[2][3] = d(q)
            about_x = _rotation(ctx, "x", alpha(q))
            about_x[0][3] = a(q)
            craig = self._robot.convention is Convention.CRAIG
            return _product(about_x, about_z) if craig else _product(about_z, about_x)

        return transform

    def _screw(self, joint: Joint) -> Callable[[Sequence[Value]], Pose]:
        ctx = self.ctx
        zero: Sequence[Value] = []
        axis = [self._cell(cell)(zero) for cell in joint.s or ()]
        if joint.kind == "P":
            position = self._names.index(str(joint.variable))
            return lambda q: _pose(_identity(ctx), [q[position] * s for s in axis])
        point = [self._cell(cell)(zero) for cell in joint.s0 or ()]
        position = self._names.index(str(joint.variable))

        def transform(q: Sequence[Value]) -> Pose:
            c, s = ctx.cos(q[position]), ctx.sin(q[position])
            x, y, z = axis
            cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
            turn = [
                [(c if i == j else 0) + s * cross[i][j] + (1 - c) * axis[i] * axis[j] for j in range(3)]
                for i in range(3)
            ]
            moved = [point[i] - sum(turn[i][j] * point[j] for j in range(3)) for i in range(3)]
            return _pose(turn, moved)

        return transform

    def _home_pose(self, home: Home | None) -> Pose | None:
        if home is None:
            return None
        columns = [[self._cell(cell)([]) for cell in column] for column in (home.u0, home.v0, home.w0, home.q0)]
        return [*([column[i] for column in columns] for i in range(3)), _last(self.ctx)]

    def _matrix(self, matrix: Matrix | None) -> Pose:
        if matrix is None:
            return _pose(_identity(self.ctx), [self.ctx.mpf(0)] * 3)
        return [[self._cell(cell)([]) for cell in row] for row in matrix]

    def _cell(self, cell: Expr | None) -> Cell:
        if cell is None:
            zero = self.ctx.mpf(0)
            return lambda q: zero
        return lambda q: self._number(cell, q)

    def _number(self, cell: Any, q: Sequence[Value]) -> Value:
        ctx = self.ctx
        if cell.is_Symbol:
            return self._value(cell.name, q)
        if cell.is_Rational:
            return ctx.mpf(int(cell.p)) / int(cell.q)
        name = type(cell).__name__
        if name == "Pi":
            return +ctx.pi
        parts = [self._number(part, q) for part in cell.args]
        match name:
            case "Add":
                return ctx.fsum(parts)
            case "Mul":
                return ctx.fprod(parts)
            case "Pow":
                return parts[0] ** parts[1]
            case "sin" | "cos":
                return getattr(ctx, name)(parts[0])
        raise TypeError(f"a cell of a table cannot hold {cell}")

    def _value(self, name: str, q: Sequence[Value]) -> Value:
        return q[self._names.index(name)] if name in self._names else self._values[name]


def _identity(ctx: Any) -> Pose:
    return [[ctx.mpf(1 if i == j else 0) for j in range(3)] for i in range(3)]


def _last(ctx: Any) -> list[Value]:
    return [ctx.mpf(0)] * 3 + [ctx.mpf(1)]


def _pose(rotation: Pose, position: Sequence[Value]) -> Pose:
    ctx, _ = exact()
    return [*([*row, p] for row, p in zip(rotation, position, strict=True)), _last(ctx)]


def _rotation(ctx: Any, axis: str, angle: Value) -> Pose:
    c, s, one, zero = ctx.cos(angle), ctx.sin(angle), ctx.mpf(1), ctx.mpf(0)
    about_z = [[c, -s, zero], [s, c, zero], [zero, zero, one]]
    about_x = [[one, zero, zero], [zero, c, -s], [zero, s, c]]
    return _pose(about_z if axis == "z" else about_x, [zero, zero, zero])


def _product(left: Pose, right: Pose) -> Pose:
    upper = [
        [sum(left[i][k] * right[k][j] for k in range(3)) + (left[i][3] if j == POSITION else 0) for j in range(4)]
        for i in range(3)
    ]
    return [*upper, left[3]]
