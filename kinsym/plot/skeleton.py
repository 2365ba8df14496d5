"""An arm at one posture: links, joints, frames."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kinsym.errors import RobotError
from kinsym.live import LiveArm
from kinsym.plot import canvas, flat, space
from kinsym.plot.writing import posture_text
from kinsym.postures import general_posture
from kinsym.robot.model import Robot
from kinsym.skeleton import Linkage, linkage

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats


def skeleton(
    arm: Robot | LiveArm,
    q: ArrayLike | None = None,
    ax: Any = None,
    *,
    values: Mapping[str, float] | None = None,
    frames: bool = True,
    labels: bool = True,
    unit: str = "",
) -> Any:
    """Draw an arm at joint values ``q`` (n,), radians and the unit of length; a posture that shows it well if None.

    Turning joints are round, sliding ones square. ``frames`` are those of the table, with x, y, z in vermilion, green
    and blue; ``labels`` name the joints. ``ax`` are axes of matplotlib, in the plane for an arm in a plane and in space
    for others; a new figure without them. ``values`` are those of parameters without one in the table, ``unit`` is
    written at the axes. Returns the axes. Raises :class:`RobotError` for joint values that are none.
    """
    shape = linkage(arm, values)
    robot = arm.robot if isinstance(arm, LiveArm) else arm
    posture = general_posture(shape) if q is None else checked_posture(shape, q, robot.name)
    own = ax is None
    ax = axes_for(shape, ax)
    if canvas.in_space(ax):
        space.draw(ax, shape, posture, frames=frames, labels=labels, unit=unit)
    else:
        flat.draw(ax, shape, posture, frames=frames, labels=labels, unit=unit)
    if own:
        canvas.headed(ax, robot.title or robot.name, posture_text(shape.variables, shape.kinds, posture))
    return ax


def axes_for(shape: Linkage, ax: Any) -> Any:
    """The axes that are given, or new ones; RobotError where an arm in space would be drawn in a plane."""
    if ax is None:
        return canvas.new_axes(space=shape.plane is None)
    if shape.plane is None and not canvas.in_space(ax):
        raise RobotError(
            "this arm moves in space and the axes are plain", remedy='Give axes made with projection="3d", or none.'
        )
    return ax


def checked_posture(shape: Linkage, q: ArrayLike, where: str) -> Floats:
    """Joint values as an array (n,); RobotError for what is none."""
    try:
        posture: Floats = np.asarray(q, dtype=float)
    except (TypeError, ValueError):
        raise RobotError("the joint values are no numbers", where=where, remedy="Give one for each joint.") from None
    if posture.shape != (len(shape.kinds),):
        raise RobotError(
            f"the joint values have the shape {posture.shape}, the arm has {len(shape.kinds)} joints",
            where=where,
            remedy=f"Give one for each of {', '.join(shape.variables)}.",
        )
    if not np.isfinite(posture).all():
        raise RobotError("a joint value is not finite", where=where, remedy="Leave out NaN and infinity.")
    return posture
