"""The kernel of a linear equation whose border is a pole, in exact arithmetic; see :mod:`kinsym.check.kernels`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kinsym.check.marks import NEAR, NONE, Mark


def linear_pole(ctx: Any, given: Mapping[str, Any], free: Any, loose: bool) -> list[tuple[tuple[Any, ...], Mark]]:
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
        return [((ca, sa), Mark.BORDER)]
    room = 2 * abs(p) - away
    if room <= t:
        within, near = room >= -t, room >= -NEAR * t
        mark = Mark.BORDER if within else Mark.BORDER | Mark.DOUBTFUL
        return [((-ca, -sa), mark)] if near or loose else []
    half_sine, half_cosine = ctx.sqrt(away / (2 * abs(p))), ctx.sqrt(room / (2 * abs(p)))
    cosine, sine = half_cosine**2 - half_sine**2, 2 * half_sine * half_cosine
    mark = Mark.SOFT if room <= NEAR * t or (x > 0 and across <= NEAR * t) else NONE
    return [((ca * cosine - sa * sign * sine, sa * cosine + ca * sign * sine), mark) for sign in (1, -1)]
