"""Two equations linear in the cosine and sine of one angle (lecture 2.90, 2.91; Cramer's rule with mu, nu, gamma).

If the determinant is constant the pair is read off and nothing can vanish: ``direct``. Otherwise ``quotient``: the
angle is free where the determinant is zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import combinations

from kinsym.algebra.field import PRIME
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Definition, Quot, Tree, add, mul, sub, sum_of_squares
from kinsym.inverse.plan import Step
from kinsym.inverse.rules.base import (
    Candidate,
    LinearForm,
    Names,
    Outcome,
    View,
    angle_value,
    divided,
    edge,
    shown,
    tolerance,
)
from kinsym.inverse.rules.turned_pair import shared_points
from kinsym.inverse.state import State

TITLES = {
    "direct": "cosine and sine given directly",
    "quotient": "cosine and sine from two linear equations",
}
DIRECT_COST, ROTATION_COST, QUOTIENT_COST, SPARE_COST = 0, 15, 18, 29
"""A pair a c + b s, -b c + a s has the determinant a^2 + b^2, which vanishes least. Where equations are to spare, other
pairs give way to rules that branch: what they use a second time, the final sifting needs once."""
WIDEST = 14
"""How many of the shortest equations of an angle are paired."""


def candidates(view: View) -> Iterator[Candidate]:
    """Pairs of linear forms in one angle whose determinant does not vanish."""
    state = view.state
    points = (*state.samples, shared_points(state)[1])
    for forms in view.linear.values():
        known = [(form, _values(state, form, points)) for form in forms[:WIDEST]]
        # Of pairs that are equally short an orientation comes before a position, which a length near zero makes small.
        pairs = sorted(combinations(known, 2), key=lambda pair: pair[0][0].equation.unit + pair[1][0].equation.unit)
        for (first, at_first), (second, at_second) in pairs:
            state.deadline.check()
            found = [(a * d - b * c) % PRIME for (a, b), (c, d) in zip(at_first, at_second, strict=True)]
            *determinants, again = found
            if not any(determinants):
                continue
            terms = first.terms + second.terms
            sign = 1 if set(determinants) == {1} else -1 if set(determinants) == {PRIME - 1} else 0
            constant = None
            if sign:
                constant = state.chain.ring.one * sign
            elif again == determinants[0]:
                # The same at two points that share the constants: worth a product in the ring.
                constant = _cross(state, first.a, first.b, second.a, second.b)
            if constant is not None and state.chain.ring.is_constant(constant):
                build = partial(_direct, state, first, second, constant)
            else:
                build = partial(_quotient, state, first, second)
            yield Candidate(_cost(state, first, second, build.func is _direct), terms, first.angle.name, build)


def _values(state: State, form: LinearForm, points: Sequence[Mapping[str, int]]) -> list[tuple[int, int]]:
    """The coefficients a and b of an equation at points modulo the prime."""
    ring = state.chain.ring
    return [(ring.evaluate(form.a, point), ring.evaluate(form.b, point)) for point in points]


def _cost(state: State, first: LinearForm, second: LinearForm, direct: bool) -> int:
    if direct:
        return DIRECT_COST
    if _turned(first, second):
        return ROTATION_COST
    return SPARE_COST if state.overdetermined else QUOTIENT_COST


def _turned(first: LinearForm, second: LinearForm) -> bool:
    """Whether the second left side is the first a quarter turn on, up to its sign."""
    return (second.a, second.b) in ((-first.b, first.a), (first.b, -first.a))


def _cross(state: State, a: Poly, b: Poly, c: Poly, d: Poly) -> Poly:
    """``a*d - b*c``."""
    ring = state.chain.ring
    return ring.mul(a, d) - ring.mul(b, c)


def _direct(state: State, first: LinearForm, second: LinearForm, determinant: Poly, names: Names) -> Outcome:
    angle = first.angle
    c = divided(state, _cross(state, first.e, first.b, second.e, second.b), determinant)
    s = divided(state, _cross(state, first.a, first.e, second.a, second.e), determinant)
    value = angle_value(angle)
    step = Step(
        number=names.step(),
        unknown=angle.name,
        rule="direct",
        equations=(shown(state, first.equation), shown(state, second.equation)),
        coefficients=(),
        inputs={"c": c, "s": s},
        outputs=(angle.cosine, angle.sine),
        branches=1,
        reference=angle.terms,
        solution=((angle.cosine, c), (angle.sine, s), (angle.name, value.value)),
        condition=None,
        degenerate=None,
        why="both follow from known quantities without a division that can vanish",
    )
    return Outcome((step, value), state.known.with_angle(edge(angle)))


def _quotient(state: State, first: LinearForm, second: LinearForm, names: Names) -> Outcome:
    angle = first.angle
    definitions: list[Definition] = []

    def coefficient(stem: str, poly: Poly) -> Tree:
        return names.short(stem, state.tree(poly), definitions)

    mu1, nu1, gamma1 = coefficient("mu", first.a), coefficient("nu", first.b), coefficient("gamma", first.e)
    if _turned(first, second):
        # Numerators and determinant are products of two quantities, both small where the angle is free.
        gamma2 = coefficient("gamma", second.e)
        d = sum_of_squares(*(part for part in (mu1, nu1) if part != ZERO))
        (x1, x2), (y1, y2) = (mul(mu1, gamma1), mul(nu1, gamma2)), (mul(nu1, gamma1), mul(mu1, gamma2))
        forward = (second.a, second.b) == (-first.b, first.a)
        x, y = (sub(x1, x2), add(y1, y2)) if forward else (add(x1, x2), sub(y1, y2))
        t = mul(tolerance(first.equation.unit), tolerance(second.equation.unit))
    else:
        mu2, nu2, gamma2 = coefficient("mu", second.a), coefficient("nu", second.b), coefficient("gamma", second.e)
        d = sub(mul(mu1, nu2), mul(mu2, nu1))
        x, y = sub(mul(gamma1, nu2), mul(gamma2, nu1)), sub(mul(mu1, gamma2), mul(mu2, gamma1))
        t = tolerance(first.equation.unit + second.equation.unit)
    value = angle_value(angle)
    step = Step(
        number=names.step(),
        unknown=angle.name,
        rule="quotient",
        equations=(shown(state, first.equation), shown(state, second.equation)),
        coefficients=tuple(definitions),
        inputs={"x": x, "y": y, "d": d, "t": t},
        outputs=(angle.cosine, angle.sine),
        branches=1,
        reference=angle.terms,
        solution=(
            (angle.cosine, Quot(x, d)),
            (angle.sine, Quot(y, d)),
            (angle.name, value.value),
        ),
        condition=None,
        degenerate=(d, "=", ZERO),
        why="two equations are linear in the cosine and sine of this angle alone (Cramer's rule)",
    )
    return Outcome((step, value), state.known.with_angle(edge(angle)))
