"""The kernel with up to four roots in exact arithmetic: two vectors of equal length that turn with one angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby, pairwise
from typing import Any, NamedTuple

from kinsym.check.marks import NEAR, NONE, Mark

Value = Any
Inputs = Mapping[str, Value]
Root = tuple[Value, ...]
Line = Sequence[Value]

#: Halvings of an interval before Newton's steps: to 1e-18 of it, far less than roots that are not merged lie apart.
HALVINGS = 60

#: Vectors shorter than so many tolerances turn while a merged root moves within its tolerance.
BRIEF = 1000

#: The rounding of a line in doubles, as a share of what is summed up; of its square it is twice as much.
ROUNDING = 2.25e-16

_SIGNS = (1, 1, -1, -1)


class _Form(NamedTuple):
    """One statement of the equation: its tolerance, its lines in u and how large its polynomial is."""

    tolerance: Value
    lines: Sequence[Line]
    lead: Value


class _Knot(NamedTuple):
    """An end of an interval without a turning point: what a root there is marked with, NONE if it is no root.

    ``ends`` are the roots that stand for it instead where the vectors are short.
    """

    u: Value
    mark: Mark
    soft: bool
    ends: tuple[Value, ...] = ()


def quartic(ctx: Any, given: Inputs, free: Value, loose: bool) -> list[tuple[Root, Mark]]:
    """|(X, Y)| = |(K, L)| for four lines p c + q s + r: the roots in increasing angle, those that meet as one.

    It is stated twice; roots meet if they do so for the lengths in both. Where they meet and the vectors are so short
    that they turn within the tolerance, the ends of what the tolerance merges are roots in doubt. In
    u = tan((angle - turn)/2) the difference of the squares is a polynomial whose leading coefficient is its value at
    turn + pi. Its minima above zero and its maxima below are roots in doubt where they come near to zero; the minima
    anywhere if loose.
    """
    stated = [[[given[name + end + form] for end in ("c", "s", "")] for name in "xykl"] for form in ("", "2")]
    tolerances = (given["t"], given["t2"])
    around = [angle(ctx, k * ctx.pi / 4) for k in range(8)]
    opposite = max(around, key=lambda point: abs(_difference(stated[0], point)))
    x, y = -opposite[0], -opposite[1]
    forms = []
    for lines, tolerance in zip(stated, tolerances, strict=True):
        lead, longest = abs(_difference(lines, opposite)), sum(abs(value) for line in lines[2:] for value in line)
        if lead > tolerance * (2 * longest + tolerance):
            in_u = [(r + p * x + q * y, 2 * (q * x - p * y), r - p * x - q * y) for p, q, r in lines]
            forms.append(_Form(tolerance, in_u, lead))
        elif not forms:
            return [(angle(ctx, free), Mark.FREE)]
    polynomial = _polynomial(ctx, forms[0].lines)
    found = [
        (_turned(u, x, y), mark)
        for u, mark in _real_points(ctx, polynomial, _knots(ctx, polynomial, forms, loose), _bound(polynomial))
    ]
    return sorted(found, key=lambda item: _increasing(ctx, item[0]))


def angle(ctx: Any, value: Value) -> Root:
    """Cosine and sine."""
    return ctx.cos(value), ctx.sin(value)


def _difference(lines: Sequence[Line], point: Root) -> Value:
    c, s = point
    return sum(sign * (p * c + q * s + r) ** 2 for sign, (p, q, r) in zip(_SIGNS, lines, strict=True))


def _polynomial(ctx: Any, lines: Sequence[Line]) -> list[Value]:
    """The signed sum of the squares, constant term first."""
    polynomial = [ctx.mpf(0)] * 5
    for sign, line in zip(_SIGNS, lines, strict=True):
        for i, left in enumerate(line):
            for j, right in enumerate(line):
                polynomial[i + j] += sign * left * right
    return polynomial


def _knots(ctx: Any, polynomial: Sequence[Value], forms: Sequence[_Form], loose: bool) -> list[_Knot]:
    """The turning points of the polynomial over its leading coefficient: minima and maxima by turns."""
    knots = []
    turning, bound = _real_roots(ctx, _slope(polynomial)), _bound(polynomial)
    for number, u in enumerate(turning):
        value = _horner(polynomial, u) / polynomial[-1]
        soft = all(_touches(ctx, form, u, value, NEAR) for form in forms)
        minimum = number % 2 == 0
        if all(_touches(ctx, form, u, value, 1) for form in forms):
            mark = Mark.BORDER
        elif (value > 0) == minimum and (soft or (loose and minimum)):
            mark = Mark.BORDER | Mark.DOUBTFUL
        else:
            mark = NONE
        around = [-bound, *turning, bound][number : number + 3]
        knots.append(_Knot(u, mark, soft, _ends(ctx, polynomial, forms, around) if mark == Mark.BORDER else ()))
    return knots


def _ends(ctx: Any, polynomial: Sequence[Value], forms: Sequence[_Form], around: Sequence[Value]) -> tuple[Value, ...]:
    """The two roots beside a turning point, which is the second of three; () if no vector is short.

    If rounding hides the roots, the points up to which the value has changed by the tolerance. Where a vector vanishes
    the middle is one of these points: the next angle is free there. There are none where more than two roots meet,
    which the curvature says nothing of.
    """
    (low, u, high), bands, least = around, [], ctx.mpf(BRIEF)
    for form in forms:
        width, length = form.tolerance * (1 + u * u), 2 * _length(ctx, form, u)
        bands.append(width * (length + width) / form.lead)
        least = min(least, length / width)
    bend = abs(_horner(_slope(_slope(polynomial)), u) / (2 * polynomial[-1]))
    if least >= BRIEF or not bend:
        return ()
    roots = (*_crossing(ctx, polynomial, low, u), *_crossing(ctx, polynomial, u, high))
    if len(roots) == 2 and abs(_horner(polynomial, u) / polynomial[-1]) > min(_rounding(form, u) for form in forms):
        return roots
    apart = ctx.sqrt(min(bands) / bend)
    if any(abs(_horner(polynomial, u + side * apart) / polynomial[-1]) > 4 * min(bands) for side in (-1, 1)):
        return ()
    return (u - apart if least > 1 else u, u + apart)


def _rounding(form: _Form, u: Value) -> Value:
    """How much of the value of a form at u the rounding of its lines hides, over the leading coefficient."""
    values = [(_horner(line, u), sum(abs(part * u**k) for k, part in enumerate(line))) for line in form.lines]
    return sum(2 * ROUNDING * abs(value) * size for value, size in values) / form.lead


def _length(ctx: Any, form: _Form, u: Value) -> Value:
    """The length of the second vector."""
    return ctx.sqrt(sum(_horner(line, u) ** 2 for line in form.lines[2:]))


def _touches(ctx: Any, form: _Form, u: Value, value: Value, tolerances: int) -> bool:
    """Whether a value is zero as far as a change of the lengths by so many tolerances can tell."""
    width = tolerances * form.tolerance * (1 + u * u)
    return bool(abs(value) * form.lead <= width * (2 * _length(ctx, form, u) + width))


def _real_points(
    ctx: Any, polynomial: Sequence[Value], knots: Sequence[_Knot], bound: Value
) -> list[tuple[Value, Mark]]:
    """The roots in u: each run of turning points that are roots is one, in its middle; the others lie between.

    A turning point alone may stand for both ends of what the tolerance merges.
    """
    found = []
    for touching, group in groupby(knots, key=lambda knot: knot.mark != NONE):
        run = list(group)
        if touching and len(run) == 1 and run[0].ends:
            found += [(end, Mark.SOFT | Mark.DOUBTFUL) for end in run[0].ends]
        elif touching:
            doubt = Mark.DOUBTFUL if any(Mark.DOUBTFUL in knot.mark for knot in run) else NONE
            found.append(((run[0].u + run[-1].u) / 2, Mark.BORDER | doubt))
    for low, high in pairwise([_Knot(-bound, NONE, False), *knots, _Knot(bound, NONE, False)]):
        if low.mark == high.mark == NONE:
            mark = Mark.SOFT if low.soft or high.soft else NONE
            found += [(u, mark) for u in _crossing(ctx, polynomial, low.u, high.u)]
    return found


def _turned(u: Value, x: Value, y: Value) -> Root:
    """Cosine and sine of the angle at u, seen from the turn (x, y)."""
    p, q, w = 1 - u * u, 2 * u, 1 + u * u
    return (x * p - y * q) / w, (y * p + x * q) / w


def _increasing(ctx: Any, root: Root) -> Value:
    """The angle in (-pi, pi]; next to -pi it counts as pi, so that rounding decides no order."""
    value = ctx.atan2(root[1], root[0])
    return ctx.pi if value < -ctx.pi + ctx.mpf(10) ** -10 else value


def _horner(polynomial: Sequence[Value], u: Value) -> Value:
    """The value of a polynomial, constant term first."""
    total = 0
    for coefficient in reversed(polynomial):
        total = total * u + coefficient
    return total


def _slope(polynomial: Sequence[Value]) -> list[Value]:
    """The derivative."""
    return [k * coefficient for k, coefficient in enumerate(polynomial)][1:]


def _bound(polynomial: Sequence[Value]) -> Value:
    """No root is farther from 0 than this (Cauchy)."""
    return 1 + max(abs(coefficient / polynomial[-1]) for coefficient in polynomial[:-1])


def _real_roots(ctx: Any, polynomial: Sequence[Value]) -> list[Value]:
    """The real roots at which a polynomial changes its sign, by those of its derivative."""
    if len(polynomial) == 2:
        return [-polynomial[0] / polynomial[1]]
    knots = _real_roots(ctx, _slope(polynomial))
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
    slope = _slope(polynomial)
    root = (low + high) / 2
    for _ in range(3):
        below = _horner(slope, root)
        step = _horner(polynomial, root) / below if below else ctx.mpf(0)
        if abs(step) > high - low:
            break
        root -= step
    return [root]
