"""From the user's table to motions and constants.

Every table becomes ``B M1(q1) C1 M2(q2) C2 ... Mn(qn) Cn`` where Mi turns about or slides along the local z axis and
Ci is constant (lecture, sections 3.2.2 Craig, 3.2.3 Paul, 3.3 successive screws). A locked joint is a constant as well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sympy import Expr, Integer, Symbol

from kinsym.algebra.ring import Poly, Ring, Rotation, Vector, apply, identity, matmul, minus, plus, transpose
from kinsym.errors import RobotError
from kinsym.kinematics.angles import shorthand
from kinsym.kinematics.constants import Constants
from kinsym.robot.model import Convention, Joint, Robot

ZERO = Integer(0)


@dataclass(frozen=True)
class Rigid:
    """A constant rigid transform."""

    rotation: Rotation
    translation: Vector

    @staticmethod
    def unit(ring: Ring) -> Rigid:
        """No motion."""
        return Rigid(identity(ring), (ring.zero, ring.zero, ring.zero))

    def then(self, ring: Ring, other: Rigid) -> Rigid:
        """The product ``self * other``."""
        moved = plus(apply(ring, self.rotation, other.translation), self.translation)
        return Rigid(matmul(ring, self.rotation, other.rotation), moved)

    def apply(self, ring: Ring, point: Vector) -> Vector:
        """Where a point goes."""
        return plus(apply(ring, self.rotation, point), self.translation)

    def entries(self, place: str) -> list[tuple[str, Poly]]:
        """The twelve entries with names: base_ux is row x of column u."""
        columns = (*transpose(self.rotation), self.translation)
        return [
            (f"{place}_{column}{row}", entry)
            for column, vector in zip("uvwp", columns, strict=True)
            for row, entry in zip("xyz", vector, strict=True)
        ]

    def named(self, ring: Ring, place: str) -> Rigid:
        """The same transform with the names of its entries where the ring has them."""
        u, v, w, p = (
            tuple(ring[name] if name in ring else entry for name, entry in self.entries(place)[i : i + 3])  # noqa: SIM401
            for i in (0, 3, 6, 9)
        )
        return Rigid(transpose((u, v, w)), p)

    def inverse(self, ring: Ring) -> Rigid:
        """The inverse transform."""
        turned = transpose(self.rotation)
        return Rigid(turned, minus(apply(ring, turned, self.translation)))


@dataclass(frozen=True)
class Motion:
    """One joint: its variable enters with ``sign``; ``after`` is the constant transform that follows it."""

    variable: str
    kind: str
    sign: int
    after: Rigid


def note_cells(constants: Constants, robot: Robot) -> None:
    """Register every constant of the table."""
    for row, joint in enumerate(robot.joints, start=1):
        if robot.convention is Convention.SCREW:
            for cell in (*(joint.s or ()), *(joint.s0 or ())):
                constants.note_length(cell)
            continue
        index = row - 1 if robot.convention is Convention.CRAIG else row
        constants.note_angle(joint.alpha or ZERO, f"alpha{index}")
        constants.note_length(joint.a or ZERO)
        constants.note_angle(offset(joint.theta or ZERO, joint)[1], f"offset{row}")
        constants.note_length(offset(joint.d or ZERO, joint)[1])
    if robot.home is not None:
        for vector in (robot.home.u0, robot.home.v0, robot.home.w0, robot.home.q0):
            for cell in vector:
                constants.note_length(cell)
    for matrix in (robot.base, robot.tool):
        for line in (matrix or ())[:3]:
            for cell in line:
                constants.note_length(cell)


def note_locks(constants: Constants, robot: Robot) -> None:
    """Register where the locked joints are held; the cosine and sine of theta3 are c3 and s3."""
    digits = shorthand(robot.variables)
    for joint in robot.moving:
        if joint.variable in robot.locks:
            cell = held_at(robot, joint.variable)
            if joint.kind == "R":
                constants.note_held(cell, digits[joint.variable])
            else:
                constants.note_length(cell)


def held_at(robot: Robot, variable: str) -> Expr:
    """The value of a locked joint: its cell, or the joint variable itself where it is an input."""
    value = robot.locks[variable]
    return Symbol(variable, real=True) if value is None else value


def with_locks(
    ring: Ring, constants: Constants, robot: Robot, base: Rigid, joints: tuple[Motion, ...]
) -> tuple[Rigid, tuple[Motion, ...]]:
    """The base and the joints that are left when the motions of the locked ones are constants."""
    left: list[Motion] = []
    for joint in joints:
        if joint.variable not in robot.locks:
            left.append(joint)
            continue
        constant = _held(ring, constants, held_at(robot, joint.variable), joint).then(ring, joint.after)
        if left:
            left[-1] = replace(left[-1], after=left[-1].after.then(ring, constant))
        else:
            base = base.then(ring, constant)
    return base, tuple(left)


def _held(ring: Ring, constants: Constants, value: Expr, joint: Motion) -> Rigid:
    if joint.kind == "R":
        c, s = constants.held(ring, value)
        return Rigid(turn_z(ring, c, s * joint.sign), (ring.zero,) * 3)
    return Rigid(identity(ring), (ring.zero, ring.zero, constants.length(ring, value) * joint.sign))


def offset(cell: Expr, joint: Joint) -> tuple[int, Expr]:
    """The factor of the joint variable in a cell (0, 1 or -1) and what is added to it."""
    if joint.variable is None:
        return 0, cell
    factor = cell.expand().coeff(Symbol(joint.variable, real=True), 1)
    return int(factor), (cell - factor * Symbol(joint.variable, real=True)).expand()


def motions(ring: Ring, constants: Constants, robot: Robot) -> tuple[Rigid, tuple[Motion, ...]]:
    """The base transform and the joints with the constants between them."""
    base = _matrix(ring, constants, robot.base)
    tool = _matrix(ring, constants, robot.tool)
    read = _screw_rows if robot.convention is Convention.SCREW else _dh_rows
    head, body = read(ring, constants, robot)
    last = body[-1]
    body[-1] = Motion(last.variable, last.kind, last.sign, last.after.then(ring, tool))
    return base.then(ring, head), tuple(body)


def turn_z(ring: Ring, c: Poly, s: Poly) -> Rotation:
    """R_Z from a cosine and a sine."""
    one, zero = ring.one, ring.zero
    return (c, -s, zero), (s, c, zero), (zero, zero, one)


def turn_x(ring: Ring, c: Poly, s: Poly) -> Rotation:
    """R_X from a cosine and a sine."""
    one, zero = ring.one, ring.zero
    return (one, zero, zero), (zero, c, -s), (zero, s, c)


def _dh_rows(ring: Ring, constants: Constants, robot: Robot) -> tuple[Rigid, list[Motion]]:
    head = Rigid.unit(ring)
    body: list[Motion] = []
    craig = robot.convention is Convention.CRAIG

    def extend(constant: Rigid) -> None:
        nonlocal head
        if body:
            last = body[-1]
            body[-1] = Motion(last.variable, last.kind, last.sign, last.after.then(ring, constant))
        else:
            head = head.then(ring, constant)

    zero = ring.zero
    for joint in robot.joints:
        c, s = constants.angle(ring, joint.alpha or ZERO)
        along_x = Rigid(turn_x(ring, c, s), (constants.length(ring, joint.a or ZERO), zero, zero))
        turn_sign, turn_rest = offset(joint.theta or ZERO, joint)
        slide_sign, slide_rest = offset(joint.d or ZERO, joint)
        c, s = constants.angle(ring, turn_rest)
        along_z = Rigid(turn_z(ring, c, s), (zero, zero, constants.length(ring, slide_rest)))
        if craig:
            extend(along_x)
        if joint.variable is None:
            extend(along_z)
        else:
            sign = turn_sign if joint.kind == "R" else slide_sign
            body.append(Motion(joint.variable, joint.kind, sign, along_z))
        if not craig:
            extend(along_x)
    return head, body


def _screw_rows(ring: Ring, constants: Constants, robot: Robot) -> tuple[Rigid, list[Motion]]:
    def vector(cells: tuple[Expr, Expr, Expr]) -> Vector:
        return tuple(constants.length(ring, cell) for cell in cells)

    frames: list[Rigid] = []
    origin: Vector = (ring.zero, ring.zero, ring.zero)
    before: Vector | None = None
    for row, joint in enumerate(robot.joints, start=1):
        if joint.s is None or joint.s0 is None:
            raise RobotError(
                "a row of a table of screws has no axis", where=f"{robot.name}, joints row {row}", remedy="Add s and s0"
            )
        axis = vector(joint.s)
        origin = _foot(ring, origin, axis, vector(joint.s0))
        if joint.kind == "R":
            origin = _normal_foot(ring, frames[-1].translation, before, axis, origin) if before else origin
            before = axis
        else:
            before = None
        frames.append(Rigid(axis_frame(ring, axis, row), origin))
    if robot.home is None:
        raise RobotError("a table of screws needs a home pose", where=robot.name, remedy="Add [home] u0, v0, w0, q0")
    home = robot.home
    frames.append(Rigid(transpose((vector(home.u0), vector(home.v0), vector(home.w0))), vector(home.q0)))
    body = [
        Motion(joint.variable or "", joint.kind, 1, here.inverse(ring).then(ring, following))
        for joint, here, following in zip(robot.joints, frames, frames[1:], strict=False)
    ]
    return frames[0], body


def _foot(ring: Ring, point: Vector, axis: Vector, through: Vector) -> Vector:
    """The point of an axis nearest to a point: where its frame is put, wherever on the axis the table's s0 lies."""
    along = ring.dot(plus(point, minus(through)), axis)
    x, y, z = (ring.reduce(p + along * s) for p, s in zip(through, axis, strict=True))
    return x, y, z


def _normal_foot(ring: Ring, point: Vector, before: Vector, axis: Vector, through: Vector) -> Vector:
    """Where the common normal with the axis before ends on an axis: the point that both share if they meet.

    Three axes that meet then have frames in one point, as in a Denavit-Hartenberg table. Axes that are parallel, or
    whose angle is no number, keep ``through``.
    """
    normal = _cross(ring, before, axis)
    squared = ring.dot(normal, normal)
    if not squared or not squared.is_ground:
        return through
    away = plus(through, minus(point))
    along = ring.dot(_cross(ring, before, normal), away).quo_ground(squared.coeff(1))
    x, y, z = (ring.reduce(p + along * s) for p, s in zip(through, axis, strict=True))
    return x, y, z


def _cross(ring: Ring, left: Vector, right: Vector) -> Vector:
    (a, b, c), (x, y, z) = left, right
    return ring.reduce(b * z - c * y), ring.reduce(c * x - a * z), ring.reduce(a * y - b * x)


def axis_frame(ring: Ring, axis: Vector, row: int) -> Rotation:
    """A rotation whose third column is a unit axis; parallel axes get the same frame.

    Where a component of the axis is zero its first column lies across the axis in a coordinate plane; otherwise the
    frame is the smallest turn from z, which is rational in the axis (Rodrigues).
    """
    x, y, z = axis
    one, zero = ring.one, ring.zero
    if not x:
        first: Vector = (one, zero, zero)
    elif not z:
        first = (-y, x, zero)
    elif not y:
        first = (z, zero, -x)
    elif all(ring.is_constant(part) and part.is_ground for part in axis):
        scale = ring.one.quo_ground((one + z).coeff(1))
        return (one - x * x * scale, -x * y * scale, x), (-x * y * scale, one - y * y * scale, y), (-x, -y, z)
    else:
        raise RobotError(
            "the direction s of this axis has three components that are not rational numbers",
            where=f"{row}",
            remedy="Turn the base frame so that one component of every axis is zero or a plain number",
        )
    second = (
        ring.reduce(y * first[2] - z * first[1]),
        ring.reduce(z * first[0] - x * first[2]),
        ring.reduce(x * first[1] - y * first[0]),
    )
    return transpose((first, second, axis))


def _matrix(ring: Ring, constants: Constants, matrix: tuple[tuple[Expr, ...], ...] | None) -> Rigid:
    if matrix is None:
        return Rigid.unit(ring)
    rows = [[constants.length(ring, cell) for cell in line] for line in matrix[:3]]
    return Rigid(
        tuple(tuple(line[:3]) for line in rows),  # type: ignore[arg-type]
        (rows[0][3], rows[1][3], rows[2][3]),
    )
