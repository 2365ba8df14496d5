"""A prismatic variable: linear, a d = b, or quadratic, d^2 + 2 b d + c = 0 (lecture 2.170, d3 of the Stanford arm)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import combinations

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Call, Definition, PlusMinus, Pow, Quot, Tree, opposite, sub
from kinsym.inverse.plan import Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Candidate, Names, Outcome, View, shown, tolerance
from kinsym.inverse.state import State

TITLES = {
    "length": "linear in a prismatic variable",
    "quotient_length": "linear in a prismatic variable, with a factor that can vanish",
    "quadratic": "quadratic in a prismatic variable",
}
LENGTH_COST, QUOTIENT_COST, CRAMER_COST, QUADRATIC_COST = 0, 16, 17, 32


def candidates(view: View) -> Iterator[Candidate]:
    """Equations in one prismatic variable alone; pairs of equations that are linear in the same two."""
    yield from _pairs(view)
    state, ring = view.state, view.state.chain.ring
    for equation in view.of_lengths():
        variable = equation.lengths[0]
        parts: dict[int, Poly] = {key[0]: part for key, part in ring.collect(equation.poly, (variable,)).items()}
        rest: Poly = parts.get(0, ring.zero)
        if set(parts) <= {0, 1} and not state.vanishes(parts[1]):
            constant = ring.is_constant(parts[1])
            build = partial(_linear, state, (equation,), parts[1], rest)
            yield Candidate(LENGTH_COST if constant else QUOTIENT_COST, equation.terms, variable, build)
        elif set(parts) <= {0, 1, 2} and 2 in parts and parts[2].is_ground:
            leading = parts[2].coeff(1)
            middle: Poly = parts.get(1, ring.zero)
            half = middle.quo_ground(2 * leading)
            build = partial(_quadratic, state, equation, half, rest.quo_ground(leading))
            yield Candidate(QUADRATIC_COST, equation.terms, variable, build)


def _pairs(view: View) -> Iterator[Candidate]:
    """Two equations a d + b e + r = 0 in two lengths, from which the second is eliminated (Cramer)."""
    state, ring = view.state, view.state.chain.ring
    forms: list[tuple[PoolEquation, Poly, Poly, Poly]] = []
    for equation in view.of_two_lengths():
        parts = ring.collect(equation.poly, equation.lengths)
        if set(parts) <= {(1, 0), (0, 1), (0, 0)}:
            a, b, rest = (parts.get(key, ring.zero) for key in ((1, 0), (0, 1), (0, 0)))
            forms.append((equation, a, b, rest))
    for (first, a1, b1, r1), (second, a2, b2, r2) in combinations(forms, 2):
        factor = ring.reduce(a1 * b2 - a2 * b1)
        if first.lengths == second.lengths and first.unit == second.unit and not state.vanishes(factor):
            rest = ring.reduce(r1 * b2 - r2 * b1)
            build = partial(_linear, state, (first, second), factor, rest)
            yield Candidate(CRAMER_COST, first.terms + second.terms, first.lengths[0], build)


def _linear(state: State, equations: tuple[PoolEquation, ...], factor: Poly, rest: Poly, names: Names) -> Outcome:
    variable = equations[0].lengths[0]
    definitions: list[Definition] = []
    inputs: dict[str, Tree]
    degenerate = None
    if factor.is_ground:
        rule, value = "length", state.tree((-rest).quo_ground(factor.coeff(1)))
        inputs = {"d": value}
    elif state.chain.ring.is_constant(factor):
        rule, value = "length", Quot(state.tree(-rest), state.tree(factor))
        inputs = {"d": value}
    else:
        rule = "quotient_length"
        below = names.short("mu", state.tree(factor), definitions)
        above = names.short("gamma", state.tree(-rest), definitions)
        value = Quot(above, below)
        inputs = {"n": above, "d": below, "t": tolerance(max(equations[0].unit - 1, 0))}
        degenerate = (below, "=", ZERO)
    step = Step(
        number=names.step(),
        unknown=variable,
        rule=rule,
        equations=tuple(shown(state, equation) for equation in equations),
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(variable,),
        branches=1,
        reference=((variable, 1),),
        solution=((variable, value),),
        condition=None,
        degenerate=degenerate,
        why=(
            "one equation is linear in this length and holds no other unknown"
            if len(equations) == 1
            else "two equations are linear in the same two lengths, of which one is eliminated"
        ),
    )
    return Outcome((step,), state.known.with_length(variable))


def _quadratic(state: State, equation: PoolEquation, half: Poly, rest: Poly, names: Names) -> Outcome:
    variable = equation.lengths[0]
    definitions: list[Definition] = []
    b = names.short("kappa", state.tree(half), definitions)
    c = names.short("kappa", state.tree(rest), definitions)
    square: Tree = ZERO if b == ZERO else Pow(b, 2)
    root = Call("sqrt", (sub(square, c),))
    step = Step(
        number=names.step(),
        unknown=variable,
        rule="quadratic",
        equations=(shown(state, equation),),
        coefficients=tuple(definitions),
        inputs={"b": b, "c": c, "t": tolerance(2)},
        outputs=(variable,),
        branches=2,
        reference=((variable, 1),),
        solution=((variable, PlusMinus(None if b == ZERO else opposite(b), root)),),
        condition=(square, ">=", c),
        degenerate=None,
        why="one equation is quadratic in this length and holds no other unknown",
    )
    return Outcome((step,), state.known.with_length(variable))
