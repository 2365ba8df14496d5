"""An arm in one posture, in exact numbers modulo the prime: its axes, their points, its end, its Jacobian.

What holds at random postures of a set holds on the whole set (:mod:`kinsym.algebra.field`), so geometry is recognised
by looking at a few of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import Numbers, cross, difference
from kinsym.algebra.ring import Poly
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.links import Motion, Rigid
from kinsym.robot.model import Task

Matrix = tuple[Numbers, Numbers, Numbers]


@dataclass(frozen=True)
class Posture:
    """Directions ``axes`` and ``points`` of the joints in the base frame, the end effector's point and axes.

    ``values`` are the generators at this posture, ``numbers`` the places of the joints in the table, from 1.
    """

    values: Mapping[str, int]
    kinds: tuple[str, ...]
    axes: tuple[Numbers, ...]
    points: tuple[Numbers, ...]
    end: Numbers
    turned: Matrix
    numbers: tuple[int, ...]

    @property
    def approach(self) -> Numbers:
        """The direction w of the end effector."""
        return self.turned[0][2], self.turned[1][2], self.turned[2][2]

    def jacobian(self, task: Task) -> list[list[int]]:
        """The rows of the Jacobian that a task asks for, as many as it has equations or more."""
        columns: list[tuple[int, ...]] = []
        for kind, axis, point in zip(self.kinds, self.axes, self.points, strict=True):
            if kind == "R":
                columns.append((*cross(axis, difference(self.end, point)), *axis))
            else:
                columns.append((*axis, 0, 0, 0))
        if task is Task.POSITION_AXIS:
            columns = [(*column[:3], *cross(column[3:], self.approach)) for column in columns]
        rows = [list(row) for row in zip(*columns, strict=True)]
        if task is Task.POSITION:
            return rows[:3]
        return rows[3:] if task is Task.ORIENTATION else rows


def posture(chain: Chain, values: Mapping[str, int]) -> Posture:
    """The posture of a chain at values of its generators that belong to one another, see :meth:`Chain.sample`."""
    turned, point = _numbers(chain, chain.base, values)
    axes, points = [], []
    for joint in chain.joints:
        axes.append(_apply(turned, (0, 0, joint.sign)))
        points.append(point)
        moved, slide = _motion(chain, joint, values)
        point = _plus(point, _apply(turned, slide))
        turned = _product(turned, moved)
        after, step = _numbers(chain, joint.after, values)
        point = _plus(point, _apply(turned, step))
        turned = _product(turned, after)
    kinds = tuple(joint.kind for joint in chain.joints)
    return Posture(values, kinds, tuple(axes), tuple(points), point, turned, chain.numbers)


def _motion(chain: Chain, joint: Motion, values: Mapping[str, int]) -> tuple[Matrix, Numbers]:
    if joint.kind == "P":
        return ((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, joint.sign * values[joint.variable] % PRIME)
    own = next(angle for angle in chain.angles.values() if angle.terms == ((joint.variable, 1),))
    c, s = values[own.cosine], joint.sign * values[own.sine] % PRIME
    return ((c, -s, 0), (s, c, 0), (0, 0, 1)), (0, 0, 0)


def _numbers(chain: Chain, rigid: Rigid, values: Mapping[str, int]) -> tuple[Matrix, Numbers]:
    def number(entry: Poly) -> int:
        return chain.ring.evaluate(entry, values)

    u, v, w = ((number(x), number(y), number(z)) for x, y, z in rigid.rotation)
    x, y, z = map(number, rigid.translation)
    return (u, v, w), (x, y, z)


def _apply(matrix: Matrix, vector: Numbers) -> Numbers:
    x, y, z = (sum(a * b for a, b in zip(row, vector, strict=True)) % PRIME for row in matrix)
    return x, y, z


def _plus(left: Numbers, right: Numbers) -> Numbers:
    x, y, z = ((a + b) % PRIME for a, b in zip(left, right, strict=True))
    return x, y, z


def _product(left: Matrix, right: Matrix) -> Matrix:
    columns = [_apply(left, (right[0][k], right[1][k], right[2][k])) for k in range(3)]
    u, v, w = ((columns[0][k], columns[1][k], columns[2][k]) for k in range(3))
    return u, v, w
