"""The numerical kernels in exact arithmetic.

One function a rule of the plan, written from the policy for singular poses and not from the templates, so that a
slip in a template cannot hide behind the same slip here. Each takes the step's inputs by name and returns the
roots in the order of the branches (upper sign first); a root is the tuple of the step's outputs. ``free`` is the
value an unknown takes when every value solves its equation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

Value = Any
Inputs = Mapping[str, Value]
Root = tuple[Value, ...]


def direct(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """Cosine and sine are already there."""
    return [(given["c"], given["s"])]


def length(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """A prismatic variable is already there."""
    return [(given["d"],)]


def quotient(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """d c = x and d s = y."""
    x, y = given["x"], given["y"]
    radius = ctx.sqrt(x * x + y * y)
    if radius <= given["t"]:
        return [_angle(ctx, free)]
    sign = -1 if given["d"] < 0 else 1
    return [(sign * x / radius, sign * y / radius)]


def quotient_length(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """d x = n for the length x."""
    return [(free,)] if abs(given["d"]) <= given["t"] else [(given["n"] / given["d"],)]


def homogeneous(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """a c + b s = 0: an angle and its opposite."""
    a, b = given["a"], given["b"]
    radius = ctx.sqrt(a * a + b * b)
    if radius <= given["t"]:
        return [_angle(ctx, free)]
    return [(b / radius, -a / radius), (-b / radius, a / radius)]


def homogeneous2(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """Two homogeneous equations of one angle: the one that is larger in its own tolerance decides."""
    pairs = [(given["a"], given["b"], given["t"]), (given["a_alt"], given["b_alt"], given["t_alt"])]
    sizes = [(a * a + b * b) / (t * t) for a, b, t in pairs]
    a, b, t = pairs[1] if sizes[1] > sizes[0] else pairs[0]
    return homogeneous(ctx, {"a": a, "b": b, "t": t}, free)


def linear(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """a c + b s = e: two angles, one on the border, none beyond."""
    a, b, e, t = given["a"], given["b"], given["e"], given["t"]
    radius = ctx.sqrt(a * a + b * b)
    room = radius - abs(e)
    if radius <= t:
        return [_angle(ctx, free)] if abs(e) <= t else []
    if room < -t:
        return []
    if room <= t:
        sign = -1 if e < 0 else 1
        return [(sign * a / radius, sign * b / radius)]
    h = ctx.sqrt(room * (radius + abs(e)))
    square = radius * radius
    return [((a * e - b * h) / square, (b * e + a * h) / square), ((a * e + b * h) / square, (b * e - a * h) / square)]


def triangle(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """Two links l1 and l2 reach (x, y): the second seen from the first (k, w), and (x, y) along the first."""
    x, y, l1, l2, t = (given[name] for name in ("x", "y", "l1", "l2", "t"))
    if abs(l1) <= t:
        return []
    square = x * x + y * y
    long, short = abs(l1) + abs(l2), abs(abs(l1) - abs(l2))
    outer, inner = long * long - square, square - short * short
    t_outer, t_inner = 2 * long * t, 2 * short * t + t * t
    along = (square + (l1 - l2) * (l1 + l2)) / (2 * l1)
    if outer < -t_outer or inner < -t_inner:
        return []
    sign = -1 if l1 < 0 else 1
    if outer <= t_outer:
        return [(sign * abs(l2), ctx.mpf(0), along)]
    if inner <= t_inner:
        return [(-sign * abs(l2), ctx.mpf(0), along)]
    k = (square - l1 * l1 - l2 * l2) / (2 * l1)
    w = ctx.sqrt(outer * inner) / (2 * abs(l1))
    return [(k, w, along), (k, -w, along)]


def direction(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """The angle that turns (along, across) into (x, y)."""
    x, y, along, across, t = (given[name] for name in ("x", "y", "along", "across", "t"))
    cosine, sine = x * along + y * across, y * along - x * across
    radius = ctx.sqrt(cosine * cosine + sine * sine)
    if x * x + y * y <= t * t or radius == 0:
        return [_angle(ctx, free)]
    return [(cosine / radius, sine / radius)]


def quadratic(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """d^2 + 2 b d + c = 0."""
    b, t = given["b"], given["t"]
    discriminant = b * b - given["c"]
    if discriminant < -t:
        return []
    if discriminant <= t:
        return [(-b,)]
    root = ctx.sqrt(discriminant)
    return [(-b + root,), (-b - root,)]


def _angle(ctx: Any, value: Value) -> Root:
    return ctx.cos(value), ctx.sin(value)


KERNELS: dict[str, Callable[[Any, Inputs, Value], list[Root]]] = {
    "direct": direct,
    "length": length,
    "quotient": quotient,
    "quotient_length": quotient_length,
    "homogeneous": homogeneous,
    "homogeneous2": homogeneous2,
    "linear": linear,
    "triangle": triangle,
    "direction": direction,
    "quadratic": quadratic,
}
