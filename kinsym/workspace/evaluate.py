"""Workspaces of any robot with numbers, by its own inverse kinematics at given points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from kinsym.errors import RobotError
from kinsym.inverse.state import COLUMNS
from kinsym.live import LiveArm, live
from kinsym.robot.model import Robot, Task
from kinsym.workspace.orientations import orientations

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from kinsym.live import Bools, Floats

    Counts = NDArray[np.int64]

ORIENTATIONS = 100
"""How many orientations are tried where the caller does not say."""
_POSES = 1 << 16
"""Poses that are solved in one call."""
_WITHIN = 1e-9
"""How far a joint may lie outside its limits, in radians or the unit of length."""

Values = Mapping[str, float]


def reachable(
    robot: Robot | LiveArm,
    points: ArrayLike,
    *,
    values: Values | None = None,
    count: int = ORIENTATIONS,
    limits: bool = True,
) -> Bools:
    """Which points (..., 3) the end effector reaches with at least one of ``count`` orientations; (...).

    A point that is reached with orientations between those tried alone is missed; more of them find it. ``limits``
    tells whether the limits of the joints count. Raises :class:`RobotError` where a parameter has no value.
    """
    import numpy as np

    arm = _arm(robot, values)
    return np.asarray(reached(arm, points, orientations(arm, count), limits=limits).any(axis=-1))


def dexterous(
    robot: Robot | LiveArm,
    points: ArrayLike,
    *,
    values: Values | None = None,
    count: int = ORIENTATIONS,
    limits: bool = True,
) -> Bools:
    """Which points (..., 3) the end effector reaches with every one of ``count`` orientations; (...).

    The arm of a task that tells no orientation reaches a point with all of them only where it can turn about it: if its
    axes are parallel, where a turning joint is free; otherwise nowhere.
    """
    import numpy as np

    arm = _arm(robot, values)
    if not asks_for_orientation(arm):
        orientations(arm, 1)
        return _turns_about(arm, _points(points, arm.robot))
    return np.asarray(reached(arm, points, orientations(arm, count), limits=limits).all(axis=-1))


def constant_orientation(
    robot: Robot | LiveArm,
    points: ArrayLike,
    rotation: ArrayLike,
    *,
    values: Values | None = None,
    limits: bool = True,
) -> Bools:
    """Which points (..., 3) the end effector reaches with one orientation (3, 3); (...).

    An arm whose task tells no orientation reaches a point with the one that it has there. Raises :class:`RobotError`
    for what is no rotation and where a parameter has no value.
    """
    import numpy as np

    arm = _arm(robot, values)
    matrix = np.asarray(rotation, dtype=float)
    if matrix.shape != (3, 3):
        raise RobotError(f"an orientation has the shape (3, 3), not {matrix.shape}", where=arm.robot.name)
    result: Bools = reached(arm, points, matrix[None], limits=limits)[..., 0]
    return result


def reached(arm: LiveArm, points: ArrayLike, rotations: ArrayLike, *, limits: bool = True) -> Bools:
    """Which of the orientations (K, 3, 3) the arm reaches at each of the points (..., 3); (..., K).

    Raises :class:`RobotError` for a point that is not finite and for what is no rotation.
    """
    import numpy as np

    turns = np.asarray(rotations, dtype=float)
    _check_rotations(turns, arm.robot)
    where = _points(points, arm.robot)
    flat = where.reshape(-1, 3)
    found = np.zeros((len(flat), len(turns)), dtype=bool)
    step = max(1, _POSES // len(turns))
    for start in range(0, len(flat), step):
        part = flat[start : start + step]
        poses = np.zeros((len(part), len(turns), 4, 4))
        poses[..., :3, :3] = turns
        poses[..., :3, 3] = part[:, None]
        poses[..., 3, 3] = 1.0
        q, valid = arm.ik_batch(poses)
        if limits:
            valid = valid & _inside(arm, q)
        found[start : start + step] = valid.any(axis=-1)
    return found.reshape(*where.shape[:-1], len(turns))


def counted(
    arm: LiveArm, points: ArrayLike, kind: str, *, count: int, rotation: ArrayLike | None = None, limits: bool = True
) -> Counts:
    """How many of the orientations of a workspace the arm reaches at each of the points (..., 3); (...).

    ``kind`` is ``"reachable"``, ``"dexterous"`` or ``"constant"``, the last with its ``rotation``. Of an arm whose task
    tells no orientation all ``count`` are reached where the workspace has the point, and none elsewhere.
    """
    import numpy as np

    if rotation is not None:
        return np.asarray(constant_orientation(arm, points, rotation, limits=limits)).astype(np.int64)
    if asks_for_orientation(arm):
        return np.asarray(reached(arm, points, orientations(arm, count), limits=limits).sum(axis=-1))
    ask = dexterous if kind == "dexterous" else reachable
    return np.asarray(ask(arm, points, limits=limits)) * np.int64(count)


def asks_for_orientation(arm: LiveArm) -> bool:
    """Whether the arm's task tells an orientation, in whole or in part."""
    task = arm.robot.task or Task.POSE
    return "uvw" in COLUMNS[task] or task is Task.POSITION_AXIS


def grid(x: ArrayLike = 0.0, y: ArrayLike = 0.0, z: ArrayLike = 0.0) -> Floats:
    """Points (..., 3) of a slice: each coordinate a number or a list, a list for each axis of the result.

    >>> grid(x=[0, 1], z=[0, 1, 2]).shape
    (2, 3, 3)
    """
    import numpy as np

    axes = [np.atleast_1d(np.asarray(values, dtype=float)) for values in (x, y, z)]
    shape = [len(values) for values, given in zip(axes, (x, y, z), strict=True) if np.ndim(given)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    return points.reshape(*shape, 3)


def _arm(robot: Robot | LiveArm, values: Values | None) -> LiveArm:
    if isinstance(robot, LiveArm):
        if values:
            raise RobotError("values are given to live(), not to an arm that is live", where=robot.robot.name)
        return robot
    return live(robot, values)


def _points(points: ArrayLike, robot: Robot) -> Floats:
    import numpy as np

    array: Floats = np.asarray(points, dtype=float)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise RobotError(f"points have the shape (..., 3), not {array.shape}", where=robot.name)
    if not np.isfinite(array).all():
        raise RobotError("a point is not finite", where=robot.name, remedy="Leave out NaN and infinity.")
    return array


def _check_rotations(turns: Floats, robot: Robot) -> None:
    import numpy as np

    if turns.ndim != 3 or turns.shape[1:] != (3, 3) or not len(turns):
        raise RobotError(f"orientations have the shape (K, 3, 3), not {turns.shape}", where=robot.name)
    off = np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    good = (off <= 1e-6) & (np.linalg.det(np.nan_to_num(turns)) > 0.0)
    if not good.all():
        raise RobotError(
            f"orientation {int(np.argmin(good))} is no rotation",
            where=robot.name,
            remedy="Its columns must be orthogonal, of length one, and right-handed.",
        )


def _inside(arm: LiveArm, q: Floats) -> Bools:
    """Which joint vectors (..., n) lie inside the limits, turning joints wound by whole turns if that helps."""
    import numpy as np

    low, high = arm.limits.T
    turns = np.array([kind == "R" for kind in arm.module.JOINT_TYPES])
    with np.errstate(invalid="ignore"):
        up = np.where(turns & np.isfinite(low), np.ceil((low - q - _WITHIN) / (2.0 * math.pi)), 0.0)
        down = np.where(turns & ~np.isfinite(low) & np.isfinite(high), np.floor((high - q) / (2.0 * math.pi)), 0.0)
        wound = q + 2.0 * math.pi * (up + down)
        inside = (wound >= low - _WITHIN) & (wound <= high + _WITHIN)
    result: Bools = inside.all(axis=-1)
    return result


def _turns_about(arm: LiveArm, points: Floats) -> Bools:
    """At which points (..., 3) an arm in a plane can turn without moving its end: where a turning joint is free."""
    import numpy as np

    found = np.zeros(points.shape[:-1], dtype=bool)
    if len(arm.derivation.chain.groups) > 1:
        return found
    kinds = np.array([kind == "R" for kind in arm.module.JOINT_TYPES])
    pose = np.eye(4)
    for index in np.ndindex(found.shape):
        pose[:3, 3] = points[index]
        found[index] = bool((arm.solve(pose).free & kinds).any())
    return found
