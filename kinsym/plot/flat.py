"""An arm in a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Circle, FancyArrow, Polygon

from kinsym.plot import canvas, style
from kinsym.plot.parts import COLOURS, Part, parts
from kinsym.plot.writing import name_text

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.skeleton import Linkage, Posture

Plane = tuple[int, int]
"""The two coordinates that a picture shows."""

_WIDTH, _ROUND, _AWAY = 0.034, 0.026, 0.085
"""How thick a link is, the radius of a joint and how far its name is from it, shares of the extent."""
_ABOVE = 3


def draw(ax: Any, shape: Linkage, q: Floats, *, frames: bool, labels: bool, unit: str) -> None:
    """Draw one posture (n,) with all that belongs to it."""
    posture = shape.at(q)
    plane = shape.plane or (0, 1)
    ends = posture.frames[[0, -1]]
    size = room(ax, posture.path, ends, plane, unit=unit, frames=frames)
    for part in parts(shape, posture, size):
        draw_part(ax, part, COLOURS[part.kind], plane, size)
    if frames:
        frames_of(ax, ends, plane, size)
    if labels:
        _name_joints(ax, shape, posture, plane, size)


def room(ax: Any, paths: Floats, ends: Floats, plane: Plane, *, unit: str, frames: bool) -> float:
    """Scale and label axes for corners (k, 3) and the frames (m, 4, 4) at their ends; the extent of the corners."""
    corners = paths[:, plane]
    size = canvas.extent(corners)
    shown = corners if not frames else np.concatenate([corners, *(_ends(frame, plane, size) for frame in ends)])
    canvas.plain(ax, shown, size, unit, ("xyz"[plane[0]], "xyz"[plane[1]]))
    return size


def draw_part(ax: Any, part: Part, colour: str, plane: Plane, size: float) -> None:
    """A part of an arm in some colour."""
    start, end = part.start[list(plane)], part.end[list(plane)]
    match part.kind:
        case "turn":
            look = {"facecolor": "white", "edgecolor": colour, "linewidth": 2.4, "zorder": _ABOVE + 1}
            ax.add_patch(Circle(_point((start + end) / 2.0), _ROUND * size, **look))
        case "slide":
            ax.add_patch(_bar(start, end, style.SLIDE_WIDTH * size, colour, _ABOVE + 1))
        case _:
            width = _WIDTH * size * (0.6 if part.kind == "rod" else 1.0)
            ax.add_patch(_bar(start, end, width, colour, _ABOVE))
            for point in (start, end):
                ax.add_patch(Circle(_point(point), width / 2.0, facecolor=colour, edgecolor="none", zorder=_ABOVE))


def _bar(start: Floats, end: Floats, width: float, colour: str, order: int) -> Polygon:
    way = end - start
    across = width / 2.0 * np.array([-way[1], way[0]]) / (float(np.linalg.norm(way)) or 1.0)
    corners = np.array([start - across, end - across, end + across, start + across])
    return Polygon(corners, facecolor=colour, edgecolor="none", zorder=order)


def _point(place: Floats) -> tuple[float, float]:
    return float(place[0]), float(place[1])


def _ends(frame: Floats, plane: Plane, size: float) -> Floats:
    """Where the three axes of a frame end in the picture, (3, 2)."""
    ends: Floats = frame[plane, 3] + style.END_LENGTH * size * frame[plane, :3].T
    return ends


def frames_of(ax: Any, frames: Floats, plane: Plane, size: float) -> None:
    """Frames (m, 4, 4)."""
    for frame in frames:
        _axes_of(ax, frame, plane, size)


def _axes_of(ax: Any, frame: Floats, plane: Plane, size: float) -> None:
    """The axes of a frame; one that points out of the picture is a dot in a ring, one into it a ring alone."""
    origin = frame[plane, 3]
    normal = next(k for k in range(3) if k not in plane)
    # Seen with the first coordinate to the right and the second up, the viewer is at +z, at -y or at +x.
    towards = (1.0, -1.0, 1.0)[normal]
    for k, (end, colour) in enumerate(zip(_ends(frame, plane, size), (style.X, style.Y, style.Z), strict=True)):
        way = end - origin
        if np.linalg.norm(way) > 1e-6 * size:
            ax.add_patch(
                FancyArrow(
                    *origin, *way, width=0.009 * size, head_width=0.034 * size, head_length=0.04 * size,
                    length_includes_head=True, facecolor=colour, edgecolor="none", zorder=_ABOVE + 2,
                )
            )  # fmt: skip
            continue
        ring = Circle(
            _point(origin), 0.013 * size, facecolor="white", edgecolor=colour, linewidth=1.4, zorder=_ABOVE + 3
        )
        ax.add_patch(ring)
        if frame[normal, k] * towards > 0.0:
            ax.add_patch(Circle(_point(origin), 0.005 * size, facecolor=colour, edgecolor="none", zorder=_ABOVE + 4))


def _name_joints(ax: Any, shape: Linkage, posture: Posture, plane: Plane, size: float) -> None:
    """The name of each joint, on the outer side of the bend that it makes."""
    path = posture.path[:, plane]
    for k, name in enumerate(shape.variables):
        where = posture.joints[k, :3, 3][list(plane)]
        before, after = (_direction(path[j] - where) for j in (2 * k, 2 * k + 3))
        outward = _direction(-(before + after))
        if not outward.any():
            outward = np.array([-after[1], after[0]]) if after.any() else np.array([0.0, 1.0])
        ax.text(
            *(where + _AWAY * size * outward), name_text(name),
            fontsize=style.LABEL + 1, color=style.INK, ha="center", va="center", zorder=_ABOVE + 5,
        )  # fmt: skip


def _direction(way: Floats) -> Floats:
    length = float(np.linalg.norm(way))
    result: Floats = way / length if length > 1e-9 else np.zeros(2)
    return result
