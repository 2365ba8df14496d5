"""The geometric Jacobian in the base frame: columns [z_i x (o_E - o_i); z_i] for R, [z_i; 0] for P.

z_i is the direction of joint axis i and o_i a point of it, both in closed form from the chain.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Vector
from kinsym.algebra.tree import ONE, ZERO, Definition, Num, Sym, Tree, mul, negated, sub
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import Forward, pose_direction, pose_point


@dataclass(frozen=True, kw_only=True)
class Jacobian:
    """``axes`` and ``points`` hold z_i and o_i as polynomials, ``end`` and ``approach`` the end effector's p and w;
    ``definitions`` and ``entries`` are what is printed.

    ``entries`` has six rows: linear velocity, then angular velocity.
    """

    axes: tuple[Vector, ...]
    points: tuple[Vector, ...]
    end: Vector
    approach: Vector
    definitions: tuple[Definition, ...]
    entries: tuple[tuple[Tree, ...], ...]


Column = tuple[Tree, Tree, Tree]


def geometric_jacobian(chain: Chain, forward: Forward) -> Jacobian:
    """The Jacobian of a chain."""
    ring = chain.ring
    definitions: list[Definition] = []
    names: dict[Poly, Tree] = {}

    def named(vector: Vector, letter: str) -> Column:
        """The entries by name; what is equal has one name."""
        for row, entry in zip("xyz", vector, strict=True):
            if entry not in names:
                tree = nested(ring, entry)
                if not _plain(tree):
                    definitions.append(Definition(name=f"{letter}_{row}", value=tree))
                    tree = Sym(f"{letter}_{row}")
                names[entry] = tree
        x, y, z = (names[entry] for entry in vector)
        return x, y, z

    end = named(forward.columns[3], "oE")
    axes, points = joint_axes(chain)
    columns: list[tuple[Tree, ...]] = []
    for number, (joint, axis, point) in enumerate(zip(chain.joints, axes, points, strict=True), start=1):
        z = named(axis, f"z{number}")
        if joint.kind == "R":
            lever = named(point, f"o{number}")
            columns.append((*cross(z, (sub(end[0], lever[0]), sub(end[1], lever[1]), sub(end[2], lever[2]))), *z))
        else:
            columns.append((*z, ZERO, ZERO, ZERO))
    rows = tuple(zip(*columns, strict=True))
    return Jacobian(
        axes=axes,
        points=points,
        end=forward.columns[3],
        approach=forward.columns[2],
        definitions=tuple(definitions),
        entries=rows,
    )


def joint_axes(chain: Chain) -> tuple[tuple[Vector, ...], tuple[Vector, ...]]:
    """The directions z_i of the joint axes and a point o_i of each, in the base frame."""
    ring = chain.ring
    zero = ring.zero
    axes, points = [], []
    for position, joint in enumerate(chain.joints):
        before = chain.groups_before(position)
        axes.append(pose_direction(chain, before, (zero, zero, ring.one * joint.sign)))
        points.append(pose_point(chain, before, (zero, zero, zero)))
    return tuple(axes), tuple(points)


def _plain(tree: Tree) -> bool:
    return isinstance(tree, (Num, Sym)) or negated(tree) == ONE or isinstance(negated(tree), Sym)


def cross(left: Column, right: Column) -> Column:
    (a, b, c), (x, y, z) = left, right
    return (
        _difference(b, z, c, y),
        _difference(c, x, a, z),
        _difference(a, y, b, x),
    )


def _difference(a: Tree, b: Tree, c: Tree, d: Tree) -> Tree:
    """``a*b - c*d``."""
    return sub(mul(a, b), mul(c, d))
