"""Frames in numbers of 40 digits.

Tables that come from measurements or from URDF are compared here with the exact table that is read instead of them.
Forty digits keep the rounding of this arithmetic far below every deviation that is reported, and mpmath gives the
same digits on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mpmath.ctx_mp import MPContext

DIGITS = 40
CONTEXT = MPContext()
CONTEXT.dps = DIGITS

Number = Any
"""A number of :data:`CONTEXT`; mpmath has no types."""
Vector = tuple[Number, Number, Number]
NOTHING = CONTEXT.mpf("1e-30")
"""What 40 digits may leave of an exact zero."""
ZERO, ONE = CONTEXT.mpf(0), CONTEXT.mpf(1)


def dot(a: Vector, b: Vector) -> Number:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def add(a: Vector, b: Vector, factor: Number = ONE) -> Vector:
    """``a + factor b``."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


def norm(a: Vector) -> Number:
    """The length of a vector."""
    return CONTEXT.sqrt(dot(a, a))


def unit(a: Vector) -> Vector:
    """The vector of length one in the same direction."""
    length = norm(a)
    return a[0] / length, a[1] / length, a[2] / length


@dataclass(frozen=True)
class Frame:
    """A rigid transform: the axes ``x``, ``y``, ``z`` of a frame, unit vectors at right angles, and its origin.

    >>> turned = turn("z", CONTEXT.pi / 2).then(slide(1, 0, 0))
    >>> [int(round(float(value))) for value in turned.origin]
    [0, 1, 0]
    """

    x: Vector
    y: Vector
    z: Vector
    origin: Vector

    def turned(self, v: Vector) -> Vector:
        """A direction of this frame in the frame that this one is given in."""
        x, y, z = self.x, self.y, self.z
        return add(add((v[0] * x[0], v[0] * x[1], v[0] * x[2]), y, v[1]), z, v[2])

    def apply(self, point: Vector) -> Vector:
        """A point of this frame in the frame that this one is given in."""
        return add(self.turned(point), self.origin)

    def then(self, other: Frame) -> Frame:
        """The product ``self other``."""
        return Frame(self.turned(other.x), self.turned(other.y), self.turned(other.z), self.apply(other.origin))

    def inverse(self) -> Frame:
        """The inverse transform."""
        x, y, z = zip(self.x, self.y, self.z, strict=True)
        back = Frame(x, y, z, (ZERO, ZERO, ZERO))
        return Frame(x, y, z, add((ZERO, ZERO, ZERO), back.turned(self.origin), -ONE))


UNIT = Frame((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE), (ZERO, ZERO, ZERO))


def slide(x: Number, y: Number, z: Number) -> Frame:
    """The frame moved by (x, y, z)."""
    return Frame(UNIT.x, UNIT.y, UNIT.z, (CONTEXT.mpf(x), CONTEXT.mpf(y), CONTEXT.mpf(z)))


def turn(axis: str, angle: Number) -> Frame:
    """The frame turned about one of its own axes ``"x"``, ``"y"``, ``"z"`` by an angle in radians."""
    c, s = CONTEXT.cos(angle), CONTEXT.sin(angle)
    none = (ZERO, ZERO, ZERO)
    match axis:
        case "x":
            return Frame(UNIT.x, (ZERO, c, s), (ZERO, -s, c), none)
        case "y":
            return Frame((c, ZERO, -s), UNIT.y, (s, ZERO, c), none)
        case _:
            return Frame((c, s, ZERO), (-s, c, ZERO), UNIT.z, none)


def from_rpy(xyz: Vector, rpy: Vector) -> Frame:
    """The frame at ``xyz`` turned by Rz(yaw) Ry(pitch) Rx(roll), as ``origin`` in URDF."""
    roll, pitch, yaw = rpy
    return slide(*xyz).then(turn("z", yaw)).then(turn("y", pitch)).then(turn("x", roll))


def along(direction: Vector, point: Vector) -> Frame:
    """A frame at ``point`` whose z axis is the unit vector ``direction``.

    Its x axis is that coordinate axis which is least along the direction, made perpendicular to it.
    """
    sizes = [abs(part) for part in direction]
    helper = (UNIT.x, UNIT.y, UNIT.z)[sizes.index(min(sizes))]
    x = unit(add(helper, direction, -dot(helper, direction)))
    return Frame(x, cross(direction, x), direction, point)
