"""An arm as its axes at home, in numbers: what every table, and every URDF chain, comes to.

``T(q) = E1(q1) E2(q2) ... En(qn) tip`` where Ei turns about, or slides along, axis i at its place in the home pose
(the product of exponentials; lecture, section 3.3: successive screw displacements). Two arms are compared by T.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import sympy
from sympy import Expr

from kinsym.robot.expressions import symbol
from kinsym.robot.geometry.frames import (
    CONTEXT,
    DIGITS,
    NOTHING,
    ONE,
    UNIT,
    ZERO,
    Frame,
    Number,
    Vector,
    add,
    along,
    dot,
    norm,
    slide,
    turn,
    unit,
)
from kinsym.robot.model import Convention, Joint, Robot

SAMPLES = 60
REACH = Fraction(1)
"""A slide without limits is sampled up to this share of the arm's size."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """One joint: ``frame`` has its z axis along the joint's axis at home; ``kind`` is "R" or "P"."""

    name: str
    kind: str
    frame: Frame
    limits: tuple[Fraction, Fraction] | None = None


@dataclass(frozen=True, kw_only=True)
class Arm:
    """The joints from base to tip, and the tip's frame at home, all in the frame of the base.

    ``frames`` are at home those that a Denavit-Hartenberg table has: the base's and one after each row. An arm that
    has no such table has the base's alone, or none.
    """

    axes: tuple[Axis, ...]
    tip: Frame
    frames: tuple[Frame, ...] = ()

    @property
    def size(self) -> Number:
        """The length of a way from the base along the axes to the tip, 1 if it is zero.

        The way goes from each axis to the nearest point of the next: the origin of a frame may lie anywhere on its
        axis, and in tables of calibrated arms it lies hundreds of metres away.
        """
        here, total = UNIT.origin, ZERO
        for axis in self.axes:
            offset = add(axis.frame.origin, here, -ONE)
            offset = add(offset, axis.frame.z, -dot(offset, axis.frame.z))
            here, total = add(here, offset), total + norm(offset)
        return total + norm(add(self.tip.origin, here, -ONE)) or ONE

    def pose(self, q: Sequence[Number]) -> Frame:
        """The tip at the joint values ``q`` (radians, the unit of length of the table)."""
        here = UNIT
        for axis, value in zip(self.axes, q, strict=True):
            move = turn("z", value) if axis.kind == "R" else slide(0, 0, value)
            here = here.then(axis.frame).then(move).then(axis.frame.inverse())
        return here.then(self.tip)


def difference(first: Arm, second: Arm) -> tuple[float, float]:
    """The largest distance of the two tips and the largest angle between them, over 60 joint vectors.

    The joint vectors are the home pose and random ones inside the limits of the first arm; both arms have the same
    joints in the same order.
    """
    generator = random.Random(0)
    size = first.size
    worst = ZERO, ZERO
    for number in range(SAMPLES):
        q = [_drawn(axis, size, generator) if number else ZERO for axis in first.axes]
        a, b = first.pose(q), second.pose(q)
        worst = max(worst[0], norm(add(a.origin, b.origin, -ONE))), max(worst[1], _angle(a, b))
    position, rotation = (float(value) if value > NOTHING else 0.0 for value in worst)
    return position, rotation


def _drawn(axis: Axis, size: Number, generator: random.Random) -> Number:
    half = CONTEXT.pi if axis.kind == "R" else size * REACH.numerator / REACH.denominator
    low, high = (-half, half) if axis.limits is None else (mpf(limit) for limit in axis.limits)
    return low + (high - low) * generator.random()


def _angle(a: Frame, b: Frame) -> Number:
    """The angle between two frames; exact for small ones, where an arc cosine would lose half of the digits."""
    chord = CONTEXT.sqrt(sum((norm(add(p, q, -ONE)) ** 2 for p, q in ((a.x, b.x), (a.y, b.y), (a.z, b.z))), ZERO) / 8)
    return 2 * CONTEXT.asin(min(chord, ONE))


def mpf(value: Fraction) -> Number:
    """An exact number with 40 digits."""
    return CONTEXT.mpf(value.numerator) / value.denominator


def arm_of(robot: Robot) -> Arm:
    """The axes of a table at home. Parameters without a value count as 1."""
    return _Reader(robot).arm()


class _Reader:
    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.values: Mapping[Expr, Expr] = {
            **{symbol(name): sympy.Integer(0) for name in robot.variables},
            **{
                symbol(name): sympy.Integer(1) if value is None else sympy.Rational(value.numerator, value.denominator)
                for name, value in robot.parameters.items()
            },
        }

    def arm(self) -> Arm:
        base, tool = self.matrix(self.robot.base), self.matrix(self.robot.tool)
        if self.robot.convention is Convention.SCREW:
            axes, tip = self.screws(base)
            return Arm(axes=axes, tip=tip.then(tool), frames=(base,))
        axes, frames = self.links(base)
        return Arm(axes=axes, tip=frames[-1].then(tool), frames=frames)

    def links(self, here: Frame) -> tuple[tuple[Axis, ...], tuple[Frame, ...]]:
        axes, frames = [], [here]
        for joint in self.robot.joints:
            link = turn("x", self.number(joint.alpha)).then(slide(self.number(joint.a), 0, 0))
            if self.robot.convention is Convention.CRAIG:
                here = here.then(link)
            if joint.variable is not None:
                axes.append(_axis(joint, here.then(_reversal(joint))))
            here = here.then(turn("z", self.number(joint.theta))).then(slide(0, 0, self.number(joint.d)))
            if self.robot.convention is Convention.PAUL:
                here = here.then(link)
            frames.append(here)
        return tuple(axes), tuple(frames)

    def screws(self, base: Frame) -> tuple[tuple[Axis, ...], Frame]:
        axes = [
            _axis(joint, base.then(along(unit(self.vector(joint.s)), self.vector(joint.s0))))
            for joint in self.robot.joints
        ]
        home = self.robot.home
        if home is None:
            return tuple(axes), base
        return tuple(axes), base.then(Frame(*(self.vector(v) for v in (home.u0, home.v0, home.w0, home.q0))))

    def vector(self, cells: tuple[Expr, Expr, Expr] | None) -> Vector:
        x, y, z = (self.number(cell) for cell in cells or (None, None, None))
        return x, y, z

    def matrix(self, matrix: tuple[tuple[Expr, ...], ...] | None) -> Frame:
        if matrix is None:
            return UNIT
        columns = zip(*matrix[:3], strict=True)
        return Frame(*((self.number(x), self.number(y), self.number(z)) for x, y, z in columns))

    def number(self, cell: Expr | None) -> Number:
        if cell is None:
            return ZERO
        value = sympy.N(cell.xreplace(self.values), DIGITS)
        return CONTEXT.mpf(str(value))


def _axis(joint: Joint, frame: Frame) -> Axis:
    return Axis(name=str(joint.variable), kind=joint.kind, frame=frame, limits=joint.limits)


def _reversal(joint: Joint) -> Frame:
    """Half a turn about x where the joint variable enters with a minus sign."""
    cell = joint.theta if joint.kind == "R" else joint.d
    factor = sympy.diff(cell, symbol(str(joint.variable))) if cell is not None else 1
    return turn("x", CONTEXT.pi) if factor == -1 else UNIT
