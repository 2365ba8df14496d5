"""The kernel of a linear equation whose border is a pole, in exact arithmetic; see :mod:`kinsym.check.kernels`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def linear_pole(ctx: Any, given: Mapping[str, Any], free: Any) -> list[tuple[Any, ...]]:
    """a c + b s = e with e = p - sign(p) k (1 - x): by half the angle between (c, s) and (a, b)/p.

    With delta that angle, 2 |p| sin(delta/2)^2 = k (1 - x), and (1 - x)(1 + x) = y^2 + z^2.
    """
    a, b, p, k, x, t = (given[name] for name in ("a", "b", "p", "k", "x", "t"))
    across = ctx.sqrt(given["y"] ** 2 + given["z"] ** 2)
    if abs(p) <= t:
        return []
    away = k * (across**2 / (1 + x) if x > 0 else 1 - x)
    ca, sa = a / p, b / p
    if x > 0 and across <= t:
        return [(ca, sa)]
    room = 2 * abs(p) - away
    if room < -t:
        return []
    if room <= t:
        return [(-ca, -sa)]
    half_sine, half_cosine = ctx.sqrt(away / (2 * abs(p))), ctx.sqrt(room / (2 * abs(p)))
    cosine, sine = half_cosine**2 - half_sine**2, 2 * half_sine * half_cosine
    return [(ca * cosine - sa * sign * sine, sa * cosine + ca * sign * sine) for sign in (1, -1)]
