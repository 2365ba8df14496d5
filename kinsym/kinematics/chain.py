"""The chain: what every table becomes, with its joints gathered into groups of parallel axes."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from kinsym.algebra.field import PRIME, circle_point, turn
from kinsym.algebra.ring import (
    POSE_ENTRIES,
    Generator,
    Kind,
    Poly,
    Ring,
    Rotation,
    Vector,
    apply,
    identity,
    matmul,
    plus,
)
from kinsym.kinematics.angles import Angle, angle_generators, interval, shorthand
from kinsym.kinematics.constants import Constants
from kinsym.kinematics.links import Motion, Rigid, motions, note_cells, note_locks, with_locks
from kinsym.robot.model import Robot

if TYPE_CHECKING:
    from sympy import Expr

TurnOf = Callable[[int, int, int], tuple[Poly, Poly]]
"""(group, from node, to node) -> cosine and sine of the angle between two nodes."""


@dataclass(frozen=True)
class Group:
    """Joints with parallel revolute axes: G = Rz(node_k) K, translation sum of Rz(node_i) v_i.

    ``joints`` are positions in the chain, ``nodes`` the signed joint angles between consecutive nodes, ``arms`` the
    vectors v_i by node, ``turned`` the constant rotation K, both up to the last joint's motion. ``trail`` is the
    constant transform that follows the last joint.
    """

    index: int
    joints: tuple[int, ...]
    nodes: tuple[tuple[str, int], ...]
    arms: tuple[Vector, ...]
    turned: Rotation
    trail: Rigid

    @property
    def last(self) -> int:
        """The last node."""
        return len(self.nodes)

    def whole(self, ring: Ring) -> Group:
        """The same group with its trail made part of it."""
        carried = apply(ring, self.turned, self.trail.translation)
        arms = (*self.arms[:-1], plus(self.arms[-1], carried))
        turned = matmul(ring, self.turned, self.trail.rotation)
        return Group(self.index, self.joints, self.nodes, arms, turned, Rigid.unit(ring))


@dataclass(frozen=True)
class Chain:
    """A robot as exact algebra.

    ``T = base * G_1 * G_2 ... G_m`` where each group ends with its trail; ``angles`` holds every interval of nodes.
    ``numbers`` are the joints' places in the table, counted from 1: locked joints, which a chain to solve lacks, keep
    theirs.
    """

    robot: Robot
    ring: Ring
    constants: Constants
    base: Rigid
    joints: tuple[Motion, ...]
    groups: tuple[Group, ...]
    angles: dict[tuple[int, int, int], Angle]
    numbers: tuple[int, ...]

    def turn(self, group: int, start: int, end: int) -> tuple[Poly, Poly]:
        """Cosine and sine of the angle from one node to another, as generators."""
        if start == end:
            return self.ring.one, self.ring.zero
        low, high = min(start, end), max(start, end)
        angle = self.angles[group, low, high]
        sine = self.ring[angle.sine]
        return self.ring[angle.cosine], sine if (start < end) == (angle.sign > 0) else -sine

    def groups_before(self, position: int) -> tuple[Group, ...]:
        """The groups up to a joint, the last of them cut off before it."""
        result: list[Group] = []
        for group in self.groups:
            inside = tuple(p for p in group.joints if p < position)
            if inside == group.joints:
                result.append(group)
            elif inside:
                count = sum(1 for p in inside if self.joints[p].kind == "R")
                result.append(_group(self.ring, group.index, self.joints, inside, group.nodes[:count]))
        return tuple(result)

    def sample(self, generator: random.Random, given: Mapping[str, int] = MappingProxyType({})) -> dict[str, int]:
        """Random values modulo the prime for everything but the pose, constants as :meth:`Constants.sample` says."""
        values = self.constants.sample(generator, given)
        for joint in self.joints:
            if joint.kind == "P":
                values[joint.variable] = generator.randrange(1, PRIME)
        for group in self.groups:
            points = [circle_point(generator) for _ in group.nodes]
            for low in range(len(group.nodes)):
                total = (1, 0)
                for high in range(low + 1, len(group.nodes) + 1):
                    total = turn(total, points[high - 1], group.nodes[high - 1][1])
                    angle = self.angles[group.index, low, high]
                    values[angle.cosine], values[angle.sine] = total[0], total[1] * angle.sign % PRIME
        return values


def build_chain(robot: Robot) -> Chain:
    """The chain of a robot with all its joints, locked or not."""
    return _chain(robot, {})


def chain_to_solve(robot: Robot, spin: str | None = None) -> Chain:
    """The chain of the joints that the inverse kinematics solves for; a locked joint is part of a constant.

    With ``spin``, one more joint of that name turns about the z axis of the end frame.
    """
    return _chain(robot, robot.locks, spin)


def _chain(robot: Robot, locks: Mapping[str, Expr | None], spin: str | None = None) -> Chain:
    robot = replace(robot, locks=dict(locks))
    slides = {joint.variable for joint in robot.moving if joint.kind == "P"}
    lengths = [name for name, value in locks.items() if value is None and name in slides]
    constants = Constants([*robot.parameters, *lengths])
    note_cells(constants, robot)
    note_locks(constants, robot)
    plain = Ring(constants.generators())
    head, body = with_locks(plain, constants, robot, *motions(plain, constants, robot))
    # With a locked joint among them the entries would stand for something else than in the forward kinematics.
    framed = (robot.base and robot.unlocked[0] == 1, robot.tool and robot.unlocked[-1] == len(robot.variables))
    ends = {"base": head if framed[0] else None, "end": body[-1].after if framed[1] else None}
    extra = () if spin is None else (spin,)
    for place, transform in ends.items():
        for name, entry in transform.entries(place) if transform else ():
            constants.note_entry(plain, entry, name)
    body += tuple(Motion(name, "R", 1, Rigid.unit(plain)) for name in extra)
    runs = _runs(plain, body)
    digits = shorthand((*robot.variables, *extra))

    angles: dict[tuple[int, int, int], Angle] = {}
    for index, (_, nodes) in enumerate(runs):
        for low in range(len(nodes)):
            for high in range(low + 1, len(nodes) + 1):
                angles[index, low, high] = interval(index, low, tuple(nodes[low:high]), digits)
    generators = angle_generators(list(angles.values()))
    generators += [Generator(joint.variable, Kind.LENGTH) for joint in body if joint.kind == "P"]
    generators += [Generator(name, Kind.POSE) for name in POSE_ENTRIES]
    ring = Ring(generators + constants.generators())

    base, joints = with_locks(ring, constants, robot, *motions(ring, constants, robot))
    base = base.named(ring, "base")
    joints = (*joints[:-1], replace(joints[-1], after=joints[-1].after.named(ring, "end")))
    joints += tuple(Motion(name, "R", 1, Rigid.unit(ring)) for name in extra)
    numbers = (*robot.unlocked, *(len(robot.variables) + 1 for _ in extra))
    groups = tuple(
        _group(ring, index, joints, positions, tuple(nodes)) for index, (positions, nodes) in enumerate(runs)
    )
    return Chain(robot, ring, constants, base, joints, groups, angles, numbers)


Run = tuple[tuple[int, ...], list[tuple[str, int]]]


def _runs(ring: Ring, body: tuple[Motion, ...]) -> list[Run]:
    """Which joints form a group, with the sign of each revolute joint about the group's axis."""
    axis = identity(ring)
    unit: Vector = (ring.zero, ring.zero, ring.one)
    runs: list[Run] = []
    positions: list[int] = []
    nodes: list[tuple[str, int]] = []
    for position, joint in enumerate(body):
        direction = apply(ring, axis, unit)
        along = _sign_along_z(ring, direction)
        leaves = along == 0 if joint.kind == "R" else along == 0 and _shares_next_axis(ring, body, position)
        if positions and leaves:
            runs.append((tuple(positions), nodes))
            positions, nodes, axis, along = [], [], identity(ring), 1
        positions.append(position)
        if joint.kind == "R":
            nodes.append((joint.variable, joint.sign * along))
        axis = matmul(ring, axis, joint.after.rotation)
    runs.append((tuple(positions), nodes))
    return runs


def _shares_next_axis(ring: Ring, body: tuple[Motion, ...], position: int) -> bool:
    """Whether a prismatic joint slides along the axis of the next revolute joint."""
    axis = identity(ring)
    for here, following in zip(body[position:], body[position + 1 :], strict=False):
        axis = matmul(ring, axis, here.after.rotation)
        if following.kind == "R":
            return _sign_along_z(ring, apply(ring, axis, (ring.zero, ring.zero, ring.one))) != 0
    return False


def _sign_along_z(ring: Ring, direction: Vector) -> int:
    x, y, z = direction
    if x or y:
        return 0
    return 1 if z == ring.one else -1


def _group(
    ring: Ring, index: int, joints: tuple[Motion, ...], positions: tuple[int, ...], nodes: tuple[tuple[str, int], ...]
) -> Group:
    zero = ring.zero
    arms: list[Vector] = [(zero, zero, zero)]
    turned = identity(ring)
    for place, position in enumerate(positions):
        joint = joints[position]
        if joint.kind == "R":
            arms.append((zero, zero, zero))
        else:
            slide = apply(ring, turned, (zero, zero, ring[joint.variable] * joint.sign))
            arms[-1] = plus(arms[-1], slide)
        if place < len(positions) - 1:
            arms[-1] = plus(arms[-1], apply(ring, turned, joint.after.translation))
            turned = matmul(ring, turned, joint.after.rotation)
    return Group(index, positions, nodes, tuple(arms), turned, joints[positions[-1]].after)
