"""The arm as a drawing, before any script runs: what ``templates/html/drawing.js`` draws first, element by element.

Everything is projected along parallel lines; what is nearer to the viewer is drawn later. Joints that turn are
cylinders, joints that slide are boxes, links run along the common normals (:mod:`kinsym.skeleton`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.skeleton import Linkage, Posture

WIDTH, HEIGHT = 640, 480
"""The drawing's own units."""
AZIMUTH, ELEVATION = -0.9, 0.42
"""From where an arm in space is seen, radians."""
COLOURS = 8
"""Solutions beyond so many begin with the first colour again."""

_FILLED = 0.74
_TURN_RADIUS, _TURN_HALF = 9.5, 12.0
_BOX = (9.0, 9.0, 15.0)
_INNER, _OUTER = 24.0, 44.0
_SHORTEST = 1e-6
_EDGE_ON = 0.02

Point = Any
"""Three numbers, an array of them or a tuple."""


@dataclass(frozen=True, kw_only=True)
class View:
    """From where the arm is seen, radians; ``centre`` lies in the middle, ``scale`` is units of the drawing a length.

    ``plane`` are the two coordinates of the floor.
    """

    azimuth: float
    elevation: float
    centre: tuple[float, float, float]
    scale: float
    plane: tuple[int, int]

    @property
    def axes(self) -> tuple[Point, Point, Point]:
        """The directions to the right, up and towards the viewer."""
        ca, sa = math.cos(self.azimuth), math.sin(self.azimuth)
        ce, se = math.cos(self.elevation), math.sin(self.elevation)
        return (-sa, ca, 0.0), (-se * ca, -se * sa, ce), (ce * ca, ce * sa, se)

    def seen(self, point: Point) -> tuple[float, float, float]:
        """Right and down in the drawing, and how near."""
        right, up, towards = self.axes
        offset = [float(value) - middle for value, middle in zip(point, self.centre, strict=True)]
        x, y, depth = (_dot(offset, axis) for axis in (right, up, towards))
        return WIDTH / 2 + self.scale * x, HEIGHT / 2 - self.scale * y, depth

    def direction(self, way: Point) -> tuple[float, float, float]:
        """The same of a direction."""
        right, up, towards = self.axes
        return _dot(way, right), -_dot(way, up), _dot(way, towards)


def view_of(shape: Linkage, paths: Sequence[Floats]) -> View:
    """The view that shows all of some arms, given by the corners of their links (k, 3), as large as there is room."""
    angles = {(0, 1): (-math.pi / 2, math.pi / 2), (0, 2): (-math.pi / 2, 0.0), (1, 2): (0.0, 0.0)}
    azimuth, elevation = angles[shape.plane] if shape.plane else (AZIMUTH, ELEVATION)
    unit = View(azimuth=azimuth, elevation=elevation, centre=(0.0, 0.0, 0.0), scale=1.0, plane=shape.plane or (0, 1))
    points = [tuple(map(float, point)) for path in paths for point in path]
    ends = [(min(values), max(values)) for values in zip(*(_along(point, unit.axes) for point in points), strict=True)]
    wide, high = (top - low for low, top in ends[:2])
    scale = min(_FILLED * WIDTH / wide if wide else math.inf, _FILLED * HEIGHT / high if high else math.inf)
    middles = [(low + top) / 2 for low, top in ends]
    centre = [round(sum(middles[k] * unit.axes[k][i] for k in range(3)), 6) + 0.0 for i in range(3)]
    return replace(
        unit,
        centre=(centre[0], centre[1], centre[2]),
        scale=float(f"{scale if math.isfinite(scale) else WIDTH / shape.size:.6g}"),
    )


def _along(point: Point, axes: Sequence[Point]) -> tuple[float, ...]:
    return tuple(_dot(point, axis) for axis in axes)


def grid_step(view: View) -> float:
    """The distance of two lines of the floor: 1, 2 or 5 times a power of ten.

    >>> grid_step(View(azimuth=0, elevation=0, centre=(0, 0, 0), scale=200.0, plane=(0, 1)))
    0.5
    """
    least = 90 / view.scale
    power = 10.0 ** math.floor(math.log10(least))
    step = next((factor * power for factor in (1, 2, 5) if factor * power >= least), 10 * power)
    return float(f"{step:.3g}")


def drawing(shape: Linkage, posture: Posture, others: Sequence[tuple[int, Floats]], view: View) -> str:
    """The elements of the drawing; ``others`` are the solutions beside it, each its number and its corners (k, 3)."""
    solid = sorted((*_links(shape, posture, view), *_joints(shape, posture, view)), key=lambda item: item[0])
    ghosts = (_ghost(*other, view) for other in others)
    return "".join((*_floor(posture, view), *ghosts, *(element for _, element in solid), *_frames(posture, view)))


def _floor(posture: Posture, view: View) -> Iterator[str]:
    """A grid through the base."""
    step, count = grid_step(view), 6
    base = [float(value) for value in posture.frames[0][:3, 3]]
    for along, across in (view.plane, view.plane[::-1]):
        for k in range(-count, count + 1):
            start, end = list(base), list(base)
            start[across] += k * step
            end[across] += k * step
            start[along] -= count * step
            end[along] += count * step
            yield f'<path class="floor" d="{_line(view.seen(start), view.seen(end))}"/>'


def _ghost(number: int, path: Floats, view: View) -> str:
    points = "L".join(_at(*view.seen(point)[:2]) for point in path)
    return f'<path class="ghost c{number % COLOURS}" data-branch="{number}" d="M{points}"/>'


def _links(shape: Linkage, posture: Posture, view: View) -> Iterator[tuple[float, str]]:
    path = posture.path
    for k in range(len(path) - 1):
        if math.dist(path[k], path[k + 1]) <= _SHORTEST * shape.size:
            continue
        start, end = view.seen(path[k]), view.seen(path[k + 1])
        sliding = k % 2 == 1 and k < len(path) - 2 and shape.kinds[k // 2] == "P"
        line = _line(start, end)
        name = "rod" if sliding else "link"
        yield _depth(start, end), f'<path class="edge {name}" d="{line}"/><path class="{name}" d="{line}"/>'


def _joints(shape: Linkage, posture: Posture, view: View) -> Iterator[tuple[float, str]]:
    for number, (kind, frame) in enumerate(zip(shape.kinds, posture.joints, strict=True)):
        middle = view.seen(frame[:3, 3])
        body = _cylinder(frame[:3, 2], middle, view) if kind == "R" else _box(frame, middle, view)
        yield _depth(middle, middle), f'<g class="joint" data-joint="{number}">{body}</g>'


def _cylinder(axis: Point, middle: Point, view: View) -> str:
    x, y, near = view.direction(axis)
    length = math.hypot(x, y)
    along, across = ((x / length, y / length), (-y / length, x / length)) if length > _SHORTEST else ((1, 0), (0, 1))
    half, wide, flat = _TURN_HALF * length, _TURN_RADIUS, _TURN_RADIUS * abs(near)
    turned = round(math.degrees(math.atan2(across[1], across[0])))

    def corner(end: int, side: int) -> str:
        return _at(
            middle[0] + end * half * along[0] + side * wide * across[0],
            middle[1] + end * half * along[1] + side * wide * across[1],
        )

    arc = f"A{wide:.1f} {flat:.1f} {turned} 0 0 "
    outline = f"M{corner(-1, 1)}L{corner(1, 1)}{arc}{corner(1, -1)}L{corner(-1, -1)}{arc}{corner(-1, 1)}Z"
    end = 1 if near > 0 else -1
    place = _at(middle[0] + end * half * along[0], middle[1] + end * half * along[1])
    cap = f'<ellipse class="cap" rx="{wide:.1f}" ry="{flat:.1f}" transform="translate({place})rotate({turned})"/>'
    return f'<path class="turn" d="{outline}"/>{cap}'


def _box(frame: Floats, middle: Point, view: View) -> str:
    ways = [view.direction(frame[:3, axis]) for axis in range(3)]
    faces = []
    for axis in range(3):
        if abs(ways[axis][2]) <= _EDGE_ON:
            continue
        sign = 1 if ways[axis][2] > 0 else -1
        first, second = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            shares = {axis: sign * _BOX[axis], first: a * _BOX[first], second: b * _BOX[second]}
            x, y = (middle[i] + sum(shares[k] * ways[k][i] for k in range(3)) for i in range(2))
            corners.append(_at(x, y))
        faces.append(f'<path class="slide face{axis}" d="M{"L".join(corners)}Z"/>')
    return "".join(faces)


def _frames(posture: Posture, view: View) -> Iterator[str]:
    """The axes of the table's frames, over all else; those of the first and the last are longer and have letters."""
    last = len(posture.frames) - 1
    for number, frame in enumerate(posture.frames):
        outer = number in (0, last)
        origin = view.seen(frame[:3, 3])
        length = _OUTER if outer else _INNER
        for axis, letter in enumerate("xyz"):
            x, y, _ = view.direction(frame[:3, axis])
            end = (origin[0] + length * x, origin[1] + length * y)
            name = f"axis {letter}" if outer else f"axis inner {letter}"
            element = f'<path class="{name}" d="{_line(origin, end)}"/>'
            if outer:
                place = f'x="{origin[0] + 1.22 * length * x:.1f}" y="{origin[1] + 1.22 * length * y:.1f}"'
                element += f'<text class="letter {letter}" {place}>{letter}</text>'
            yield element


def _dot(a: Point, b: Point) -> float:
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def _depth(start: Point, end: Point) -> float:
    """How near the middle of two points is, rounded so that ties are ties on every machine."""
    return round(float(start[2] + end[2]) / 2, 6)


def _at(x: float, y: float) -> str:
    return f"{x:.1f} {y:.1f}"


def _line(start: Point, end: Point) -> str:
    return f"M{_at(*start[:2])}L{_at(*end[:2])}"
