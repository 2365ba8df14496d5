"""Which part of a pose an arm can be asked to reach.

Six joints reach a pose. With fewer, the task that fits is the one whose equations the arm can all change
independently: the rank of its Jacobian, taken modulo the prime, equals the number of joints.
"""

from __future__ import annotations

import random

from kinsym.algebra.field import PRIME, inverse
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import forward_kinematics
from kinsym.kinematics.jacobian import Jacobian, geometric_jacobian
from kinsym.robot.model import Task

X, Y, Z, WX, WY, WZ = range(6)

FITTING: dict[int, tuple[tuple[Task, tuple[int, ...], tuple[int, ...]], ...]] = {
    2: ((Task.POSITION, (X, Y, Z), ()), (Task.ORIENTATION, (WX, WY, WZ), ())),
    3: (
        (Task.POSITION, (X, Y, Z), ()),
        (Task.PLANAR, (X, Y, WZ), (Z, WX, WY)),
        (Task.ORIENTATION, (WX, WY, WZ), ()),
    ),
    4: ((Task.SCARA, (X, Y, Z, WZ), (WX, WY)),),
}
"""By number of joints: the task, the rows it moves and the rows that must stay at rest, in order of preference."""


def fitting_task(chain: Chain, jacobian: Jacobian) -> Task:
    """The task of an arm whose user names none."""
    count = len(chain.joints)
    rows = _rows(chain, jacobian)
    for task, moved, rest in FITTING.get(count, ()):
        if rank([rows[i] for i in moved]) == count and not any(any(rows[i]) for i in rest):
            return task
    if count == 5 and rank(_position_and_axis(chain, jacobian, rows)) == count:
        return Task.POSITION_AXIS
    return Task.POSE


def mobility(chain: Chain) -> int:
    """In how many independent ways the joints move the end effector at a general pose.

    Fewer than there are joints means that the arm is singular everywhere: two joints about one line, four sliding
    joints, four parallel axes.
    """
    return rank(_rows(chain, geometric_jacobian(chain, forward_kinematics(chain))))


def task_rank(chain: Chain, jacobian: Jacobian, task: Task) -> int:
    """In how many independent ways the joints change what the task fixes, at a general pose."""
    rows = _rows(chain, jacobian)
    if task is Task.POSITION:
        return rank(rows[:3])
    if task is Task.ORIENTATION:
        return rank(rows[3:])
    return rank(_position_and_axis(chain, jacobian, rows) if task is Task.POSITION_AXIS else rows)


def rank(rows: list[list[int]]) -> int:
    """The rank of a matrix modulo the prime.

    >>> rank([[1, 2], [2, 4]])
    1
    """
    matrix = [list(row) for row in rows]
    found = 0
    for column in range(len(matrix[0]) if matrix else 0):
        pivot = next((i for i in range(found, len(matrix)) if matrix[i][column]), None)
        if pivot is None:
            continue
        matrix[found], matrix[pivot] = matrix[pivot], matrix[found]
        scale = inverse(matrix[found][column])
        for i in range(found + 1, len(matrix)):
            factor = matrix[i][column] * scale % PRIME
            matrix[i] = [(a - factor * b) % PRIME for a, b in zip(matrix[i], matrix[found], strict=True)]
        found += 1
    return found


def _sample(chain: Chain) -> dict[str, int]:
    return chain.sample(random.Random("task"))


def _rows(chain: Chain, jacobian: Jacobian) -> list[list[int]]:
    """The six rows of the Jacobian at a random point; angular velocities first from the axes."""
    ring, values = chain.ring, _sample(chain)
    columns = []
    end = [ring.evaluate(entry, values) for entry in jacobian.end]
    for joint, axis, point in zip(chain.joints, jacobian.axes, jacobian.points, strict=True):
        z = [ring.evaluate(entry, values) for entry in axis]
        if joint.kind == "P":
            columns.append([*z, 0, 0, 0])
            continue
        lever = [e - ring.evaluate(entry, values) for e, entry in zip(end, point, strict=True)]
        columns.append([*_cross(z, lever), *z])
    return [list(row) for row in zip(*columns, strict=True)]


def _position_and_axis(chain: Chain, jacobian: Jacobian, rows: list[list[int]]) -> list[list[int]]:
    """The rows of the position and of the direction w of the end effector, whose velocity is omega x w."""
    ring, values = chain.ring, _sample(chain)
    axis = [ring.evaluate(entry, values) for entry in jacobian.approach]
    turned = [_cross([rows[WX][j], rows[WY][j], rows[WZ][j]], axis) for j in range(len(chain.joints))]
    return [*rows[:3], *(list(row) for row in zip(*turned, strict=True))]


def _cross(left: list[int], right: list[int]) -> list[int]:
    (a, b, c), (x, y, z) = left, right
    return [(b * z - c * y) % PRIME, (c * x - a * z) % PRIME, (a * y - b * x) % PRIME]
