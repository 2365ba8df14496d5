"""A slice of what an arm reaches, as a drawing."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import TYPE_CHECKING

from markupsafe import Markup

from kinsym.inverse.state import COLUMNS
from kinsym.robot.model import Task
from kinsym.workspace import grid, reached
from kinsym.workspace.orientations import orientations

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats
    from kinsym.page.shown import Shown

LEVELS = (1.0, 2 / 3, 1 / 3)
"""Shares of the orientations from which on a point gets another shade; the last shade is any orientation at all."""

_SAMPLES = 4000
_MARGIN = 0.06
_SIDE = 480.0
#: Cells along the longest side, and orientations at each of them, for a closed form and for the general solver.
_CLOSED, _GENERAL, _ONE = (44, 24), (14, 6), (90, 1)


@dataclass(frozen=True, kw_only=True)
class Slice:
    """The drawing's elements and its size, the axes' letters, what they show, and where the slice lies."""

    elements: Markup
    width: float
    height: float
    letters: str
    low: tuple[float, float]
    high: tuple[float, float]
    where: str
    orientations: int
    shares: tuple[str, ...]


def workspace_slice(shown: Shown) -> Slice | None:
    """The slice through the base in which the arm moves, x and z of an arm in space.

    None of a wrist alone, and of an arm with so few joints that it reaches no point with an orientation that is asked.
    """
    import numpy as np

    arm, shape = shown.arm, shown.shape
    task = arm.robot.task or Task.POSE
    if "p" not in COLUMNS[task]:
        return None
    first, second = shape.plane or (0, 2)
    (normal,) = {0, 1, 2} - {first, second}
    reach = _reach(shown)
    low, high = reach.min(axis=0), reach.max(axis=0)
    margin = _MARGIN * max(float((high - low).max()), 1e-9)
    low, high = low - margin, high + margin
    single = "uvw" not in COLUMNS[task] and task is not Task.POSITION_AXIS
    cells, count = _GENERAL if arm.derivation.plan is None else _ONE if single else _CLOSED
    step = float(max(high[first] - low[first], high[second] - low[second])) / cells
    axes = [np.arange(low[k] + step / 2, high[k], step) for k in (first, second)]
    base = float(shape.frames[0][normal, 3])
    level = base if low[normal] <= base <= high[normal] else float(low[normal] + high[normal]) / 2
    places: dict[int, ArrayLike] = {first: axes[0], second: axes[1], normal: level}
    points = grid(places[0], places[1], places[2])
    turns = orientations(arm, count)
    share = reached(arm, points, turns).mean(axis=-1)
    if not share.any():
        return None
    side = _SIDE / max(len(axes[0]), len(axes[1]))
    return Slice(
        elements=_cells(share, side),
        width=round(side * len(axes[0]), 1),
        height=round(side * len(axes[1]), 1),
        letters="xyz"[first] + "xyz"[second],
        low=(float(low[first]), float(low[second])),
        high=(float(low[first] + step * len(axes[0])), float(low[second] + step * len(axes[1]))),
        where=f"{'xyz'[normal]} = {level:.3g}",
        orientations=len(turns),
        shares=("all", "two thirds", "one third", "any") if len(turns) > 1 else (),
    )


def _reach(shown: Shown) -> Floats:
    """Where the tip is at many joint vectors inside the limits, (k, 3)."""
    import numpy as np

    generator, shape = random.Random(0), shown.shape
    bounds = [
        _range(kind, float(low), float(high), shape.size)
        for kind, (low, high) in zip(shape.kinds, shape.limits, strict=True)
    ]
    low, high = np.array(bounds).T
    draws = np.array([[generator.random() for _ in shape.kinds] for _ in range(_SAMPLES)])
    tips: Floats = shown.arm.fk(low + (high - low) * draws)[:, :3, 3]
    return tips


def _range(kind: str, low: float, high: float, size: float) -> tuple[float, float]:
    """The values of a joint: its limits, else a whole turn, else as far out as the arm is long."""
    if math.isfinite(low) and math.isfinite(high):
        return low, high
    return (-math.pi, math.pi) if kind == "R" else (0.0, size)


def _cells(share: Floats, side: float) -> Markup:
    """Runs of cells with one shade, row by row from the top; share (columns, rows)."""
    parts = []
    columns, rows = share.shape
    for row in range(rows):
        shades = [_shade(float(share[column, row])) for column in range(columns)]
        start = 0
        for column in range(1, columns + 1):
            if column < columns and shades[column] == shades[start]:
                continue
            if shades[start]:
                x, y = side * start, side * (rows - 1 - row)
                parts.append(
                    f'<rect class="shade{shades[start]}" x="{x:.1f}" y="{y:.1f}" '
                    f'width="{side * (column - start) + 0.5:.1f}" height="{side + 0.5:.1f}"/>'
                )
            start = column
    return Markup("".join(parts))


def _shade(share: float) -> int:
    """4 for all orientations, 1 for any, 0 for none."""
    if share <= 0.0:
        return 0
    return 4 - next((k for k, least in enumerate(LEVELS) if share >= least - 1e-9), len(LEVELS))
