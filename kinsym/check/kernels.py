"""The numerical kernels in exact arithmetic.

One function a rule of the plan, written from the policy for singular poses and not from the templates, so that a
slip in a template cannot hide behind the same slip here. Each takes the step's inputs by name and returns the
roots in the order of the branches (upper sign first), each with its mark; a root is the tuple of the step's outputs.
``free`` is the value an unknown takes when every value solves its equation. ``loose`` tells that a step before was
marked: a root that is missing by any distance may then exist beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from kinsym.check.marks import NEAR, NONE, Mark
from kinsym.check.pole import linear_pole
from kinsym.check.quartic import angle, quartic

Value = Any
Inputs = Mapping[str, Value]
Root = tuple[Value, ...]
Roots = list[tuple[Root, Mark]]


def direct(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """Cosine and sine are already there."""
    return [((given["c"], given["s"]), NONE)]


def length(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """A prismatic variable is already there."""
    return [((given["d"],), NONE)]


def quotient(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """d c = x and d s = y."""
    x, y, t = given["x"], given["y"], given["t"]
    radius = ctx.sqrt(x * x + y * y)
    if radius <= t:
        return [(angle(ctx, free), Mark.FREE)]
    sign = -1 if given["d"] < 0 else 1
    return [((sign * x / radius, sign * y / radius), _soft(radius, t))]


def quotient_length(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """d x = n for the length x."""
    n, d, t = given["n"], given["d"], given["t"]
    return [((free,), Mark.FREE)] if abs(d) <= t else [((n / d,), _soft(abs(d), t))]


def homogeneous(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """a c + b s = 0: an angle and its opposite."""
    a, b, t = given["a"], given["b"], given["t"]
    radius = ctx.sqrt(a * a + b * b)
    if radius <= t:
        return [(angle(ctx, free), Mark.FREE)]
    soft = _soft(radius, t)
    return [((b / radius, -a / radius), soft), ((-b / radius, a / radius), soft)]


def homogeneous2(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """Two homogeneous equations of one angle: the one that is larger in its own tolerance decides."""
    a, b, t = given["a"], given["b"], given["t"]
    a_alt, b_alt, t_alt = given["a_alt"], given["b_alt"], given["t_alt"]
    if (a_alt**2 + b_alt**2) * t**2 > (a**2 + b**2) * t_alt**2:
        a, b, t = a_alt, b_alt, t_alt
    return homogeneous(ctx, {"a": a, "b": b, "t": t}, free, loose)


def linear(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """a c + b s = e: two angles, one on the border, none beyond it or one in doubt."""
    a, b, e, t = given["a"], given["b"], given["e"], given["t"]
    radius = ctx.sqrt(a * a + b * b)
    room = radius - abs(e)
    if radius <= t:
        return _special(angle(ctx, free), Mark.FREE, abs(e) - t, NEAR * t - t, loose)
    if room <= t:
        sign = -1 if e < 0 else 1
        return _special((sign * a / radius, sign * b / radius), Mark.BORDER, -t - room, NEAR * t - t, loose)
    h = ctx.sqrt(room * (radius + abs(e)))
    square, soft = radius * radius, _soft(room, t)
    return [
        (((a * e - b * h) / square, (b * e + a * h) / square), soft),
        (((a * e + b * h) / square, (b * e - a * h) / square), soft),
    ]


def triangle(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """Two links l1 and l2 reach (x, y): the second seen from the first (k, w), and (x, y) along the first."""
    x, y, l1, l2, t = (given[name] for name in ("x", "y", "l1", "l2", "t"))
    if abs(l1) <= t:
        return []
    square = x * x + y * y
    long, short = abs(l1) + abs(l2), abs(abs(l1) - abs(l2))
    outer, inner = long * long - square, square - short * short

    def within(tolerance: Value) -> tuple[Value, Value]:
        return 2 * long * tolerance, 2 * short * tolerance + tolerance * tolerance

    (t_outer, t_inner), (near_outer, near_inner) = within(t), within(NEAR * t)
    along = (square + (l1 - l2) * (l1 + l2)) / (2 * l1)
    sign = -1 if l1 < 0 else 1
    if outer <= t_outer:
        stretched = (sign * abs(l2), ctx.mpf(0), along)
        return _special(stretched, Mark.BORDER, -t_outer - outer, near_outer - t_outer, loose)
    if inner <= t_inner:
        folded = (-sign * abs(l2), ctx.mpf(0), along)
        return _special(folded, Mark.BORDER, -t_inner - inner, near_inner - t_inner, loose)
    k = (square - l1 * l1 - l2 * l2) / (2 * l1)
    w = ctx.sqrt(outer * inner) / (2 * abs(l1))
    soft = Mark.SOFT if outer <= near_outer or inner <= near_inner else NONE
    return [((k, w, along), soft), ((k, -w, along), soft)]


def direction(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """The angle that turns (along, across) into (x, y)."""
    x, y, along, across, t = (given[name] for name in ("x", "y", "along", "across", "t"))
    cosine, sine = x * along + y * across, y * along - x * across
    radius, distance = ctx.sqrt(cosine * cosine + sine * sine), ctx.sqrt(x * x + y * y)
    if distance <= t or radius == 0:
        return [(angle(ctx, free), Mark.FREE)]
    return [((cosine / radius, sine / radius), _soft(distance, t))]


def quadratic(ctx: Any, given: Inputs, free: Value, loose: bool) -> Roots:
    """d^2 + 2 b d + c = 0."""
    b, t = given["b"], given["t"]
    discriminant = b * b - given["c"]
    if discriminant <= t:
        return _special((-b,), Mark.BORDER, -t - discriminant, NEAR * t - t, loose)
    root, soft = ctx.sqrt(discriminant), _soft(discriminant, t)
    return [((-b + root,), soft), ((-b - root,), soft)]


def _soft(value: Value, tolerance: Value) -> Mark:
    """The mark of a root whose step is special where this value is within the tolerance."""
    return Mark.SOFT if value <= NEAR * tolerance else NONE


def _special(root: Root, mark: Mark, beyond: Value, doubt: Value, loose: bool) -> Roots:
    """The one root of a special case that holds at the pose, or is ``beyond`` the tolerance of it by so much.

    Up to the distance ``doubt``, or anywhere if loose, it is in doubt; farther out there is none.
    """
    if beyond <= 0:
        return [(root, mark)]
    return [(root, mark | Mark.DOUBTFUL)] if loose or beyond <= doubt else []


KERNELS: dict[str, Callable[[Any, Inputs, Value, bool], Roots]] = {
    "direct": direct,
    "length": length,
    "quotient": quotient,
    "quotient_length": quotient_length,
    "homogeneous": homogeneous,
    "homogeneous2": homogeneous2,
    "linear": linear,
    "linear_pole": linear_pole,
    "triangle": triangle,
    "direction": direction,
    "quadratic": quadratic,
    "quartic": quartic,
}
