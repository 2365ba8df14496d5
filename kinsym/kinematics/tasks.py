"""Which part of a pose an arm can be asked to reach.

Six joints reach a pose. With fewer, the task that fits is the one whose equations the arm can all change
independently: the rank of its Jacobian, taken modulo the prime, equals the number of joints.
"""

from __future__ import annotations

import random

from kinsym.algebra.field import PRIME, inverse
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import pose_columns
from kinsym.kinematics.jacobian import joint_axes
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


TOLD = {
    Task.POSE: (X, Y, Z, WX, WY, WZ),
    Task.POSITION: (X, Y, Z),
    Task.ORIENTATION: (WX, WY, WZ),
    Task.PLANAR: (X, Y, Z, WX, WY, WZ),
    Task.SCARA: (X, Y, Z, WX, WY, WZ),
}
"""The rows of velocity that the columns of the pose which a task gives can tell."""


def fitting_task(whole: Chain, chain: Chain) -> Task:
    """The task of an arm whose user names none; ``chain`` lacks the locked joints of the ``whole``.

    An arm that can make any pose is asked for one, also while a lock keeps it from making all.
    """
    if chain is not whole and mobility(whole) == len(TOLD[Task.POSE]):
        return Task.POSE
    count = len(chain.joints)
    rows = _rows(chain)
    for task, moved, rest in FITTING.get(count, ()):
        if rank([rows[i] for i in moved]) == count and not any(any(rows[i]) for i in rest):
            return task
    if count == 5 and rank(_position_and_axis(chain, rows)) == count:
        return Task.POSITION_AXIS
    return Task.POSE


def mobility(chain: Chain) -> int:
    """In how many independent ways the joints move the end effector at a general pose.

    Fewer than there are joints means that the arm is singular everywhere: two joints about one line, four sliding
    joints, four parallel axes.
    """
    return rank(_rows(chain))


def told(chain: Chain, task: Task) -> list[list[int]]:
    """How the joints move what a task gives, at a random pose modulo the prime: one column for each joint.

    An arm with more joints than the rank of this matrix is redundant.
    """
    rows = _rows(chain)
    return _position_and_axis(chain, rows) if task is Task.POSITION_AXIS else [rows[i] for i in TOLD[task]]


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


def _rows(chain: Chain) -> list[list[int]]:
    """The six rows of the Jacobian at a random point; angular velocities first from the axes."""
    ring, values = chain.ring, _sample(chain)
    columns = []
    end = [ring.evaluate(entry, values) for entry in pose_columns(chain)[3]]
    for joint, axis, point in zip(chain.joints, *joint_axes(chain), strict=True):
        z = [ring.evaluate(entry, values) for entry in axis]
        if joint.kind == "P":
            columns.append([*z, 0, 0, 0])
            continue
        lever = [e - ring.evaluate(entry, values) for e, entry in zip(end, point, strict=True)]
        columns.append([*_cross(z, lever), *z])
    return [list(row) for row in zip(*columns, strict=True)]


def _position_and_axis(chain: Chain, rows: list[list[int]]) -> list[list[int]]:
    """The rows of the position and of the direction w of the end effector, whose velocity is omega x w."""
    ring, values = chain.ring, _sample(chain)
    axis = [ring.evaluate(entry, values) for entry in pose_columns(chain)[2]]
    turned = [_cross([rows[WX][j], rows[WY][j], rows[WZ][j]], axis) for j in range(len(chain.joints))]
    return [*rows[:3], *(list(row) for row in zip(*turned, strict=True))]


def _cross(left: list[int], right: list[int]) -> list[int]:
    (a, b, c), (x, y, z) = left, right
    return [(b * z - c * y) % PRIME, (c * x - a * z) % PRIME, (a * y - b * x) % PRIME]
