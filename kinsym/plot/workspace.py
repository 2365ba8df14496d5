"""A workspace: a slice as a map, a volume cut open."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize, to_hex
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from kinsym.errors import RobotError
from kinsym.plot import canvas, space, style
from kinsym.plot.solids import Body
from kinsym.plot.writing import number_text, value_text

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.workspace.sweeping import Question, Workspace

_MAP = ListedColormap(colormaps["viridis"](np.linspace(0.08, 0.97, 256)))
"""Brighter is more; even in lightness, so that it can be read without colours (Smith and van der Walt 2015)."""
_SCALE = "share of the orientations reached"
_PLAIN = 0.62
"""The place on the map of what is inside, where there is no more to tell."""
_SHADES = 16
_VOLUME_VIEW = (28.0, -52.0)


def workspace(result: Workspace, ax: Any = None, *, unit: str = "") -> Any:
    """Draw a workspace that :func:`kinsym.workspace.sweeping.sweep` has found; the axes.

    A slice is a map, coloured by the share of the orientations that are reached at each point, with the closed border
    where it is known. A volume is drawn with the quarter in front left out. ``ax`` are axes in the plane or in
    space; a new figure without them. Raises :class:`RobotError` for axes of the other kind.
    """
    volume = all(len(axis) > 1 for axis in _grid(result.question))
    own = ax is None
    if own:
        ax = canvas.new_axes(space=volume, rows=0 if volume else 1, scale=_shared(result))
    elif canvas.in_space(ax) != volume:
        kind = 'made with projection="3d"' if volume else "in the plane"
        raise RobotError(f"this workspace needs axes {kind}", remedy="Give those, or none.")
    (_in_space if volume else _in_plane)(ax, result, unit=unit, own=own)
    if own:
        robot = result.question.robot
        canvas.headed(ax, robot.title or robot.name, said(result))
    return ax


def said(result: Workspace) -> str:
    """What the picture shows, in words."""
    question = result.question
    kind = {
        "reachable": "Reachable workspace",
        "dexterous": "Dexterous workspace",
        "constant": "Workspace of one orientation",
    }[question.kind]
    robot, kinds = question.robot, {joint.variable: joint.kind for joint in question.robot.moving}
    locked = {name: float(cell) for name, cell in robot.locks.items() if cell is not None}
    held = [value_text(name, kinds.get(name, "P"), value) for name, value in {**question.values, **locked}.items()]
    slices = zip("xyz", _grid(question), strict=True)
    held += [f"{name} = {number_text(axis[0], 4)}" for name, axis in slices if len(axis) == 1]
    limits = [] if question.limits else ["limits of the joints left out"]
    none = [] if result.inside.any() else ["no point of the grid is inside"]
    return ",  ".join([kind, *held, *limits, *none])


def _grid(question: Question) -> tuple[tuple[float, ...], ...]:
    return question.x, question.y, question.z


def _shared(result: Workspace) -> bool:
    """Whether the picture shows at how many orientations a point is reached."""
    some = result.hits[result.hits > 0]
    return result.question.kind == "reachable" and bool((some < result.tried).any())


def _in_plane(ax: Any, result: Workspace, *, unit: str, own: bool) -> None:
    grid = _grid(result.question)
    across, up = [k for k, axis in enumerate(grid) if len(axis) > 1]
    values = result.share.squeeze()
    inside = result.inside.squeeze()
    low, high = (np.array([grid[k][end] for k in (across, up)]) for end in (0, -1))
    step = (high - low) / (np.array(values.shape) - 1)
    corners = np.array([low - step / 2.0, high + step / 2.0])
    canvas.plain(ax, corners, 0.0, unit, ("xyz"[across], "xyz"[up]))
    shown = np.ma.masked_where(~inside, values) if _shared(result) else np.ma.masked_where(~inside, inside * _PLAIN)
    edges = (corners[0, 0], corners[1, 0], corners[0, 1], corners[1, 1])
    look = {"origin": "lower", "extent": edges, "interpolation": "nearest", "aspect": "equal", "zorder": 2}
    handles: list[Any] = []
    if result.question.kind == "dexterous" and (result.hits > 0).any():
        outside = np.ma.masked_where(inside | (values == 0.0), values * 0.0)
        ax.imshow(outside.T, cmap=ListedColormap([style.SHADOW]), **look)
        handles.append(Patch(color=style.SHADOW, label="reached with some orientations"))
    image = ax.imshow(shown.T, cmap=_MAP, vmin=0.0, vmax=1.0, **look)
    if _shared(result):
        canvas.scale(ax, image, _SCALE, own=own)
    else:
        handles.insert(0, Patch(color=to_hex(_MAP(_PLAIN)), label=_inside_label(result)))
    if result.border and (across, up) == (0, 1):
        for radius in result.border:
            ax.add_patch(
                Circle(result.base[[across, up]], radius, fill=False, color=style.INK, linewidth=1.4, zorder=4)
            )
        handles.append(Line2D([], [], color=style.INK, linewidth=1.4, label="border in closed form"))
    base = result.base[[across, up]]
    ax.plot(*base, marker="^", color=style.X, markeredgecolor="white", markersize=9, linestyle="none", zorder=5)
    handles.append(Line2D([], [], marker="^", color=style.X, markeredgecolor="white", linestyle="none", label="base"))
    canvas.legend(ax, handles, own=own, columns=4)


def _inside_label(result: Workspace) -> str:
    match result.question.kind:
        case "dexterous":
            return "reached with every orientation tried"
        case "constant":
            return "reached with this orientation"
        case _:
            return "reached"


def _in_space(ax: Any, result: Workspace, *, unit: str, own: bool) -> None:
    grid = [np.array(axis) for axis in _grid(result.question)]
    box = np.array([[axis[0] for axis in grid], [axis[-1] for axis in grid]])
    ax.view_init(elev=_VOLUME_VIEW[0], azim=_VOLUME_VIEW[1])
    canvas.fit(ax, np.array(box), 0.0, unit)
    # The viewer stands at +x, -y: that quarter about the base is left out, so that the inside is seen.
    x, y = grid[0][:, None, None], grid[1][None, :, None]
    kept = result.inside & ~((x > result.base[0]) & (y < result.base[1]))
    values = result.share if _shared(result) else np.full(result.hits.shape, _PLAIN)
    if kept.any():
        space.show(ax, _blocks(grid, kept, values), raster=True)
    if _shared(result):
        canvas.scale(ax, ScalarMappable(Normalize(0.0, 1.0), _MAP), _SCALE, own=own)


def _blocks(grid: list[Floats], kept: Any, values: Floats) -> list[Body]:
    """The outer faces of the blocks around the points that are kept, those of one shade together."""
    facets: dict[int, list[Floats]] = {}
    half = np.array([(axis[1] - axis[0]) / 2.0 for axis in grid])
    padded = np.pad(kept, 1)
    shades = np.minimum((values * _SHADES).astype(int), _SHADES - 1)
    for axis in range(3):
        for sign in (1, -1):
            beside = np.roll(padded, -sign, axis=axis)[1:-1, 1:-1, 1:-1]
            face = _face(axis, sign) * half
            for place in np.argwhere(kept & ~beside):
                middle = np.array([grid[k][place[k]] for k in range(3)])
                facets.setdefault(int(shades[tuple(place)]), []).append(middle + face)
    return [Body(tuple(faces), to_hex(_MAP((shade + 0.5) / _SHADES))) for shade, faces in sorted(facets.items())]


def _face(axis: int, sign: int) -> Floats:
    """The corners (4, 3) of one face of the cube from -1 to 1, counterclockwise from outside."""
    corners = np.zeros((4, 3))
    corners[:, axis] = sign
    corners[:, (axis + 1) % 3] = np.array([-1, 1, 1, -1]) * sign
    corners[:, (axis + 2) % 3] = [-1, -1, 1, 1]
    return corners
