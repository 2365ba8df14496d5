"""All solutions of one pose, drawn over each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Patch

from kinsym.errors import RobotError
from kinsym.live import LiveArm
from kinsym.plot import canvas, flat, space, style
from kinsym.plot.parts import Part, painted, parts
from kinsym.plot.skeleton import axes_for
from kinsym.skeleton import Linkage, Posture, linkage

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats

_SAME = 1e-6
"""Solutions whose links lie so near to each other, as a share of the arm, are one arm in the picture."""
_COLUMNS = 2
_THIN = 0.7
"""How thick these arms are beside one that is drawn alone."""


@dataclass(frozen=True)
class Drawn:
    """Solutions that look alike: their places in the arm's BRANCHES, and one of their joint vectors (n,)."""

    places: tuple[int, ...]
    q: Floats

    def label(self, names: Sequence[str]) -> str:
        """The places, and the words that the branches have in common.

        >>> Drawn((0, 1), None).label(["elbow up, wrist flipped", "elbow up, wrist not flipped"])
        '0, 1:  elbow up'
        """
        words = [names[place].split(", ") for place in self.places]
        shared = [word for word in words[0] if all(word in others for others in words)]
        numbers = ", ".join(map(str, self.places))
        return f"{numbers}:  {', '.join(shared)}" if shared else numbers


def branches(
    arm: LiveArm, pose: ArrayLike, ax: Any = None, *, frames: bool = True, legend: bool = True, unit: str = ""
) -> Any:
    """Draw every solution of a pose (4, 4) in a colour of its own, and the frames of base and tool.

    Solutions whose links coincide, such as those of a wrist with three axes in a point, are one arm with all their
    numbers, which are their places in ``BRANCHES`` of the generated code. The arguments are those of
    :func:`kinsym.plot.skeleton`. Returns the axes. Raises :class:`RobotError` for a pose that is out of reach or none.
    """
    shape = linkage(arm)
    drawn = solutions(arm, shape, pose)
    own = ax is None
    ax = canvas.new_axes(space=shape.plane is None, rows=-(-len(drawn) // _COLUMNS)) if own else axes_for(shape, ax)
    if canvas.in_space(ax):
        _in_space(ax, shape, drawn, frames=frames, unit=unit)
    else:
        _in_plane(ax, shape, drawn, frames=frames, unit=unit)
    if legend:
        handles = [Patch(color=_colour(k), label=item.label(arm.module.BRANCHES)) for k, item in enumerate(drawn)]
        canvas.legend(ax, handles, own=own, columns=_COLUMNS)
    if own:
        canvas.headed(ax, arm.robot.title or arm.robot.name, _counted(drawn))
    return ax


def solutions(arm: LiveArm, shape: Linkage, pose: ArrayLike) -> tuple[Drawn, ...]:
    """The solutions of a pose in the order of branches, those that look alike together."""
    try:
        found = arm.solve(np.asarray(pose, dtype=float))
    except (TypeError, ValueError) as error:
        raise RobotError(f"the pose is none: {error}", where=arm.robot.name, remedy="Give a matrix (4, 4).") from None
    if not len(found.q):
        reason = "no pose: its rotation is none" if found.status == "not a pose" else "out of reach"
        raise RobotError(f"the pose is {reason}", where=arm.robot.name, remedy="Give another one.")
    paths = shape.at(found.q).path
    groups: list[list[int]] = []
    for row, path in enumerate(paths):
        alike = (group for group in groups if np.abs(paths[group[0]] - path).max() < _SAME * shape.size)
        group = next(alike, None)
        if group is None:
            groups.append([row])
        else:
            group.append(row)
    return tuple(Drawn(tuple(int(found.branch[row]) for row in group), found.q[group[0]]) for group in groups)


def _in_space(ax: Any, shape: Linkage, drawn: Sequence[Drawn], *, frames: bool, unit: str) -> None:
    postures = [shape.at(item.q) for item in drawn]
    paths = np.concatenate([posture.path for posture in postures])
    size = canvas.extent(paths)
    ends = _common_ends(postures)
    room = np.concatenate([paths, space.frame_ends(ends, size).reshape(-1, 3)]) if frames else paths
    canvas.look_at(ax, paths)
    canvas.fit(ax, room, size, unit)
    bodies = list(space.frame_bodies(ends, size)) if frames else []
    for part, colour in _painted(shape, postures, size):
        bodies += space.bodies_of(part, colour, size, scale=_THIN, sides=8)
    space.show(ax, bodies)


def _in_plane(ax: Any, shape: Linkage, drawn: Sequence[Drawn], *, frames: bool, unit: str) -> None:
    plane = shape.plane or (0, 1)
    postures = [shape.at(item.q) for item in drawn]
    ends = _common_ends(postures)
    paths = np.concatenate([posture.path for posture in postures])
    size = flat.room(ax, paths, ends, plane, unit=unit, frames=frames)
    for part, colour in _painted(shape, postures, size):
        flat.draw_part(ax, part, colour, plane, size)
    if frames:
        flat.frames_of(ax, ends, plane, size)


def _painted(shape: Linkage, postures: Sequence[Posture], size: float) -> Iterator[tuple[Part, str]]:
    arms = [list(parts(shape, posture, size)) for posture in postures]
    return painted(arms, [_colour(k) for k in range(len(arms))], size)


def _common_ends(postures: Sequence[Posture]) -> Floats:
    """The base's frame and, where all arms have it in common, the tool's."""
    tools = np.array([posture.frames[-1] for posture in postures])
    alike = np.abs(tools - tools[0]).max() < _SAME * max(1.0, float(np.abs(tools).max()))
    return postures[0].frames[[0, -1]] if alike else postures[0].frames[:1]


def _colour(k: int) -> str:
    return style.BRANCHES[k % len(style.BRANCHES)]


def _counted(drawn: Sequence[Drawn]) -> str:
    count = sum(len(item.places) for item in drawn)
    alike = "" if count == len(drawn) else f"; those whose links coincide are drawn once, {len(drawn)} in all"
    return f"{count} solution{'s' * (count != 1)} of one pose{alike}"
