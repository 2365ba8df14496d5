"""One linear equation a c + b s = e: two angles, mirrored at Atan2(b, a) (lecture 2.86, the half-angle substitution).

There is no real solution where a^2 + b^2 < e^2, one double solution on that border, and the angle is free where
a = b = e = 0. The root is taken of (r - |e|)(r + |e|) with r = sqrt(a^2 + b^2), which keeps its digits at the border.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from kinsym.algebra.tree import ZERO, Call, Definition, PlusMinus, sub, sum_of_squares
from kinsym.inverse.plan import Step
from kinsym.inverse.rules.base import (
    Candidate,
    LinearForm,
    Names,
    Outcome,
    View,
    angle_value,
    edge,
    shown,
    tolerance,
)
from kinsym.inverse.state import State

TITLES = {"linear": "one linear equation a c + b s = e"}
COST = 30


def candidates(view: View) -> Iterator[Candidate]:
    """Linear forms with a right side that does not vanish."""
    for forms in view.linear.values():
        for form in forms:
            if not view.state.vanishes(form.e):
                yield Candidate(
                    COST + form.equation.unit, form.terms, form.angle.name, partial(_build, view.state, form)
                )


def _build(state: State, form: LinearForm, names: Names) -> Outcome:
    angle = form.angle
    definitions: list[Definition] = []
    a = names.short("kappa", state.tree(form.a), definitions)
    b = names.short("kappa", state.tree(form.b), definitions)
    e = names.short("kappa", state.tree(form.e), definitions)
    radius = sum_of_squares(a, b)
    fixed = state.chain.ring.is_constant(form.e)
    root = Call("sqrt", (sub(radius, sum_of_squares(e)),))
    step = Step(
        number=names.step(),
        unknown=angle.name,
        rule="linear",
        equations=(shown(state, form.equation),),
        coefficients=tuple(definitions),
        inputs={"a": a, "b": b, "e": e, "t": tolerance(form.equation.unit)},
        outputs=(angle.cosine, angle.sine),
        branches=2,
        reference=angle.terms,
        solution=((angle.name, PlusMinus(Call("atan2", (b, a)), Call("atan2", (root, e)))),),
        condition=(radius, ">=", sum_of_squares(e)),
        degenerate=None if fixed else (sum_of_squares(a, b, e), "=", ZERO),
        why="one equation holds this angle alone",
    )
    return Outcome((step, angle_value(angle)), state.known.with_angle(edge(angle)))
