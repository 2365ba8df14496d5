"""Solid bodies in a picture in space: what lies in front hides what lies behind, whatever it belongs to.

Matplotlib sorts the facets of one collection by depth, not those of several; so an arm, its joints and its frames, and
arms drawn over each other, are one collection. Only facets that look at the viewer are drawn, which halves a file.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb

if TYPE_CHECKING:
    from kinsym.live import Floats

_SIDES = 12
_PIECE = 7.0
"""Tubes are cut into pieces of so many times their radius, so that their depth is that of their middle."""
_DARKEST = 0.62
"""What is left of a colour on a facet that looks away from the light."""
_LIGHT = (-0.35, 0.9, 0.25)
"""Where the light comes from: to the right, up, and towards the viewer."""


@dataclass(frozen=True)
class Body:
    """Facets (k, 3) of one colour, each seen from outside counterclockwise.

    ``flat`` ones lie on the floor, below all others. ``lift`` is how much nearer to the viewer a body counts than it
    is, so that a frame is seen whose origin lies inside a link.
    """

    facets: tuple[Floats, ...]
    colour: str
    flat: bool = False
    lift: float = 0.0


def tube(start: Floats, end: Floats, radius: float, colour: str, *, sides: int = _SIDES, tip: float = 1.0) -> Body:
    """A round bar with flat ends; ``tip`` is the share of its radius that it ends with, 0 for a cone."""
    way = end - start
    length = float(np.linalg.norm(way))
    if length == 0.0:
        return Body((), colour)
    z = way / length
    x, y = _across(z)
    angles = 2.0 * math.pi / sides * np.arange(sides)
    ring = np.cos(angles)[:, None] * x + np.sin(angles)[:, None] * y
    cuts = np.linspace(0.0, 1.0, 1 + max(1, math.ceil(length / (_PIECE * radius)))) if tip == 1.0 else np.array([0, 1])
    rings = [start + share * way + radius * (1.0 - share * (1.0 - tip)) * ring for share in cuts]
    facets = [
        np.array([low[k - 1], low[k], high[k], high[k - 1]]) for low, high in pairwise(rings) for k in range(sides)
    ]
    return Body((*facets, rings[0][::-1], rings[-1]), colour)


def box(frame: Floats, width: float, length: float, colour: str) -> Body:
    """A bar with a square section, its middle at the origin of a frame (4, 4) and its length along z."""
    half = np.array([width, width, length]) / 2.0
    facets = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            first, second = (axis + 1) % 3, (axis + 2) % 3
            corners = np.zeros((4, 3))
            corners[:, axis] = sign
            corners[:, first] = np.array([-1, 1, 1, -1]) * sign
            corners[:, second] = [-1, -1, 1, 1]
            facets.append((corners * half) @ frame[:3, :3].T + frame[:3, 3])
    return Body(tuple(facets), colour)


def ball(middle: Floats, radius: float, colour: str, *, sides: int = 8) -> Body:
    """A ball of few facets, to round the corner of two tubes."""
    tilts = np.linspace(-math.pi / 2.0, math.pi / 2.0, sides // 2 + 1)
    turns = 2.0 * math.pi / sides * np.arange(sides + 1)
    points = middle + radius * np.array(
        [[(math.cos(t) * math.cos(s), math.cos(t) * math.sin(s), math.sin(t)) for s in turns] for t in tilts]
    )
    facets = [
        np.array([points[i, j], points[i, j + 1], points[i + 1, j + 1], points[i + 1, j]])
        for i in range(len(tilts) - 1)
        for j in range(sides)
    ]
    return Body(tuple(facets), colour)


def arrow(start: Floats, end: Floats, radius: float, colour: str, *, lift: float = 0.0) -> Body:
    """A thin bar with a cone at its end."""
    neck = start + 0.72 * (end - start)
    bar = tube(start, neck, radius, colour, sides=6)
    head = tube(neck, end, 2.6 * radius, colour, sides=8, tip=0.0)
    return Body((*bar.facets, *head.facets), colour, lift=lift)


def shadow(points: Floats, radius: float, floor: float, colour: str) -> Body:
    """What a polyline (k, 3) of some thickness throws on the floor from right above."""
    flat = points[:, :2]
    angles = 2.0 * math.pi / _SIDES * np.arange(_SIDES)
    round_end = radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    shapes = [corner + round_end for corner in flat]
    for start, end in pairwise(flat):
        way = end - start
        length = float(np.linalg.norm(way))
        if length > 0.0:
            across = radius * np.array([-way[1], way[0]]) / length
            shapes.append(np.array([start - across, end - across, end + across, start + across]))
    return Body(tuple(np.column_stack([shape, np.full(len(shape), floor)]) for shape in shapes), colour, flat=True)


class Solids(PolyCollection):
    """All bodies of a picture; matplotlib asks for their projection whenever the picture is drawn or turned."""

    def __init__(self, bodies: Sequence[Body]) -> None:
        super().__init__([], linewidths=0.25, joinstyle="round")
        shown = [(body, facet) for body in bodies for facet in body.facets]
        self._corners = np.array([len(facet) for _, facet in shown])
        self._points = np.concatenate([facet for _, facet in shown])
        self._colours = np.array([to_rgb(body.colour) for body, _ in shown])
        self._flat = np.array([body.flat for body, _ in shown])
        self._lift = np.array([body.lift for body, _ in shown])
        self._normals = np.array([_normal(facet) for _, facet in shown])

    def do_3d_projection(self) -> float:
        """Project, drop what looks away, shade, and put what is far away first; the least depth."""
        axes: Any = self.axes
        seen = projected(axes, self._points)
        ends = np.cumsum(self._corners)
        _, _, towards = view(axes)
        nearer = self._points + np.repeat(self._lift, self._corners)[:, None] * towards
        depth = np.add.reduceat(projected(axes, nearer)[:, 2], ends - self._corners) / self._corners
        depth[self._flat] = math.inf
        order = np.argsort(-depth, kind="stable")
        facets = [seen[end - count : end, :2] for end, count in zip(ends, self._corners, strict=True)]
        order = order[[self._flat[k] or _area(facets[k]) > 0.0 for k in order]]
        colours = self._shaded(axes)[order]
        self.set_verts([facets[k] for k in order])
        self.set_facecolor(colours)
        self.set_edgecolor(colours)
        return float(seen[:, 2].min())

    def _shaded(self, axes: Any) -> Floats:
        light = np.array(_LIGHT) @ np.array(view(axes))
        bright = (1.0 + self._normals @ (light / np.linalg.norm(light))) / 2.0
        share = np.where(self._flat, 1.0, _DARKEST + (1.0 - _DARKEST) * bright)
        colours: Floats = np.clip(self._colours * share[:, None], 0.0, 1.0)
        return colours


def view(axes: Any) -> tuple[Floats, Floats, Floats]:
    """To the right, up and towards the viewer, for axes in space; unit vectors."""
    turn, tilt = math.radians(axes.azim), math.radians(axes.elev)
    towards = np.array([math.cos(tilt) * math.cos(turn), math.cos(tilt) * math.sin(turn), math.sin(tilt)])
    right = np.array([-math.sin(turn), math.cos(turn), 0.0])
    return right, np.cross(towards, right), towards


def projected(axes: Any, points: Floats) -> Floats:
    """Points (k, 3) as axes in space show them: across, up, depth."""
    homogeneous = np.column_stack([points, np.ones(len(points))]) @ axes.get_proj().T
    result: Floats = homogeneous[:, :3] / homogeneous[:, 3:]
    return result


def _across(z: Floats) -> tuple[Floats, Floats]:
    helper = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = helper - (helper @ z) * z
    x /= np.linalg.norm(x)
    return x, np.cross(z, x)


def _normal(facet: Floats) -> Floats:
    """The direction that a facet looks in; zero of one that has no area."""
    total = np.cross(facet, np.roll(facet, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(total))
    result: Floats = total / size if size else total
    return result


def _area(facet: Floats) -> float:
    """Twice the area of a facet in the picture, negative if it is seen from behind."""
    x, y = facet.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
