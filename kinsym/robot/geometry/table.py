"""From the axes of an arm at home to a table in Paul's convention.

Between two axes lies ``Rz(phi) Dz(d) Dx(a) Rx(alpha)``: turn to the common normal, go to its foot, along it, and tilt
(lecture, section 3.2.3). Two axes that are parallel within the tolerance have no foot; the table takes d = 0 there,
so that the offsets along parallel axes gather in the last of them and nothing runs off to infinity, as it does in
the tables of calibrated arms.

Every frame of the walk lies on the *given* axis, whatever was read for the link before it; therefore small changes of
the links do not add up to a wrong one. The table is what a person would write: named lengths, angles as multiples of
15 degrees where they are such, decimals elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from sympy import Expr, Integer, Rational, pi

from kinsym.robot.geometry.arm import Arm, Axis, mpf
from kinsym.robot.geometry.frames import (
    CONTEXT,
    NOTHING,
    UNIT,
    ZERO,
    Frame,
    Number,
    Vector,
    add,
    cross,
    dot,
    norm,
    unit,
)
from kinsym.robot.model import Change
from kinsym.robot.snapping import PARTS_OF_PI
from kinsym.robot.text import cell_text, value_text

FINEST = CONTEXT.mpf("1e-17")
"""Cells are decimals to this share of the arm's size, below the rounding of a double."""
ACROSS = CONTEXT.mpf("0.1")
"""A common normal this near to a right angle with x counts as across it."""
FEWEST_PLACES, MOST_PLACES = 3, 36


@dataclass(frozen=True, kw_only=True)
class Tolerance:
    """What counts as special: ``twists`` and ``normals`` between joint axes, ``rest`` everywhere else.

    Twists are in radians, the lengths of common normals are shares of the arm's size, ``rest`` is the one or the other.
    """

    twists: Fraction
    normals: Fraction
    rest: Fraction

    @classmethod
    def of(cls, value: Fraction) -> Tolerance:
        """One value for all."""
        return cls(twists=value, normals=value, rest=value)


@dataclass(frozen=True, kw_only=True)
class Table:
    """A draft of a robot file (:func:`kinsym.robot.files.from_draft`) without its name, and what was changed."""

    draft: dict[str, Any]
    changes: tuple[Change, ...]


def table_of(arm: Arm, tolerance: Tolerance) -> Table:
    """The table of an arm, its joint variables named as the axes are.

    >>> from kinsym.robot import load
    >>> from kinsym.robot.geometry.arm import arm_of
    >>> [row["alpha"] for row in table_of(arm_of(load("ur5")), Tolerance.of(Fraction(0))).draft["joints"]]
    ['pi/2', '0', '0', 'pi/2', '-pi/2', '0']
    """
    return _Writer(arm, tolerance).table()


@dataclass(frozen=True)
class _Link:
    """Rz(phi) Dz(d) Dx(a) Rx(alpha) as measured, and the frame on the next axis that it leads to."""

    phi: Number
    d: Number
    a: Number
    alpha: Number
    parallel: bool
    foot: Frame


class _Writer:
    def __init__(self, arm: Arm, tolerance: Tolerance) -> None:
        self.arm, self.size = arm, arm.size
        self.twists = max(mpf(tolerance.twists), NOTHING)
        self.normals = max(mpf(tolerance.normals), NOTHING)
        self.rest = max(mpf(tolerance.rest), NOTHING)
        self.changes: list[Change] = []
        self.parameters: dict[str, str] = {}

    def table(self) -> Table:
        base, here = self.base()
        links = []
        for axis in self.arm.axes[1:]:
            links.append(link := self.link(here, axis.frame, self.twists))
            here = here.then(link.foot)
        links.append(last := self.link(here, self.arm.tip, self.rest, last=True))
        psi, epsilon = self.remainder(here.then(last.foot), self.arm.tip)
        if last.parallel and abs(last.a) <= self.rest * self.size:
            turned = -psi if CONTEXT.cos(last.alpha) < 0 else psi
            links[-1], psi = _Link(last.phi + turned, last.d, ZERO, last.alpha, True, last.foot), ZERO
        meets = [not link.parallel and abs(link.a) <= self.normals * self.size for link in links[:-1]]
        rows = []
        for i, (axis, link) in enumerate(zip(self.arm.axes, links, strict=True)):
            last_row = i == len(links) - 1
            # Only between two common normals of length zero does d = 0 make three axes meet in a point.
            point = not last_row and i > 0 and meets[i] and meets[i - 1]
            tolerances = (self.rest, self.rest) if last_row else (self.twists, self.normals)
            rows.append(self.row(i + 1, axis, link, *tolerances, point=point))
        draft: dict[str, Any] = {"convention": "paul", "joints": rows}
        tool = self.transform("tool", (ZERO, ZERO, epsilon), (ZERO, ZERO, psi))
        draft |= {key: value for key, value in (("base", base), ("tool", tool)) if value}
        if self.parameters:
            draft["parameters"] = self.parameters
        return Table(draft=draft, changes=tuple(self.changes))

    def base(self) -> tuple[dict[str, Any] | None, Frame]:
        """The base transform, which puts z along the first axis, and the frame there."""
        first = self.arm.axes[0].frame
        link = self.link(UNIT, first, self.rest)
        if link.parallel:
            # Between the base and a parallel axis nothing is gained by a turn to the common normal.
            foot = _square(first.z, (link.foot.origin[0], link.foot.origin[1], ZERO), UNIT.x)
            return self.transform("base", foot.origin, (link.alpha, ZERO, ZERO)), foot
        place = (link.a * CONTEXT.cos(link.phi), link.a * CONTEXT.sin(link.phi), link.d)
        return self.transform("base", place, (link.alpha, ZERO, link.phi)), link.foot

    def link(self, here: Frame, following: Frame, tolerance: Number, *, last: bool = False) -> _Link:
        """How to get from the z axis of one frame to that of the next."""
        there = here.inverse().then(following)
        u, p = there.z, there.origin
        normal = cross(UNIT.z, u)
        if norm(normal) <= tolerance:
            return self.parallel(u, p, last=last)
        n, phi = self.normal(unit(normal), p)
        sine, cosine = dot(cross(UNIT.z, u), n), u[2]
        along = (p[2] - cosine * dot(u, p)) / (sine * sine)
        back = (cosine * p[2] - dot(u, p)) / (sine * sine)
        alpha = CONTEXT.atan2(sine, cosine)
        return _Link(phi, along, dot(n, p), alpha, False, _square(u, add(p, u, back), n))

    def normal(self, n: Vector, p: Vector) -> tuple[Vector, Number]:
        """Of the two directions of a common normal the one a person takes: nearer to x; across x the one with a > 0."""
        a, phi = dot(n, p), CONTEXT.atan2(n[1], n[0])
        beyond = abs(phi) - CONTEXT.pi / 2
        turn_back = beyond > 0 if abs(beyond) > ACROSS else a < 0 if abs(a) > self.normals * self.size else phi < 0
        if not turn_back:
            return n, phi
        flipped = -n[0], -n[1], -n[2]
        return flipped, CONTEXT.atan2(flipped[1], flipped[0])

    def parallel(self, u: Vector, p: Vector, *, last: bool) -> _Link:
        """Between parallel axes d = 0, but for the tip, whose origin is where it is."""
        d = p[2] if last else ZERO
        x, y, _ = point = p if last else add(p, u, -p[2] / u[2])
        a = CONTEXT.sqrt(x * x + y * y)
        n, phi = UNIT.x, ZERO
        if a > self.rest * self.size:
            n, phi = self.normal((x / a, y / a, ZERO), p)
            a = dot(n, point)
        alpha = ZERO if u[2] > 0 else +CONTEXT.pi
        return _Link(phi, d, a, alpha, True, _square(u, point, n))

    def remainder(self, here: Frame, tip: Frame) -> tuple[Number, Number]:
        """What is left to the tip once its z axis is reached: a turn about z and a way along it."""
        left = here.inverse().then(tip)
        return CONTEXT.atan2(left.x[1], left.x[0]), left.origin[2]

    def row(self, i: int, axis: Axis, link: _Link, tilt: Number, small: Number, *, point: bool) -> dict[str, Any]:
        """One row of the table, its lengths named."""
        theta = self.angle(link.phi, f"row {i}, theta", self.rest)
        d = self.length(link.d, f"row {i}, d", self.normals if point else self.rest)
        named = self.named(f"l{i}" if axis.kind == "P" else f"d{i}", d)
        row = {
            "type": axis.kind,
            "variable": axis.name,
            "alpha": cell_text(self.twist(link, i, tilt)),
            "a": self.named(f"a{i}", self.length(link.a, f"row {i}, a", small)),
            "d": _sum(axis.name, named) if axis.kind == "P" else named,
            "theta": _sum(axis.name, cell_text(theta)) if axis.kind == "R" else cell_text(theta),
        }
        if axis.limits is not None:
            row["limits"] = [value_text(limit) for limit in axis.limits]  # type: ignore[assignment]
        return row

    def twist(self, link: _Link, i: int, tilt: Number) -> Expr:
        if not link.parallel:
            return self.angle(link.alpha, f"row {i}, alpha", tilt)
        measured = CONTEXT.asin(min(norm(cross(UNIT.z, self.direction(i))), CONTEXT.mpf(1)))
        exact = Integer(0) if link.alpha == 0 else pi
        self.note(f"row {i}, alpha", abs(link.alpha - measured), exact, measured)
        return exact

    def direction(self, i: int) -> Vector:
        """The z axis after joint i in a frame on its axis."""
        following = self.arm.axes[i].frame if i < len(self.arm.axes) else self.arm.tip
        return self.arm.axes[i - 1].frame.inverse().then(following).z

    def angle(self, value: Number, where: str, tolerance: Number) -> Expr:
        multiple = int(CONTEXT.nint(value * PARTS_OF_PI / CONTEXT.pi))
        error = abs(value - multiple * CONTEXT.pi / PARTS_OF_PI)
        if error > tolerance:
            return _decimal(value, FINEST)
        exact = multiple * pi / PARTS_OF_PI
        self.note(where, value, exact, error)
        return exact

    def length(self, value: Number, where: str, tolerance: Number) -> Rational:
        if abs(value) > tolerance * self.size:
            return _decimal(value, FINEST * self.size)
        self.note(where, value, Integer(0), abs(value))
        return Rational(0)

    def note(self, where: str, value: Number, exact: Expr, error: Number) -> None:
        if error > NOTHING:
            written = CONTEXT.nstr(value, 10)
            change = Change(where=where, written=written, read_as=cell_text(exact), difference=float(error))
            self.changes.append(change)

    def named(self, name: str, length: Rational) -> str:
        if length == 0:
            return "0"
        while any(name == axis.name for axis in self.arm.axes):
            name = "l" + name
        self.parameters[name] = cell_text(length)
        return name

    def transform(self, key: str, xyz: Vector, rpy: Vector) -> dict[str, Any] | None:
        place = [cell_text(self.length(value, f"{key}, xyz", self.rest)) for value in xyz]
        turned = [cell_text(self.angle(value, f"{key}, rpy", self.rest)) for value in rpy]
        entries = {"xyz": place, "rpy": turned}
        return {k: cells for k, cells in entries.items() if set(cells) != {"0"}} or None


def _square(z: Vector, origin: Vector, x: Vector) -> Frame:
    """The frame with this z axis and the x axis made perpendicular to it."""
    x = unit(add(x, z, -dot(x, z)))
    return Frame(x, cross(z, x), z, origin)


def _decimal(value: Number, tolerance: Number) -> Rational:
    """The shortest decimal that is as near."""
    for places in range(FEWEST_PLACES, MOST_PLACES):
        scaled = int(CONTEXT.nint(value * 10**places))
        if abs(value - CONTEXT.mpf(scaled) / 10**places) <= tolerance:
            break
    return Rational(scaled, 10**places)


def _sum(variable: str, rest: str) -> str:
    if rest == "0":
        return variable
    return f"{variable} - {rest[1:]}" if rest.startswith("-") else f"{variable} + {rest}"
