"""Two equations whose squares add up to one in a single angle (Pieper 1968; the lecture's r and z).

    X = k1 c + k2 s          k1, k2, X, Y linear in (c_y, s_y) of another angle y
    Y = k1 s - k2 c          c, s of the angle x

give X^2 + Y^2 = k1^2 + k2^2, of degree two in (c_y, s_y), and then (c, s) without a choice. In Pieper's solution x is
theta2, y is theta3, X = (r - k3)/(2 a1) with r the squared distance of the wrist and Y = (z - k4)/s alpha1.

Where the wrist lies on axis 2 both vectors vanish, and the equation in y is known from their lengths alone. Where it
lies on axis 1 the same holds for the elimination of theta1, which gives the same equation in y: the kernel gets both.
Without another elimination the second statement is that of :mod:`kinsym.inverse.rules.complement`, if there is one.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import permutations

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ONE, Definition, Pow, Quot, Sym, Tree, add, mul, sub
from kinsym.inverse.plan import Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Candidate, Names, Outcome, View, angle_value, divided, edge, shown
from kinsym.inverse.rules.complement import complement
from kinsym.inverse.rules.squares import Terms, difference, error_of, quartic_inputs, total, turn_step
from kinsym.inverse.rules.turned_pair import (
    Eliminant,
    Line,
    Pair,
    eliminant_of,
    own_vector,
    promising,
    proportional,
    shared_points,
    turned_form,
    turned_pair,
)
from kinsym.kinematics.angles import Angle

TITLES = {"quartic": "square and add, then the half-angle polynomial of degree four"}
COST, OTHER_COST = 60, 61
"""Pieper's own elimination, k1 and k2 of the arm and of y alone, stays regular where the wrist lies on axis 2."""


def candidates(view: View) -> Iterator[Candidate]:
    """Pairs of equations in the same two angles, either of which may be the one that is turned."""
    state = view.state
    families: dict[tuple[str, ...], list[PoolEquation]] = {}
    for equation in view.equations:
        if len(equation.angles) == 2 and not equation.lengths:
            families.setdefault(tuple(sorted(a.label for a in equation.angles)), []).append(equation)
    points = shared_points(state)
    found: list[tuple[Angle, Pair, Eliminant]] = []
    for family in families.values():
        angles = family[0].angles
        for turned, other in (angles, angles[::-1]):
            forms = [form for equation in family if (form := turned_form(state, equation, turned, points))]
            for first, second in permutations(forms, 2):
                state.deadline.check()
                if first.equation.unit == second.equation.unit == 0 and not state.overdetermined:
                    continue
                pair = turned_pair(state, turned, other, first, second) if promising(first, second) else None
                if pair is not None and any(map(any, eliminant := eliminant_of(state, pair))):
                    found.append((other, pair, eliminant))
    for other, pair, eliminant in found:
        others = [
            second
            for _, second, same in found
            if (second.other, second.turned) != (pair.other, pair.turned)
            and second.other == pair.other
            and proportional(eliminant, same)
        ]
        again = min(others, key=lambda second: second.terms, default=None)
        cost = COST if own_vector(state.chain.ring, pair) else OTHER_COST
        yield Candidate(cost, pair.terms, other.name, partial(_build, view, other, pair, again))


def _build(view: View, other: Angle, pair: Pair, again: Pair | None, names: Names) -> Outcome:
    state, rest = view.state, None if again else complement(view, pair)
    again = again or rest or pair
    definitions: list[Definition] = []

    named: dict[Tree, Tree] = {}

    def coefficient(stem: str, tree: Tree) -> Tree:
        if tree not in named:
            named[tree] = names.short(stem, tree, definitions)
        return named[tree]

    def line(parts: Line, scale: Poly) -> Terms:
        stems = zip(("mu", "nu", "gamma"), parts, strict=True)
        p, q, r = (coefficient(stem, divided(state, part, scale)) for stem, part in stems)
        return p, q, r

    def form(stated: Pair) -> list[Terms]:
        k1, k2 = (line(part, state.chain.ring.one) for part in (stated.k1, stated.k2))
        x, y = (line(side.rest, side.scale) for side in stated.sides)
        return [x, y, k1, k2]

    vectors = form(pair)
    second = vectors if again is pair else form(again)
    error = error_of(state, pair)
    equations = tuple(dict.fromkeys(shown(state, equation) for equation in (*pair.equations, *again.equations)))
    turned = pair.turned
    c, s = Sym(other.cosine), Sym(other.sine)
    lines, other_lines = ([total([mul(p, c), mul(q, s), r]) for p, q, r in part] for part in (vectors, second))
    statements = [difference(lines), *([difference(other_lines)] if again is not pair else [])]
    twice = "; stated twice, as each keeps its digits where the vectors of the other vanish"
    if rest:
        twice = "; stated twice, as what is left of a unit vector keeps its digits where that component is next to 1"
    # The rest of a unit vector keeps more digits than the vector everywhere, so that it comes first.
    first, last = ("2", "") if rest else ("", "2")
    inputs = {**quartic_inputs(vectors, error, first), **quartic_inputs(second, error_of(state, again), last)}
    step = Step(
        number=names.step(),
        unknown=other.name,
        rule="quartic",
        equations=equations,
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(other.cosine, other.sine),
        branches=4,
        reference=other.terms,
        solution=(*(("0", statement) for statement in statements), *_half_angle(other)),
        condition=None,
        degenerate=None,
        why=f"the squares of the two equations add up to one without {turned.name}, "
        f"a polynomial of degree four in the tangent of half the angle{twice if again is not pair else ''}",
    )
    values: list[Definition] = []
    sides = [names.short("kappa", line, values) for line in lines]
    follow = turn_step(names, turned, sides, error=error, equations=equations)
    known = state.known.with_angle(edge(other)).with_angle(edge(turned))
    return Outcome((step, angle_value(other), *values, follow, angle_value(turned)), known)


def _half_angle(angle: Angle) -> tuple[tuple[str, Tree], ...]:
    """Cosine and sine by the tangent u of half the angle (the lecture's reduction to a polynomial)."""
    u = Sym(f"u_{angle.label}")
    below = add(ONE, Pow(u, 2))
    return (
        (angle.cosine, Quot(sub(ONE, Pow(u, 2)), below)),
        (angle.sine, Quot(mul(number(2), u), below)),
        (angle.name, angle_value(angle).value),
    )
