"""What the search could choose from at every step of a finished plan: the same search once more, along the plan.

The search is deterministic and looks at nothing but the state, so walking from state to state by the steps of the plan
meets the candidates that it met. Candidates that were cheaper and are not in the plan led nowhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from kinsym.inverse.plan import Plan, Step
from kinsym.inverse.rules.base import Candidate, Names, Outcome
from kinsym.inverse.search import spun_start, stages
from kinsym.inverse.state import State, shortened, start
from kinsym.kinematics.chain import Chain


@dataclass(frozen=True, kw_only=True)
class Choice:
    """One candidate: how it would begin, its cost and, of equal cost, its terms, and whether the plan took it."""

    unknown: str
    rule: str
    branches: int
    cost: int
    terms: int
    taken: bool


def choices(chain: Chain, plan: Plan) -> dict[int, tuple[Choice, ...]]:
    """The candidates by the number of the step that was then taken, the cheapest first.

    A step that comes with the one before it, as the direction of a triangle's first link does, was not chosen and has
    no entry. ``chain`` holds the joints that are solved for.
    """
    state, _ = start(chain, plan.task)
    found = _walked(state, Names(set(chain.ring.index)), plan.steps)
    if found is None:
        found = _walked(*spun_start(chain)[:2], plan.steps)
    return found or {}


def _walked(state: State, names: Names, steps: Sequence[Step]) -> dict[int, tuple[Choice, ...]] | None:
    """The candidates along the steps; None where these are not the steps of this search."""
    found: dict[int, tuple[Choice, ...]] = {}
    place = 0
    while True:
        while (step := shortened(state)) is not None:
            state = step[0]
        if place == len(steps):
            return found
        met = _met(state, names, steps[place:])
        if met is None:
            return None
        outcome, found[steps[place].number] = met
        place += _common(outcome, steps[place:])
        state = replace(state, known=outcome.known)


def _met(state: State, names: Names, steps: Sequence[Step]) -> tuple[Outcome, tuple[Choice, ...]] | None:
    """What the first of the steps comes from, and all candidates up to the stage in which it is found."""
    seen: set[tuple[int, str]] = set()
    taken: Outcome | None = None
    found: list[Choice] = []
    for rules, view in stages(state):
        candidates = sorted((c for rule in rules for c in rule.candidates(view)), key=lambda c: c.order)
        for candidate in candidates:
            if (candidate.cost, candidate.unknown) in seen:
                continue
            seen.add((candidate.cost, candidate.unknown))
            outcome = candidate.build(Names(set(names.taken), dict(names.counts), names.steps))
            same = taken is None and _common(outcome, steps) > 0
            taken = outcome if same else taken
            found.append(_choice(candidate, outcome, same))
        if taken is not None:
            return taken, tuple(found)
    return None


def _choice(candidate: Candidate, outcome: Outcome, taken: bool) -> Choice:
    first, *others = (item for item in outcome.items if isinstance(item, Step))
    branches = first.branches
    for other in others:
        branches *= other.branches
    return Choice(
        unknown=candidate.unknown,
        rule=first.rule,
        branches=branches,
        cost=candidate.cost,
        terms=candidate.terms,
        taken=taken,
    )


def _common(outcome: Outcome, steps: Sequence[Step]) -> int:
    """How many steps an outcome begins the steps with; 0 if it is another way. Steps that nobody reads are left out."""
    own = [_mark(item) for item in outcome.items if isinstance(item, Step)]
    marks = [_mark(step) for step in steps[: len(own)]]
    used = [mark for mark in own if mark in marks]
    return len(used) if used and used == marks[: len(used)] else 0


def _mark(step: Step) -> tuple[object, ...]:
    return step.unknown, step.rule, tuple(equation.source for equation in step.equations)
