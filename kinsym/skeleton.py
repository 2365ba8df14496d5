"""An arm as a figure: where its links run, its joint axes and its frames are at a posture, as arrays of numbers.

Links run along the common normals, as a Denavit-Hartenberg table says: along axis i from the point where the link
before it arrives to the foot of the normal with axis i + 1, then along that normal. The way from one origin of a frame
to the next would be a straight line that is no part of the arm. Nothing here draws; :mod:`kinsym.plot` does, and so
may a page.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

from kinsym.live import LiveArm, check_values
from kinsym.robot.geometry.arm import Arm, arm_of
from kinsym.robot.geometry.frames import Frame
from kinsym.robot.model import Convention, Robot

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats

_PARALLEL = 0.1
"""Axes whose angle has a smaller sine have no common normal that is worth drawing: its foot may be far away."""
_DETOUR = 3.0
"""Where axes are nearly parallel, frames that lie so much further apart than the axes do are no corners of links."""
_FLAT = 1e-9
"""How far from right angles the axes of an arm in a plane may be."""


@dataclass(frozen=True, kw_only=True)
class Posture:
    """An arm at joint vectors (..., n), in the frame that its forward kinematics leads from.

    ``path`` (..., 2 n + 2, 3) are the corners of the links: the base, then for each joint the point of its axis where
    the link before it arrives and the one where its own link leaves, then the tip. Between those two points a sliding
    joint extends. ``joints`` (..., n, 4, 4) are frames with z along each axis, at the middle of the way along the axis
    of a turning joint and at its beginning for a sliding one. ``frames`` (..., m, 4, 4) are those of
    :attr:`Linkage.frame_names`.
    """

    path: Floats
    joints: Floats
    frames: Floats


@dataclass(frozen=True, kw_only=True)
class Linkage:
    """The geometry of an arm at home, in numbers; :meth:`at` moves it.

    ``kinds`` has "R" or "P" for each joint, ``limits`` (n, 2) its range, infinite where the table has none. ``axes``
    (n, 4, 4) are frames with z along each axis, where the link before arrives. ``frames`` (m, 4, 4) have the names
    ``frame_names`` and are carried by the first ``carried`` joints. ``size`` is the length of the way along the links.
    """

    variables: tuple[str, ...]
    kinds: tuple[str, ...]
    limits: Floats
    axes: Floats
    frames: Floats
    frame_names: tuple[str, ...]
    carried: tuple[int, ...]
    size: float

    def at(self, q: ArrayLike) -> Posture:
        """The arm at joint vectors (..., n), angles in radians."""
        import numpy as np

        values = np.asarray(q, dtype=float)
        moved = [np.broadcast_to(np.eye(4), (*values.shape[:-1], 4, 4))]
        for i, kind in enumerate(self.kinds):
            home = self.axes[i]
            moved.append(moved[-1] @ home @ _motions(kind, values[..., i]) @ _inverse(home))
        before, after = np.stack(moved[:-1], axis=-3), np.stack(moved[1:], axis=-3)
        joints = before @ self.axes
        frames = np.stack([moved[count] @ self.frames[k] for k, count in enumerate(self.carried)], axis=-3)
        arrive = joints[..., :3, 3]
        onward = np.concatenate([arrive[..., 1:, :], frames[..., -1:, :3, 3]], axis=-2)
        along = np.einsum("...ni,...ni->...n", onward - arrive, joints[..., :3, 2])
        leave = arrive + along[..., None] * joints[..., :3, 2]
        corners = np.stack([arrive, leave], axis=-2).reshape(*arrive.shape[:-2], -1, 3)
        path = np.concatenate([frames[..., :1, :3, 3], corners, frames[..., -1:, :3, 3]], axis=-2)
        turning = np.array([kind == "R" for kind in self.kinds])
        joints = after @ self.axes
        joints[..., :3, 3] = np.where(turning[:, None], (arrive + leave) / 2.0, arrive)
        return Posture(path=path, joints=joints, frames=frames)

    @property
    def plane(self) -> tuple[int, int] | None:
        """The two coordinates that change if the arm moves in a plane along the axes of its base, else None."""
        import numpy as np

        z = self.axes[:, :3, 2]
        for normal in (2, 1, 0):
            across = np.abs(z[:, normal])
            turning = np.array([kind == "R" for kind in self.kinds])
            if (np.where(turning, 1.0 - across, across) < _FLAT).all():
                first, second = (k for k in range(3) if k != normal)
                return first, second
        return None


def linkage(arm: Robot | LiveArm, values: Mapping[str, float] | None = None) -> Linkage:
    """The geometry of a robot with numbers; ``values`` are those of parameters without one in the table.

    Raises :class:`kinsym.errors.RobotError` with the parameters that lack a value.

    >>> from kinsym.robot import load
    >>> corners = linkage(load("planar_rr"), {"l1": 2.0, "l2": 1.0}).at([0.0, 0.0]).path
    >>> corners[:, 0].tolist()
    [0.0, 0.0, 0.0, 2.0, 2.0, 3.0]
    """
    import numpy as np

    robot, given = (arm.robot, {**arm.values, **(values or {})}) if isinstance(arm, LiveArm) else (arm, values or {})
    check_values(robot, given)
    numbers = {name: Fraction(given[name]) if name in given else value for name, value in robot.parameters.items()}
    home = arm_of(replace(robot, parameters=numbers))
    axes = np.array([_matrix(axis.frame) for axis in home.axes])
    frames, names, carried = _frames(robot, home)
    size, way = float(home.size), _way(np.concatenate([frames[:1, :3, 3], axes[:, :3, 3], frames[-1:, :3, 3]]))
    if robot.convention is Convention.SCREW or (_nearly_parallel(axes) and way > _DETOUR * size):
        axes[:, :3, 3] = _corners(axes, frames[0, :3, 3])
    else:
        size = max(size, way)
    bounds = [(-np.inf, np.inf) if joint.limits is None else joint.limits for joint in robot.moving]
    return Linkage(
        variables=robot.variables,
        kinds=tuple(joint.kind for joint in robot.moving),
        limits=np.array(bounds, dtype=float),
        axes=axes,
        frames=frames,
        frame_names=names,
        carried=carried,
        size=size,
    )


def _frames(robot: Robot, home: Arm) -> tuple[Floats, tuple[str, ...], tuple[int, ...]]:
    """The frames of the table, and the tool's where it is another one, each with the joints that carry it."""
    import numpy as np

    frames, names, carried = [home.frames[0]], ["0"], [0]
    for number, frame in enumerate(home.frames[1:], start=1):
        frames.append(frame)
        names.append(str(number))
        carried.append(sum(joint.variable is not None for joint in robot.joints[:number]))
    if robot.convention is Convention.SCREW or robot.tool is not None:
        frames.append(home.tip)
        names.append("tool")
        carried.append(len(home.axes))
    return np.array([_matrix(frame) for frame in frames]), tuple(names), tuple(carried)


def _corners(axes: Floats, start: Floats) -> Floats:
    """A point (n, 3) of each axis where the link before it arrives, by the axes (n, 4, 4) alone.

    It is the foot of the common normal with the axis before; of axes that are parallel, or nearly so, the point next to
    the one before.
    """
    import numpy as np

    points = [_nearest(axes[0], start)]
    for before, axis in pairwise(axes):
        u, v = before[:3, 2], axis[:3, 2]
        normal = np.cross(u, v)
        square = float(normal @ normal)
        if square < _PARALLEL**2:
            points.append(_nearest(axis, points[-1]))
            continue
        along = float(np.cross(axis[:3, 3] - before[:3, 3], u) @ normal) / square
        points.append(axis[:3, 3] + along * v)
    return np.array(points)


def _nearly_parallel(axes: Floats) -> bool:
    """Whether two axes in a row are parallel but for a small angle, as in the table of a calibrated arm."""
    import numpy as np

    sines = np.linalg.norm(np.cross(axes[:-1, :3, 2], axes[1:, :3, 2]), axis=-1)
    return bool(((sines > _FLAT) & (sines < _PARALLEL)).any())


def _nearest(axis: Floats, point: Floats) -> Floats:
    z = axis[:3, 2]
    result: Floats = axis[:3, 3] + float((point - axis[:3, 3]) @ z) * z
    return result


def _way(points: Floats) -> float:
    import numpy as np

    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _motions(kind: str, values: Floats) -> Floats:
    """Turns about, or slides along, z: (...) to (..., 4, 4)."""
    import numpy as np

    motions = np.zeros((*values.shape, 4, 4))
    motions[...] = np.eye(4)
    if kind == "P":
        motions[..., 2, 3] = values
        return motions
    c, s = np.cos(values), np.sin(values)
    motions[..., 0, 0], motions[..., 0, 1], motions[..., 1, 0], motions[..., 1, 1] = c, -s, s, c
    return motions


def _inverse(frame: Floats) -> Floats:
    import numpy as np

    back = np.eye(4)
    back[:3, :3] = frame[:3, :3].T
    back[:3, 3] = -frame[:3, :3].T @ frame[:3, 3]
    return back


def _matrix(frame: Frame) -> list[list[float]]:
    columns = (frame.x, frame.y, frame.z, frame.origin)
    return [*([float(column[row]) for column in columns] for row in range(3)), [0.0, 0.0, 0.0, 1.0]]
