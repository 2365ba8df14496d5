"""A robot as joint screws: displacements of any run of joints, and the wrist point (lecture, slides 33 to 45).

The displacement ``A_i+1 ... A_k`` of joints moves points of the home pose, all seen from the base:
``H_i G H_k^-1`` with G the motion of these joints in the chain and H the frames of the chain at the home pose.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from kinsym.algebra.ring import Poly, Vector, apply, minus, plus, transpose
from kinsym.errors import DoesNotApply
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.links import Rigid
from kinsym.kinematics.moves import Moves
from kinsym.methods.tables import unlocked
from kinsym.robot.model import Convention, Home, Robot
from kinsym.robot.model import Vector as Cells


@dataclass(frozen=True)
class ScrewArm:
    """A chain of screws without base and tool, both being part of its axes and its home pose."""

    chain: Chain

    @cached_property
    def home(self) -> Home:
        """The home pose of the end effector."""
        home = self.chain.robot.home
        if home is None:
            raise DoesNotApply(f"{self.chain.robot.name} has no home pose, so successive screws do not apply.")
        return home

    def vector(self, cells: Cells) -> Vector:
        """Cells of the table as polynomials."""
        x, y, z = (self.chain.constants.length(self.chain.ring, cell) for cell in cells)
        return x, y, z

    def frame(self, count: int) -> Rigid:
        """The chain's frame behind the first ``count`` joints at the home pose."""
        total = self.chain.base
        for joint in self.chain.joints[:count]:
            total = total.then(self.chain.ring, joint.after)
        return total

    def moves(self, first: int, stop: int) -> list[Moves]:
        """The motions of joints first+1 to stop, group by group; ``first`` is where a group begins."""
        ring = self.chain.ring
        groups = [group for group in self.chain.groups_before(stop) if group.joints[0] >= first]
        return [Moves(ring, group.whole(ring), self.chain.turn) for group in groups]

    def moved_point(self, first: int, stop: int, point: Vector) -> Vector:
        """Where joints first+1 to stop move a point of the home pose."""
        ring = self.chain.ring
        inner = self.frame(stop).inverse(ring).apply(ring, point)
        for move in reversed(self.moves(first, stop)):
            inner = move.point(inner)
        return self.frame(first).apply(ring, inner)

    def moved_direction(self, first: int, stop: int, direction: Vector) -> Vector:
        """The same for a direction."""
        ring = self.chain.ring
        inner = apply(ring, transpose(self.frame(stop).rotation), direction)
        for move in reversed(self.moves(first, stop)):
            inner = move.direction(inner)
        return apply(ring, self.frame(first).rotation, inner)

    def taken_back(self, stop: int, vector: Vector, *, point: bool) -> Vector:
        """``(A_1 ... A_stop)^-1`` of a point or a direction."""
        ring = self.chain.ring
        inner = apply(ring, transpose(self.chain.base.rotation), vector)
        if point:
            inner = self.chain.base.inverse(ring).apply(ring, vector)
        for move in self.moves(0, stop):
            inner = move.point_back(inner) if point else move.direction_back(inner)
        frame = self.frame(stop)
        return frame.apply(ring, inner) if point else apply(ring, frame.rotation, inner)

    def axis(self, number: int) -> tuple[Vector, Vector]:
        """Direction and point of an axis at the home pose, joints counted from 1."""
        row = self.chain.robot.joints[number - 1]
        if row.s is None or row.s0 is None:
            raise DoesNotApply(f"row {number} of {self.chain.robot.name} is no screw.")
        return self.vector(row.s), self.vector(row.s0)

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """How many joints lie before each group, and before the end."""
        return (*(group.joints[0] for group in self.chain.groups), len(self.chain.joints))


def screw_robot(robot: Robot) -> Robot:
    """The robot as a table of screws, base and tool made part of it.

    Raises :class:`kinsym.errors.RobotError` where an axis cannot be written exactly.
    """
    robot = unlocked(robot)
    if robot.convention is Convention.SCREW and robot.base is None and robot.tool is None:
        return robot
    return convert(robot, Convention.SCREW)


@dataclass(frozen=True)
class Wrist:
    """The point of the last axis that as many of the last joints as possible do not move.

    ``fixed`` counts these joints, ``point`` is where it lies at home, ``away`` where the end effector is seen from
    it, in the directions u, v, w; ``arm`` has this point for its end effector.
    """

    fixed: int
    point: Vector
    away: Vector
    arm: ScrewArm


def wrist_of(robot: Robot, columns: str) -> Wrist:
    """The wrist point of a table of screws; ``columns`` are those of the pose that are given.

    It is the end effector itself where the last joint slides, or where the orientation is not given.
    """
    arm = ScrewArm(build_chain(robot))
    ring, chain = arm.chain.ring, arm.chain
    home = arm.home
    count = len(chain.joints)
    end = arm.vector(home.q0)
    if chain.joints[-1].kind == "P" or "uvw" not in columns:
        return Wrist(0, end, (ring.zero,) * 3, arm)
    point = arm.frame(count - 1).translation
    fixed = 0
    while fixed < count and chain.joints[count - 1 - fixed].kind == "R" and _on_axis(arm, count - fixed, point):
        fixed += 1
    axes = tuple(arm.vector(cells) for cells in (home.u0, home.v0, home.w0))
    apart = plus(end, minus(point))
    away = tuple(ring.dot(axis, apart) for axis in axes)
    cells = tuple(chain.constants.expression(ring, entry) for entry in point)
    moved = replace(robot, home=replace(home, q0=cells))
    return Wrist(fixed, point, away, ScrewArm(build_chain(moved)))


def _on_axis(arm: ScrewArm, number: int, point: Vector) -> bool:
    ring = arm.chain.ring
    (a, b, c), through = arm.axis(number)
    x, y, z = plus(point, minus(through))
    cross: list[Poly] = [b * z - c * y, c * x - a * z, a * y - b * x]
    return not any(ring.reduce(entry) for entry in cross)
