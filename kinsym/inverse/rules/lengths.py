"""A prismatic variable: linear, a d = b, or quadratic, d^2 + 2 b d + c = 0 (lecture 2.170, d3 of the Stanford arm)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Call, Definition, PlusMinus, Pow, Quot, Tree, opposite, sub
from kinsym.inverse.plan import Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Candidate, Names, Outcome, View, divided, shown, tolerance
from kinsym.inverse.rules.tangent import by_tangent
from kinsym.inverse.state import State

TITLES = {
    "length": "linear in a prismatic variable",
    "quotient_length": "linear in a prismatic variable, with a factor that can vanish",
    "quadratic": "quadratic in a prismatic variable",
}
LENGTH_COST, QUOTIENT_COST, QUADRATIC_COST, TANGENT_COST = 0, 16, 32, 57


def candidates(view: View) -> Iterator[Candidate]:
    """Equations in one prismatic variable alone."""
    state, ring = view.state, view.state.chain.ring
    for equation in view.of_lengths():
        variable = equation.lengths[0]
        parts: dict[int, Poly] = {key[0]: part for key, part in ring.collect(equation.poly, (variable,)).items()}
        rest: Poly = parts.get(0, ring.zero)
        if set(parts) <= {0, 1} and not state.vanishes(parts[1]):
            constant = ring.is_constant(parts[1])
            build = partial(_linear, state, equation, parts[1], rest)
            yield Candidate(LENGTH_COST if constant else QUOTIENT_COST, equation.terms, variable, build)
        elif 2 in parts and set(parts) <= {0, 1, 2} and not state.vanishes(parts[2]):
            middle: Poly = parts.get(1, ring.zero)
            constant = ring.is_constant(parts[2])
            build = partial(
                _quadratic if constant else _tangent, state, equation, (parts[2], middle.quo_ground(2), rest)
            )
            yield Candidate(QUADRATIC_COST if constant else TANGENT_COST, equation.terms, variable, build)


def _linear(state: State, equation: PoolEquation, factor: Poly, rest: Poly, names: Names) -> Outcome:
    variable = equation.lengths[0]
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
        inputs = {"n": above, "d": below, "t": tolerance(max(equation.unit - 1, 0))}
        degenerate = (below, "=", ZERO)
    step = Step(
        number=names.step(),
        unknown=variable,
        rule=rule,
        equations=(shown(state, equation),),
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(variable,),
        branches=1,
        reference=((variable, 1),),
        solution=((variable, value),),
        condition=None,
        degenerate=degenerate,
        why="one equation is linear in this length and holds no other unknown",
    )
    return Outcome((step,), state.known.with_length(variable))


def _quadratic(state: State, equation: PoolEquation, parts: tuple[Poly, Poly, Poly], names: Names) -> Outcome:
    variable = equation.lengths[0]
    definitions: list[Definition] = []
    leading, half, rest = parts
    b = names.short("kappa", divided(state, half, leading), definitions)
    c = names.short("kappa", divided(state, rest, leading), definitions)
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


def _tangent(state: State, equation: PoolEquation, parts: tuple[Poly, Poly, Poly], names: Names) -> Outcome:
    variable = equation.lengths[0]
    a2, a1, a0 = (state.tree(part) for part in parts)
    why = "one equation holds no other unknown"
    steps = by_tangent(names, variable, (a2, a1, a0), (shown(state, equation),), why)
    return Outcome(steps, state.known.with_length(variable))
