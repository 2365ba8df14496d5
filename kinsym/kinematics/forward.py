"""Forward kinematics in closed form: T = A1 A2 ... An, printed nested by joint (lecture, section 3.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from sympy import Integer

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Rotation, Vector, fraction
from kinsym.algebra.tree import ONE, ZERO, Tree
from kinsym.kinematics.chain import Chain, Group, build_chain
from kinsym.kinematics.links import Rigid, axis_frame, offset, turn_x, turn_z
from kinsym.kinematics.moves import Moves
from kinsym.robot.model import Convention, Joint

Matrix = tuple[tuple[Tree, ...], ...]


@dataclass(frozen=True, kw_only=True)
class Link:
    """A link transform A_i, or the screw displacement A_i of a joint, as a 4x4 matrix."""

    name: str
    matrix: Matrix


@dataclass(frozen=True, kw_only=True)
class Forward:
    """T of the end effector in the base frame as polynomials (columns u, v, w, p), and the table's product as printed.

    ``pose`` is T itself where the robot has neither base nor tool, and T = base * pose * tool where it has.
    """

    links: tuple[Link, ...]
    columns: tuple[Vector, Vector, Vector, Vector]
    pose: Matrix


def forward_kinematics(chain: Chain) -> Forward:
    """Multiply the chain out, group by group from the tip to the base."""
    ring = chain.ring
    columns = pose_columns(chain)
    shown = _of_table(chain) if chain.robot.base or chain.robot.tool else columns
    rows = tuple(tuple(nested(ring, column[i]) for column in shown) for i in range(3))
    return Forward(
        links=tuple(_links(chain)),
        columns=columns,
        pose=(*rows, (ZERO, ZERO, ZERO, ONE)),
    )


def pose_columns(chain: Chain) -> tuple[Vector, Vector, Vector, Vector]:
    """The columns u, v, w, p of the pose."""
    zero, one = chain.ring.zero, chain.ring.one
    u = pose_direction(chain, chain.groups, (one, zero, zero))
    v = pose_direction(chain, chain.groups, (zero, one, zero))
    w = pose_direction(chain, chain.groups, (zero, zero, one))
    return u, v, w, pose_point(chain, chain.groups, (zero, zero, zero))


def _of_table(chain: Chain) -> tuple[Vector, Vector, Vector, Vector]:
    """The product of the table's links, without base and tool."""
    bare = build_chain(replace(chain.robot, base=None, tool=None))
    found = pose_columns(bare)
    ring = chain.ring
    names = [generator.name for generator in bare.ring.generators]

    def moved(poly: Poly) -> Poly:
        total = ring.zero
        for monomial, coefficient in poly.terms():
            term = ring.number(fraction(coefficient))
            for name, exponent in zip(names, monomial, strict=True):
                if exponent:
                    term *= ring[name] ** exponent
            total += term
        return total

    u, v, w, p = ((moved(x), moved(y), moved(z)) for x, y, z in found)
    return u, v, w, p


def pose_direction(chain: Chain, groups: tuple[Group, ...], vector: Vector) -> Vector:
    """A direction after the groups, seen from the base."""
    ring = chain.ring
    for group in reversed(groups):
        vector = Moves(ring, group.whole(ring), chain.turn).direction(vector)
    return Rigid(chain.base.rotation, (ring.zero,) * 3).apply(ring, vector)


def pose_point(chain: Chain, groups: tuple[Group, ...], vector: Vector) -> Vector:
    """A point after the groups, seen from the base."""
    ring = chain.ring
    for group in reversed(groups):
        vector = Moves(ring, group.whole(ring), chain.turn).point(vector)
    return chain.base.apply(ring, vector)


def own_angle(chain: Chain, variable: str) -> tuple[Poly, Poly]:
    """Cosine and sine of one joint's variable."""
    for angle in chain.angles.values():
        if angle.terms == ((variable, 1),):
            return chain.ring[angle.cosine], chain.ring[angle.sine]
    raise KeyError(variable)


def _links(chain: Chain) -> list[Link]:
    ring, robot = chain.ring, chain.robot
    links = []
    for row, joint in enumerate(robot.joints, start=1):
        transform = link_transform(chain, joint, row)
        rows = tuple(
            (*(nested(ring, entry) for entry in line), nested(ring, moved))
            for line, moved in zip(transform.rotation, transform.translation, strict=True)
        )
        links.append(Link(name=f"A{row}", matrix=(*rows, (ZERO, ZERO, ZERO, ONE))))
    return links


def link_transform(chain: Chain, joint: Joint, row: int) -> Rigid:
    """The link transform of a row of the table, or the screw displacement of its joint."""
    return _screw(chain, joint, row) if chain.robot.convention is Convention.SCREW else _denavit(chain, joint)


def _denavit(chain: Chain, joint: Joint) -> Rigid:
    ring, constants = chain.ring, chain.constants
    zero = ring.zero
    none = Integer(0)
    c, s = constants.angle(ring, joint.alpha or none)
    along_x = Rigid(turn_x(ring, c, s), (constants.length(ring, joint.a or none), zero, zero))
    turn_sign, turn_rest = offset(joint.theta or none, joint)
    slide_sign, slide_rest = offset(joint.d or none, joint)
    rotation = turn_z(ring, *constants.angle(ring, turn_rest))
    slide = constants.length(ring, slide_rest)
    if joint.variable is not None and joint.kind == "R":
        c, s = own_angle(chain, joint.variable)
        moved = Rigid(turn_z(ring, c, s * turn_sign), (zero, zero, zero))
        along_z = moved.then(ring, Rigid(rotation, (zero, zero, slide)))
    else:
        if joint.variable is not None:
            slide += ring[joint.variable] * slide_sign
        along_z = Rigid(rotation, (zero, zero, slide))
    if chain.robot.convention is Convention.CRAIG:
        return along_x.then(ring, along_z)
    return along_z.then(ring, along_x)


def _screw(chain: Chain, joint: Joint, row: int) -> Rigid:
    """The screw displacement about an axis through s0 (lecture, section 3.3)."""
    ring, constants = chain.ring, chain.constants
    zero = ring.zero
    direction: Vector = tuple(constants.length(ring, cell) for cell in joint.s or ())
    point: Vector = tuple(constants.length(ring, cell) for cell in joint.s0 or ())
    frame = Rigid(axis_frame(ring, direction, row), point)
    if joint.kind == "R":
        moved = Rigid(turn_z(ring, *own_angle(chain, joint.variable or "")), (zero, zero, zero))
    else:
        unit: Rotation = Rigid.unit(ring).rotation
        moved = Rigid(unit, (zero, zero, ring[joint.variable or ""]))
    return frame.then(ring, moved).then(ring, frame.inverse(ring))
