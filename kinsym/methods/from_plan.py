"""The closed form of a plan as a method's derivation: every equation of it, proved by other means than it was made.

The pool of equations proves what it states in the ring or at its own points; here names, windows, coefficients and
formulas are evaluated once more, from the chain's forward kinematics on.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.tree import Call, Definition, Quot, Sym, Tree, symbols
from kinsym.inverse.plan import Plan, Step, Window
from kinsym.inverse.rules import TITLES
from kinsym.methods.document import Equation
from kinsym.methods.draft import Draft
from kinsym.methods.proof import Witness
from kinsym.methods.steps import TWO

_SIZE = 3
"""What stands for a length that may be any."""


def state_plan(draft: Draft, plan: Plan) -> None:
    """State a plan item by item."""
    give_tangents(draft, plan)
    for item in plan.items:
        if isinstance(item, Window):
            joints = f"joints {item.left + 1} to {item.right}" if item.right > item.left + 1 else f"joint {item.right}"
            draft.say(f"`T_{item.left}_{item.right}` is what is left for {joints} to make:")
            for definition in item.definitions:
                _define(draft, definition)
        elif isinstance(item, Definition):
            _define(draft, item)
        else:
            _state_step(draft, item)
    for value in plan.values:
        if value.variable not in {solution.unknown for solution in draft.solutions} and value.value != Sym(
            value.variable
        ):
            draft.solve(value.variable, value.value, branches=1)


def _define(draft: Draft, definition: Definition) -> None:
    """A definition; one of an angle that the joints have already is its solution, and printed there."""
    if definition.name in draft.witnesses[0].angles:
        draft.check(definition.name, Sym(definition.name), definition.value)
    elif not draft.has_stated(Sym(definition.name), definition.value):
        draft.define(definition.name, definition.value)


def _state_step(draft: Draft, step: Step) -> None:
    rule = re.sub(r"a c \+ b s = [0e]", r"`\g<0>`", TITLES.get(step.rule, step.rule))
    why = f" {step.why[:1].upper()}{step.why[1:]}." if step.why else ""
    draft.say(f"Step {step.number}, `{step.unknown}`: {rule}.{why}")
    place = f"step{step.number}"
    for number, part in enumerate(step.equations, start=1):
        if not draft.has_stated(part.lhs, part.rhs):
            draft.state(f"{place}.equation{number}", part.lhs, part.rhs)
    for definition in step.coefficients:
        draft.define(definition.name, definition.value)
    own = [value for name, value in step.solution if name == step.unknown]
    rest = [(name, value) for name, value in step.solution if name != step.unknown]
    for number, (name, value) in enumerate(rest, start=1):
        _give_tangent(draft, step, value)
        label = f"{place}.{name if name != '0' else f'sum{number}'}"
        if name == "0":
            draft.state(label, draft.tree(draft.ring.zero), value)
        elif name in draft.witnesses[0].numbers:
            draft.state(label, Sym(name), value)
        else:
            draft.choose(name, value, _fits(rest[number:]), name=label)
    conditions: list[Equation] = []
    if step.condition is not None:
        left, sign, right = step.condition
        conditions.append(draft.require(f"{place}.real", left, sign, right))
    if step.degenerate is not None:
        left, _, right = step.degenerate
        conditions.append(draft.require(f"{place}.unique", left, "!=", right))
    if own:
        also = own[1] if len(own) > 1 else None
        draft.solve(step.unknown, own[0], branches=step.branches, conditions=conditions, also=also)


def _fits(lines: list[tuple[str, Tree]]) -> Callable[[Witness], bool]:
    """Whether the lines that follow a choice hold, as far as all their names have values."""

    def fits(witness: Witness) -> bool:
        return all(
            witness.numbers[name] in witness.values(value)
            for name, value in lines
            if name in witness.numbers and set(symbols(value)) <= set(witness.numbers)
        )

    return fits


def give_tangents(draft: Draft, plan: Plan) -> None:
    """Values for angles phi that no joint has, by which a plan finds a length: d = size tan(phi/2), size any length."""
    pairs = [
        (first, second)
        for first, second in pairwise(plan.steps)
        if first.unknown not in draft.witnesses[0].angles and "size" in symbols(second.solution[0][1])
    ]
    if pairs:
        draft.say("`size` is a length of the arm's order, in the code the sum of its constant lengths.")
    for first, second in pairs:
        for witness in draft.witnesses:
            witness.numbers["size"] = _SIZE
            slope = witness.numbers[second.unknown] * inverse(_SIZE) % PRIME
            scale = inverse(1 + slope * slope)
            point = (1 - slope * slope) * scale % PRIME, 2 * slope * scale % PRIME
            witness.angles[first.unknown] = point
            witness.numbers.update(zip(first.outputs, point, strict=False))


def _give_tangent(draft: Draft, step: Step, value: Tree) -> None:
    """The tangent u of half the angle, which formulas of higher degree use."""
    label = step.outputs[0][1:]
    name = f"u_{label}"
    if name not in draft.witnesses[0].numbers and step.unknown in draft.witnesses[0].angles:
        draft.give_value(name, Call("tan", (Quot(Sym(step.unknown), TWO),)))
