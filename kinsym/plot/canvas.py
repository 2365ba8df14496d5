"""Axes to draw in: equal scales, room for what is drawn and for a legend beside it, the view of an arm in space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from kinsym.plot import style
from kinsym.plot.solids import projected

if TYPE_CHECKING:
    from kinsym.live import Floats

Axes = Any
"""Axes of matplotlib, in the plane or in space."""

_ELEVATION = 22.0
_ASIDE = 20
"""How many degrees the view is at least off the axes x and y."""
_ROOM = 0.09
"""What is left free around the arm, a share of its extent."""
_ROW = 0.2
"""The height of a row of a legend, in inches."""
_SCALE = 0.11
"""The share of a picture that a scale of colours takes."""
_FILLED = 0.82
"""The share of its axes that a picture in space takes; the rest is for ticks and labels."""
_LEAST = 0.35
"""A picture in space is at least so high, and so deep, as a share of its longest side."""


def new_axes(*, space: bool, rows: int = 0, scale: bool = False) -> Axes:
    """Axes of a figure of their own, that of a file 800 dots wide.

    There is room for some ``rows`` of a legend below, and for a ``scale`` of colours at the right.
    """
    figure = Figure(figsize=(style.WIDTH, style.HEIGHT), dpi=style.DPI, facecolor="white")
    FigureCanvasAgg(figure)
    beside = _SCALE if scale else 0.0
    below = (rows + 1) * _ROW / style.HEIGHT if rows else 0.0
    if space:
        return figure.add_axes((0.0, below, 1.0 - beside, 0.91 - below), projection="3d")
    return figure.add_axes((0.1, 0.1 + below, 0.86 - beside, 0.77 - below))


def in_space(ax: Axes) -> bool:
    """Whether axes show three dimensions."""
    return isinstance(ax, Axes3D)


def extent(points: Floats) -> float:
    """The longest side of the box around points (..., d), 1 if they are one point."""
    flat = points.reshape(-1, points.shape[-1])
    return float((flat.max(axis=0) - flat.min(axis=0)).max()) or 1.0


def fit(ax: Axes, points: Floats, size: float, unit: str) -> float:
    """Scale and label axes in space for points (..., 3); the height of the floor."""
    flat = points.reshape(-1, 3)
    low, high = flat.min(axis=0) - _ROOM * size, flat.max(axis=0) + _ROOM * size
    lacking = np.maximum(0.0, _LEAST * (high - low).max() - (high - low)) / 2.0
    low, high = low - lacking, high + lacking
    # An arm that stands on its base stands on the floor.
    low[2] = min(low[2] + lacking[2], float(flat[:, 2].min()) - style.JOINT_RADIUS * size)
    high[2] = max(high[2], low[2] + _LEAST * (high - low).max())
    for name, start, end in zip("xyz", low, high, strict=True):
        getattr(ax, f"set_{name}lim")(start, end)
        axis = getattr(ax, f"{name}axis")
        axis.set_major_locator(MaxNLocator(max(2, round(6 * (end - start) / (high - low).max())), steps=[1, 2, 5, 10]))
        axis.set_pane_color(style.PANE)
        axis.line.set_color(style.FAINT)
        axis._axinfo["grid"].update(color="#e6e9ed", linewidth=0.6)
        axis.set_tick_params(labelsize=style.SMALL, colors=style.INK, pad=1)
        getattr(ax, f"set_{name}label")(labelled(name, unit), fontsize=style.LABEL, color=style.INK)
    ax.set_proj_type("ortho")
    ax.set_box_aspect(high - low)
    corners = np.array([[(low, high)[(k >> i) & 1][i] for i in range(3)] for k in range(8)])
    ax.apply_aspect()
    shown = ax.transData.transform(projected(ax, corners)[:, :2])
    share = ((shown.max(axis=0) - shown.min(axis=0)) / (ax.bbox.width, ax.bbox.height)).max()
    ax.set_box_aspect(high - low, zoom=_FILLED / share)
    return float(low[2])


def look_at(ax: Axes, points: Floats) -> None:
    """Turn axes in space so that the side of the arm is seen, from half right in front."""
    flat = points.reshape(-1, 3)[:, :2]
    spread = flat - flat.mean(axis=0)
    _, sizes, directions = np.linalg.svd(spread, full_matrices=False)
    along = math.degrees(math.atan2(directions[0][1], directions[0][0])) if sizes[0] > 1e-9 else 0.0
    along = (along + 90.0) % 180.0 - 90.0
    turned = round(along - 60.0)
    # Seen along one of its axes a box loses that axis.
    ax.view_init(elev=_ELEVATION, azim=min(max(turned, 90 * (turned // 90) + _ASIDE), 90 * (turned // 90 + 1) - _ASIDE))


def plain(ax: Axes, points: Floats, size: float, unit: str, names: tuple[str, str]) -> None:
    """Scale and label axes in the plane for points (..., 2)."""
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0) - 1.3 * _ROOM * size, flat.max(axis=0) + 1.3 * _ROOM * size
    # The sides of the picture are filled, so that equal scales leave the axes where they are.
    sides = np.array([ax.bbox.width, ax.bbox.height])
    lacking = ((high - low) / sides).max() * sides - (high - low)
    low, high = low - lacking / 2.0, high + lacking / 2.0
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.set_axisbelow(True)
    ax.grid(color="#e6e9ed", linewidth=0.6)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for side in ("bottom", "left"):
        ax.spines[side].set_color(style.FAINT)
    ax.tick_params(labelsize=style.SMALL, colors=style.INK)
    ax.set_xlabel(labelled(names[0], unit), fontsize=style.LABEL, color=style.INK)
    ax.set_ylabel(labelled(names[1], unit), fontsize=style.LABEL, color=style.INK)


def labelled(name: str, unit: str) -> str:
    """The label of an axis: ``x [m]``, or ``x`` where the unit is not known.

    >>> labelled("x", "m"), labelled("x", "")
    ('x [m]', 'x')
    """
    return f"{name} [{unit}]" if unit else name


def legend(ax: Axes, handles: Sequence[Any], *, own: bool, columns: int) -> None:
    """A legend below the axes, where it covers nothing."""
    look = {"handles": handles, "ncols": columns, "frameon": False, "fontsize": style.SMALL, "labelcolor": style.INK}
    if own:
        ax.figure.legend(loc="lower center", bbox_to_anchor=(0.5, 0.005), **look)
    else:
        # Below the label of the axis, whose height does not shrink with the axes.
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), borderaxespad=0.5 if in_space(ax) else 4.5, **look)


def scale(ax: Axes, mappable: Any, text: str, *, own: bool) -> None:
    """A scale of colours from nothing to all, beside the axes."""
    figure = ax.figure
    if own:
        bar = figure.colorbar(mappable, cax=figure.add_axes((1.0 - _SCALE, 0.22, 0.02, 0.55)))
    else:
        bar = figure.colorbar(mappable, ax=ax, shrink=0.7, pad=0.08)
    bar.set_label(text, fontsize=style.SMALL, color=style.INK)
    bar.set_ticks([0.0, 0.25, 0.5, 0.75, 1.0], labels=["0", "25 %", "50 %", "75 %", "100 %"])
    bar.ax.tick_params(labelsize=style.SMALL, colors=style.INK)
    bar.outline.set_visible(False)


def headed(ax: Axes, title: str, second: str = "") -> None:
    """A title, and a smaller line below it, at the left."""
    figure = ax.figure
    figure.text(0.03, 0.965, title, fontsize=style.TITLE, color=style.INK, weight="bold", va="top")
    if second:
        figure.text(0.03, 0.92, second, fontsize=style.SMALL, color=style.FAINT, va="top")
