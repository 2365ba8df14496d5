"""A question about a workspace in the words of a user: which kind, in which plane, how fine."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from kinsym.errors import RobotError
from kinsym.live import LiveArm, check_values
from kinsym.robot.model import Robot
from kinsym.skeleton import Linkage, linkage
from kinsym.workspace.evaluate import ORIENTATIONS
from kinsym.workspace.grids import Axis, slice_grid, volume_grid
from kinsym.workspace.sweeping import Question

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

POINTS, POINTS_OF_VOLUME = 101, 31
"""Points along the longest side of a slice and of a volume."""


def ask(
    robot: Robot | LiveArm,
    kind: str = "reachable",
    *,
    plane: tuple[str, float] | None = None,
    volume: bool = False,
    points: int | None = None,
    count: int = ORIENTATIONS,
    rotation: ArrayLike | None = None,
    limits: bool = True,
    values: Mapping[str, float] | None = None,
) -> Question:
    """The question for :func:`kinsym.workspace.sweeping.sweep` on a grid as large as the arm reaches.

    ``kind`` is ``"reachable"``, ``"dexterous"`` or ``"constant"``, the last with a ``rotation`` (3, 3). ``plane`` is
    the coordinate that is held and its value, ``("y", 0.0)`` if None, and the arm's own for an arm in a plane;
    ``volume`` asks for all of them. ``points`` lie along the longest side. ``count``, ``limits`` and ``values`` are
    those of :func:`kinsym.workspace.reachable`. Raises :class:`RobotError` for what cannot be asked.

    >>> from kinsym.robot import load
    >>> ask(load("puma560"), plane=("z", 0.2), points=41).shape
    (41, 41, 1)
    """
    import numpy as np

    given = dict(values or {})
    if isinstance(robot, LiveArm):
        given = {**robot.values, **robot.inputs, **given}
        robot = robot.robot
    inputs = [name for name, cell in robot.locks.items() if cell is None]
    check_values(robot, given, inputs)
    shape = linkage(robot, {name: value for name, value in given.items() if name in robot.parameters})
    x, y, z = _grid(robot, shape, plane, volume, points or (POINTS_OF_VOLUME if volume else POINTS))
    turned = None
    if rotation is not None:
        turned = tuple(tuple(float(entry) for entry in row) for row in np.asarray(rotation, dtype=float))
    return Question(robot=robot, kind=kind, x=x, y=y, z=z, count=count, rotation=turned, limits=limits, values=given)


def _grid(
    robot: Robot, shape: Linkage, plane: tuple[str, float] | None, volume: bool, points: int
) -> tuple[Axis, Axis, Axis]:
    if shape.plane is not None:
        if volume or plane is not None:
            names = " and ".join("xyz"[k] for k in shape.plane)
            raise RobotError(
                f"the arm moves in the plane of {names}",
                where=robot.name,
                remedy="Ask for no other plane and no volume.",
            )
        (normal,) = {0, 1, 2} - set(shape.plane)
        return slice_grid(shape, points, "xyz"[normal], float(shape.frames[-1][normal, 3]))
    if volume:
        return volume_grid(shape, points)
    name, value = plane or ("y", 0.0)
    if name not in ("x", "y", "z"):
        raise RobotError(f"{name!r} is no coordinate", where=robot.name, remedy="Hold x, y or z.")
    return slice_grid(shape, points, name, value)
