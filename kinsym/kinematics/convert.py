"""Tables of one convention from tables of another, by way of the chain.

A constant between two joint axes is ``Rz(phi) Dz(delta) Dx(a) Rx(alpha) Rz(psi) Dz(epsilon)``: the first four are a row
of Paul's table, and the last two commute with the next joint and join its row. Craig's rows hold the same numbers one
place later; screws are the axes at the home pose. Everything stays exact, so an axis pair whose common normal is not
along an axis of the frame before it (its angle would need an arc tangent) is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sympy import Expr, Integer, Rational, pi

from kinsym.algebra.ring import Poly, Ring, Vector, apply, transpose
from kinsym.errors import RobotError
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.links import Rigid, turn_x, turn_z
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Convention, Home, Joint, Matrix, Robot

ZERO = Integer(0)


def convert(robot: Robot, convention: Convention) -> Robot:
    """The same arm as a table of another convention: same joint variables, same T.

    Raises :class:`RobotError` where the new table cannot be written exactly.

    >>> from kinsym.robot import load
    >>> [str(joint.a) for joint in convert(load("planar_rrr_screw"), Convention.CRAIG).joints]
    ['0', 'a1', 'a2', 'a3']
    """
    chain = build_chain(robot)
    writer = _Writer(chain)
    if convention is Convention.SCREW:
        joints, home = writer.screws()
        return replace(robot, convention=convention, joints=joints, home=home, base=None, tool=None)
    rows, tool = writer.rows()
    joints = _paul(rows) if convention is Convention.PAUL else _craig(rows)
    return replace(
        robot, convention=convention, joints=joints, home=None, base=writer.matrix(chain.base), tool=writer.matrix(tool)
    )


@dataclass(frozen=True, kw_only=True)
class Row:
    """One row of Paul's table; the joint variable is part of ``d`` or ``theta``."""

    kind: str
    variable: str
    d: Expr
    theta: Expr
    a: Expr
    alpha: Expr


def _paul(rows: list[Row]) -> tuple[Joint, ...]:
    return tuple(
        Joint(kind=row.kind, variable=row.variable, alpha=row.alpha, a=row.a, d=row.d, theta=row.theta) for row in rows
    )


def _craig(rows: list[Row]) -> tuple[Joint, ...]:
    joints = []
    alpha, a = ZERO, ZERO
    for row in rows:
        joints.append(Joint(kind=row.kind, variable=row.variable, alpha=alpha, a=a, d=row.d, theta=row.theta))
        alpha, a = row.alpha, row.a
    if alpha != 0 or a != 0:
        joints.append(Joint(kind="fixed", variable=None, alpha=alpha, a=a, d=ZERO, theta=ZERO))
    return tuple(joints)


class _Writer:
    def __init__(self, chain: Chain) -> None:
        self.chain, self.ring = chain, chain.ring

    def rows(self) -> tuple[list[Row], Rigid]:
        """Paul's rows, and what is left after the last."""
        ring = self.ring
        rows: list[Row] = []
        left = Rigid.unit(ring)
        for joint in self.chain.joints:
            constant = left.then(ring, joint.after)
            link = self._link(constant, joint.variable)
            left = link.transform(ring).inverse(ring).then(ring, constant)
            value = symbol(joint.variable) * joint.sign
            theta, d = self._angle(*link.phi, joint.variable), self.expression(link.delta)
            rows.append(
                Row(
                    kind=joint.kind,
                    variable=joint.variable,
                    d=d + value if joint.kind == "P" else d,
                    theta=theta + value if joint.kind == "R" else theta,
                    a=self.expression(link.a),
                    alpha=self._angle(*link.alpha, joint.variable),
                )
            )
        return rows, left

    def screws(self) -> tuple[tuple[Joint, ...], Home]:
        """The joint axes and the end effector at the home pose, all joint variables zero."""
        ring = self.ring
        zero, one = ring.zero, ring.one
        here = self.chain.base
        joints = []
        for joint in self.chain.joints:
            direction = apply(ring, here.rotation, (zero, zero, one * joint.sign))
            along = ring.dot(direction, here.translation)
            point = tuple(ring.reduce(p - along * s) for p, s in zip(here.translation, direction, strict=True))
            joints.append(
                Joint(kind=joint.kind, variable=joint.variable, s=self._vector(direction), s0=self._vector(point))
            )
            here = here.then(ring, joint.after)
        u0, v0, w0 = transpose(here.rotation)
        home = Home(u0=self._vector(u0), v0=self._vector(v0), w0=self._vector(w0), q0=self._vector(here.translation))
        return tuple(joints), home

    def matrix(self, transform: Rigid) -> Matrix | None:
        """A rigid transform as cells, None for no motion."""
        if transform == Rigid.unit(self.ring):
            return None
        rows = [
            (*(self.expression(entry) for entry in line), self.expression(moved))
            for line, moved in zip(transform.rotation, transform.translation, strict=True)
        ]
        return (*rows, (ZERO, ZERO, ZERO, Integer(1)))

    def expression(self, poly: Poly) -> Expr:
        """A polynomial in constants as a cell."""
        return self.chain.constants.expression(self.ring, poly)

    def _vector(self, vector: Vector) -> tuple[Expr, Expr, Expr]:
        x, y, z = vector
        return self.expression(x), self.expression(y), self.expression(z)

    def _link(self, constant: Rigid, variable: str) -> _Link:
        """The row that leads from one axis to the next."""
        ring = self.ring
        one, zero = ring.one, ring.zero
        x, y, z = (row[2] for row in constant.rotation)
        moved = constant.translation
        if not x and not y:
            alpha = (z, zero)
            phi = self._direction(moved, variable)
        elif not x:
            alpha, phi = (z, -y), (one, zero)
        elif not y:
            alpha, phi = (z, x), (zero, one)
        else:
            raise self._refusal(variable, "the common normal of this axis and the next")
        along, across, up = apply(ring, transpose(turn_z(ring, *phi)), moved)
        epsilon = self._quotient(-across, alpha[1], variable) if alpha[1] else zero
        return _Link(phi, alpha, ring.reduce(up - alpha[0] * epsilon), along)

    def _direction(self, moved: Vector, variable: str) -> Pair:
        """The turn about z that points x towards the next of two parallel axes."""
        one, zero = self.ring.one, self.ring.zero
        if not moved[1]:
            return one, zero
        if not moved[0]:
            return zero, one
        raise self._refusal(variable, "the offset of this axis and the next, which is parallel,")

    def _quotient(self, numerator: Poly, denominator: Poly, variable: str) -> Poly:
        quotient, rest = numerator.div(denominator)
        if rest:
            raise self._refusal(variable, "the foot of the common normal of this axis and the next")
        return quotient

    def _angle(self, c: Poly, s: Poly, variable: str) -> Expr:
        """The angle of a cosine and a sine: a constant of the table turned by quarters."""
        ring = self.ring
        known = [(ZERO, ring.one, ring.zero)]
        for angle, name in self.chain.constants.angles.items():
            known += [(angle, ring["c" + name], ring["s" + name]), (-angle, ring["c" + name], -ring["s" + name])]
        for quarters in (0, 1, 2, 3):
            for angle, cosine, sine in known:
                if (c, s) == (cosine, sine):
                    return angle + pi * Rational(quarters if quarters < 3 else -1, 2)
            c, s = s, -c
        raise self._refusal(variable, "an angle between this axis and the next")

    def _refusal(self, variable: str, what: str) -> RobotError:
        return RobotError(
            f"{what} has no exact form as a cell of a Denavit-Hartenberg table",
            where=f"{self.chain.robot.name}, joint {variable}",
            remedy="Turn the base frame or keep the table as it is",
        )


Pair = tuple[Poly, Poly]


@dataclass(frozen=True)
class _Link:
    phi: Pair
    alpha: Pair
    delta: Poly
    a: Poly

    def transform(self, ring: Ring) -> Rigid:
        """Rz(phi) Dz(delta) Dx(a) Rx(alpha)."""
        zero = ring.zero
        along_z = Rigid(turn_z(ring, *self.phi), (zero, zero, self.delta))
        return along_z.then(ring, Rigid(turn_x(ring, *self.alpha), (self.a, zero, zero)))
