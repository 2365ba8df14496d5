"""An arm in space, as solid bodies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patheffects import withStroke

from kinsym.plot import canvas, style
from kinsym.plot.parts import COLOURS, Part, parts
from kinsym.plot.solids import Body, Solids, arrow, ball, box, shadow, tube, view
from kinsym.plot.writing import name_text

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.skeleton import Linkage, Posture

BODIES = "bodies"
"""What the group of all facets is called in an SVG."""
_NAME = np.array([[-0.015, 0.0], [0.0, 0.0], [0.015, 0.0]])
"""What a name covers, as points beside its middle."""


def draw(ax: Any, shape: Linkage, q: Floats, *, frames: bool, labels: bool, unit: str) -> None:
    """Draw one posture (n,) with all that belongs to it."""
    posture = shape.at(q)
    size = canvas.extent(posture.path)
    corners = [posture.path]
    if frames:
        corners.append(frame_ends(posture.frames, size).reshape(-1, 3))
    room = np.concatenate(corners)
    canvas.look_at(ax, posture.path)
    floor = canvas.fit(ax, room, size, unit)
    bodies = [shadow(posture.path, style.RADIUS * size, floor, style.SHADOW)]
    for part in parts(shape, posture, size):
        bodies += bodies_of(part, COLOURS[part.kind], size)
    if frames:
        bodies += frame_bodies(posture.frames, size)
    show(ax, bodies)
    if labels:
        name_joints(ax, shape, posture, size)


def show(ax: Any, bodies: Sequence[Body], *, raster: bool = False) -> None:
    """Draw bodies, which hide each other as they do in space; ``raster`` keeps thousands of facets out of an SVG."""
    solids = Solids(bodies)
    solids.set_rasterized(raster)
    solids.set_clip_on(False)
    solids.set_gid(BODIES)
    ax.add_collection(solids)


def bodies_of(part: Part, colour: str, size: float, *, scale: float = 1.0, sides: int = 12) -> Iterator[Body]:
    """A part of an arm in some colour; ``scale`` makes it thinner, ``sides`` says how round it is."""
    radius = scale * style.RADIUS * size
    match part.kind:
        case "rod":
            yield from _rod(part, scale * style.ROD_WIDTH * size, colour)
        case "slide":
            length = float(np.linalg.norm(part.end - part.start))
            yield box(part.frame, scale * style.SLIDE_WIDTH * size, scale * length, colour)
        case "turn":
            short = (1.0 - scale) / 2.0 * (part.end - part.start)
            wide = scale * style.JOINT_RADIUS * size
            bar = tube(part.start + short, part.end - short, wide, colour, sides=sides + 6)
            # A joint hides the link inside it, however long the facets of both are.
            yield replace(bar, lift=wide)
        case _:
            yield tube(part.start, part.end, radius, colour, sides=sides)
    if part.corner:
        yield ball(part.end, radius, colour)


def _rod(part: Part, width: float, colour: str) -> Iterator[Body]:
    """What a sliding joint draws out: a square bar in pieces."""
    length = float(np.linalg.norm(part.end - part.start))
    pieces = max(1, round(length / (3.0 * width)))
    for k in range(pieces):
        piece = part.frame.copy()
        piece[:3, 3] = part.start + (k + 0.5) / pieces * (part.end - part.start)
        yield box(piece, width, length / pieces, colour)


def frame_ends(frames: Floats, size: float) -> Floats:
    """Where the axes of frames (m, 4, 4) end, (m, 3, 3): x, y, z of each."""
    lengths = np.full(len(frames), style.FRAME_LENGTH * size)
    lengths[[0, -1]] = style.END_LENGTH * size
    ends: Floats = frames[:, None, :3, 3] + lengths[:, None, None] * frames[:, :3, :3].transpose(0, 2, 1)
    return ends


def frame_bodies(frames: Floats, size: float) -> Iterator[Body]:
    """The axes of frames: x and z of those between, y as well of the first and the last."""
    for k, (frame, ends) in enumerate(zip(frames, frame_ends(frames, size), strict=True)):
        outer = k in (0, len(frames) - 1)
        for end, colour in zip(ends, (style.X, style.Y, style.Z), strict=True):
            if outer or colour != style.Y:
                thick = style.ARROW * size * (1.2 if outer else 0.9)
                yield arrow(frame[:3, 3], end, thick, colour, lift=2.0 * style.JOINT_RADIUS * size)


def name_joints(ax: Any, shape: Linkage, posture: Posture, size: float) -> None:
    """The name of each joint, where the picture has room for it."""
    right, up, _ = view(ax)
    screen = np.array([right, up])
    path = posture.path @ screen.T
    # Points along the links and the joints, which no name should cover.
    shares = np.linspace(0.0, 1.0, 12)[:, None, None]
    taken = (path[:-1] + shares * (path[1:] - path[:-1])).reshape(-1, 2)
    half = style.JOINT_LENGTH / 2.0 * size * posture.joints[:, :3, 2] @ screen.T
    middles = posture.joints[:, :3, 3] @ screen.T
    taken = np.concatenate([taken, middles + half, middles - half])
    angles = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    round_about = style.NAME_AWAY * size * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    for name, middle, frame in zip(shape.variables, middles, posture.joints, strict=True):
        gaps = np.linalg.norm((middle + round_about)[:, None] - taken, axis=-1).min(axis=-1)
        best = round_about[int(np.argmax(np.round(gaps / size, 6)))]
        taken = np.concatenate([taken, middle + best + _NAME * size])
        where = frame[:3, 3] + best @ screen
        text = ax.text(*where, name_text(name), fontsize=style.LABEL, color=style.INK, ha="center", va="center")
        text.set(zorder=99, path_effects=[withStroke(linewidth=2.5, foreground="white", alpha=0.8)])
