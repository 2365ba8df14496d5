"""One homogeneous equation a c + b s = 0: two angles, half a turn apart (lecture 2.84, theta1 of the Fanuc arm).

The angle is free where a = b = 0. An arm with fewer joints than the pose has equations often states the same angle
twice; the second statement then takes over where the first one vanishes.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import partial

from kinsym.algebra.field import PRIME
from kinsym.algebra.ring import POSE_ENTRIES
from kinsym.algebra.tree import ZERO, Call, Definition, Tree, negative, opposite, sum_of_squares
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

TITLES = {
    "homogeneous": "homogeneous equation a c + b s = 0",
    "homogeneous2": "homogeneous equation a c + b s = 0, stated twice",
}
COST = 20


def candidates(view: View) -> Iterator[Candidate]:
    """Linear forms whose right side vanishes for every pose of the arm."""
    state = view.state
    for forms in view.linear.values():
        vanishing = [form for form in forms if state.vanishes(form.e)]
        for form in vanishing:
            others = [other for other in vanishing if _independent(state, form, other)]
            yield Candidate(COST, form.terms, form.angle.name, partial(_build, state, form, others[:1]))


def _independent(state: State, first: LinearForm, second: LinearForm) -> bool:
    """Whether two statements of an angle differ for poses that the arm cannot make."""
    if not state.overdetermined or not state.oriented:
        return False
    ring, generator = state.chain.ring, random.Random("poses")
    values = {**state.samples[0], **{entry: generator.randrange(PRIME) for entry in POSE_ENTRIES}}
    a, b, c, d = (ring.evaluate(poly, values) for poly in (first.a, first.b, second.a, second.b))
    return (a * d - b * c) % PRIME != 0


def _build(state: State, form: LinearForm, others: list[LinearForm], names: Names) -> Outcome:
    angle = form.angle
    definitions: list[Definition] = []
    sign = -1 if reads_better_negated(state.tree(form.a), state.tree(form.b)) else 1
    a = names.short("kappa", state.tree(form.a * sign), definitions)
    b = names.short("kappa", state.tree(form.b * sign), definitions)
    inputs: dict[str, Tree] = {"a": a, "b": b, "t": tolerance(form.equation.unit)}
    equations = [shown(state, form.equation)]
    for other in others:
        inputs["a_alt"] = names.short("kappa", state.tree(other.a * sign), definitions)
        inputs["b_alt"] = names.short("kappa", state.tree(other.b * sign), definitions)
        inputs["t_alt"] = tolerance(other.equation.unit)
        equations.append(shown(state, other.equation))
    step = Step(
        number=names.step(),
        unknown=angle.name,
        rule="homogeneous2" if others else "homogeneous",
        equations=tuple(equations),
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(angle.cosine, angle.sine),
        branches=2,
        reference=angle.terms,
        solution=(
            (angle.name, Call("atan2", (opposite(a), b))),
            (angle.name, Call("atan2", (a, opposite(b)))),
        ),
        condition=None,
        degenerate=(sum_of_squares(a, b), "=", ZERO),
        why="one equation holds this angle alone and has no constant term",
    )
    return Outcome((step, angle_value(angle)), state.known.with_angle(edge(angle)))


def reads_better_negated(a: Tree, b: Tree) -> bool:
    """Whether Atan2(a, -b) has fewer signs than Atan2(-a, b): it then comes first."""
    return negative(b) or (b == ZERO and not negative(a))
