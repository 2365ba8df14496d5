"""Two or three prismatic variables that enter as many equations linearly, all angles known (Cramer's rule).

The directions of the slides are known then; the equations are rows of one position equation, and their determinant
vanishes only where the directions lie in a plane (three) or are parallel as seen in the two rows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import combinations

from kinsym.algebra.ring import Poly, Ring
from kinsym.algebra.tree import ZERO, Definition, Quot, Tree
from kinsym.inverse.plan import Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Candidate, Names, Outcome, View, shown, tolerance
from kinsym.inverse.state import State

TITLES: dict[str, str] = {}
CONSTANT_COST, QUOTIENT_COST = 2, 19
WIDEST = 9
"""How many of the shortest equations are combined."""


@dataclass(frozen=True)
class Row:
    """``sum of factors times lengths = right``."""

    factors: tuple[Poly, ...]
    right: Poly
    equation: PoolEquation


def candidates(view: View) -> Iterator[Candidate]:
    """As many equations as there are lengths in them."""
    state, ring = view.state, view.state.chain.ring
    families: dict[tuple[str, ...], list[PoolEquation]] = {}
    for equation in view.of_slides():
        families.setdefault(tuple(sorted(equation.lengths)), []).append(equation)
    for lengths in families:
        members = [e for other, family in families.items() if set(other) <= set(lengths) for e in family]
        members.sort(key=lambda e: e.terms)
        rows = [row for e in members[:WIDEST] if (row := _row(ring, e, lengths)) is not None]
        for chosen in combinations(rows, len(lengths)):
            state.deadline.check()
            below = _determinant(ring, [row.factors for row in chosen])
            if state.vanishes(below):
                continue
            terms = sum(row.equation.terms for row in chosen)
            cost = CONSTANT_COST if ring.is_constant(below) else QUOTIENT_COST
            yield Candidate(cost, terms, lengths[0], partial(_build, state, lengths, chosen, below))


def _row(ring: Ring, equation: PoolEquation, lengths: tuple[str, ...]) -> Row | None:
    units = [tuple(int(i == j) for j in range(len(lengths))) for i in range(len(lengths))]
    zero = (0,) * len(lengths)
    parts = ring.collect(equation.poly, lengths)
    if not set(parts) <= {*units, zero}:
        return None
    right: Poly = parts.get(zero, ring.zero)
    return Row(tuple(parts.get(unit, ring.zero) for unit in units), -right, equation)


def _determinant(ring: Ring, rows: list[tuple[Poly, ...]]) -> Poly:
    """The determinant of a matrix of one to three rows."""
    if len(rows) == 1:
        return rows[0][0]
    total = ring.zero
    for i, row in enumerate(rows):
        minor = [other[1:] for j, other in enumerate(rows) if j != i]
        total += ring.mul(row[0], _determinant(ring, minor)) * (-1) ** i
    return total


def _build(state: State, lengths: tuple[str, ...], rows: tuple[Row, ...], below: Poly, names: Names) -> Outcome:
    ring, variable = state.chain.ring, lengths[0]
    above = _determinant(ring, [(row.right, *row.factors[1:]) for row in rows])
    definitions: list[Definition] = []
    inputs: dict[str, Tree]
    degenerate = None
    if ring.is_constant(below):
        rule, value = "length", _quotient(state, above, below)
        inputs = {"d": value}
    else:
        rule = "quotient_length"
        numerator = names.short("gamma", state.tree(above), definitions)
        denominator = names.short("mu", state.tree(below), definitions)
        value = Quot(numerator, denominator)
        inputs = {"n": numerator, "d": denominator, "t": tolerance(0)}
        degenerate = (denominator, "=", ZERO)
    step = Step(
        number=names.step(),
        unknown=variable,
        rule=rule,
        equations=tuple(shown(state, row.equation) for row in rows),
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(variable,),
        branches=1,
        reference=((variable, 1),),
        solution=((variable, value),),
        condition=None,
        degenerate=degenerate,
        why=f"these equations are linear in {', '.join(lengths)} and hold no other unknown (Cramer's rule)",
    )
    return Outcome((step,), state.known.with_length(variable))


def _quotient(state: State, above: Poly, below: Poly) -> Tree:
    if below.is_ground:
        return state.tree(above.quo_ground(below.coeff(1)))
    return Quot(state.tree(above), state.tree(below))
