"""The numerical kernels in exact arithmetic.

One function a rule of the plan, written from the policy for singular poses and not from the templates, so that a
slip in a template cannot hide behind the same slip here. Each takes the step's inputs by name and returns the
roots in the order of the branches (upper sign first); a root is the tuple of the step's outputs. ``free`` is the
value an unknown takes when every value solves its equation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Any

from kinsym.check.pole import linear_pole

Value = Any
Inputs = Mapping[str, Value]
Root = tuple[Value, ...]

#: Halvings of an interval before Newton's steps: to 1e-18 of it, far less than roots that are not merged lie apart.
HALVINGS = 60


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


def quartic(ctx: Any, given: Inputs, free: Value) -> list[Root]:
    """|(X, Y)| = |(K, L)| for four lines p c + q s + r: the roots in increasing angle, those that meet as one.

    It is stated twice; roots meet if they do so for the lengths in both. In u = tan((angle - turn)/2) the
    difference of the squares is a polynomial whose leading coefficient is its value at turn + pi.
    """
    t = given["t"]
    lines, others = ([[given[name + end + form] for end in ("c", "s", "")] for name in "xykl"] for form in ("", "2"))
    signs = (1, 1, -1, -1)

    def difference(form: Sequence[Sequence[Value]], point: Root) -> Value:
        c, s = point
        return sum(sign * (p * c + q * s + r) ** 2 for sign, (p, q, r) in zip(signs, form, strict=True))

    around = [_angle(ctx, k * ctx.pi / 4) for k in range(8)]
    longest = sum(abs(value) for line in lines[2:] for value in line)
    if max(abs(difference(lines, point)) for point in around) <= t * (2 * longest + t):
        return [_angle(ctx, free)]
    opposite = max(around, key=lambda point: abs(difference(lines, point)))
    x, y = -opposite[0], -opposite[1]
    forms = [(t, lines, abs(difference(lines, opposite)))]
    second, longest = abs(difference(others, opposite)), sum(abs(value) for line in others[2:] for value in line)
    if second > given["t2"] * (2 * longest + given["t2"]):
        forms.append((given["t2"], others, second))

    def by_half_angle(form: Sequence[Sequence[Value]]) -> list[tuple[Value, ...]]:
        return [(r + p * x + q * y, 2 * (q * x - p * y), r - p * x - q * y) for p, q, r in form]

    polynomial = [ctx.mpf(0)] * 5
    for sign, line in zip(signs, by_half_angle(lines), strict=True):
        for i, left in enumerate(line):
            for j, right in enumerate(line):
                polynomial[i + j] += sign * left * right

    def touch(u: Value) -> bool:
        value = abs(_horner(polynomial, u) / polynomial[-1])
        for tolerance, form, lead in forms:
            width = tolerance * (1 + u * u)
            reach = ctx.sqrt(sum(_horner(line, u) ** 2 for line in by_half_angle(form)[2:]))
            if value * lead > width * (2 * reach + width):
                return False
        return True

    knots = _real_roots(ctx, [k * coefficient for k, coefficient in enumerate(polynomial)][1:])
    touching = [touch(u) for u in knots]
    found: list[Value] = []
    run: list[Value] = []
    for u, touches in zip(knots, touching, strict=True):
        if touches:
            run.append(u)
        elif run:
            found.append((run[0] + run[-1]) / 2)
            run = []
    if run:
        found.append((run[0] + run[-1]) / 2)
    bound = _bound(polynomial)
    marks = [(-bound, False), *zip(knots, touching, strict=True), (bound, False)]
    for (low, low_touches), (high, high_touches) in pairwise(marks):
        if not low_touches and not high_touches:
            found += _crossing(ctx, polynomial, low, high)

    points = [(1 - u * u, 2 * u, 1 + u * u) for u in found]
    roots = [((x * p - y * q) / w, (y * p + x * q) / w) for p, q, w in points]
    return sorted(roots, key=lambda root: _increasing(ctx, root))


def _increasing(ctx: Any, root: Root) -> Value:
    """The angle in (-pi, pi]; next to -pi it counts as pi, so that rounding decides no order."""
    angle = ctx.atan2(root[1], root[0])
    return ctx.pi if angle < -ctx.pi + ctx.mpf(10) ** -10 else angle


def _horner(polynomial: Sequence[Value], u: Value) -> Value:
    """The value of a polynomial, constant term first."""
    total = 0
    for coefficient in reversed(polynomial):
        total = total * u + coefficient
    return total


def _bound(polynomial: Sequence[Value]) -> Value:
    """No root is farther from 0 than this (Cauchy)."""
    return 1 + max(abs(coefficient / polynomial[-1]) for coefficient in polynomial[:-1])


def _real_roots(ctx: Any, polynomial: Sequence[Value]) -> list[Value]:
    """The real roots at which a polynomial changes its sign, by those of its derivative."""
    if len(polynomial) == 2:
        return [-polynomial[0] / polynomial[1]]
    knots = _real_roots(ctx, [k * coefficient for k, coefficient in enumerate(polynomial)][1:])
    bound = _bound(polynomial)
    return [root for low, high in pairwise([-bound, *knots, bound]) for root in _crossing(ctx, polynomial, low, high)]


def _crossing(ctx: Any, polynomial: Sequence[Value], low: Value, high: Value) -> list[Value]:
    """The root between two points if the sign differs: halving to eighteen digits, then Newton's steps."""
    rises = _horner(polynomial, high) > 0
    if rises == (_horner(polynomial, low) > 0):
        return []
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if (_horner(polynomial, middle) > 0) == rises else (middle, high)
    slope = [k * coefficient for k, coefficient in enumerate(polynomial)][1:]
    root = (low + high) / 2
    for _ in range(3):
        below = _horner(slope, root)
        step = _horner(polynomial, root) / below if below else ctx.mpf(0)
        if abs(step) > high - low:
            break
        root -= step
    return [root]


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
    "linear_pole": linear_pole,
    "triangle": triangle,
    "direction": direction,
    "quadratic": quadratic,
    "quartic": quartic,
}
