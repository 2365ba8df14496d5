"""The search stays within its budget of states, and ends soon where there is no plan."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

from kinsym.errors import NoClosedForm
from kinsym.inverse import search
from kinsym.inverse.rules.base import Candidate, Names, Outcome
from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import State, start
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline
from kinsym.robot.model import Task
from tests.arms import derivation, robot

# Candidates on the way of each arm: one for every unknown, but two angles of a triangle or a quartic come together.
NEEDED = {"planar_rr": 1, "planar_rrr_paul": 2, "puma560": 5, "fanuc_s900w": 5, "ur5": 5, "gantry_wrist": 6}

#: A made-up arm whose two slides can be put into hundreds of equations with hundreds of terms: alpha a d theta.
SLIDES = "pi/3 a1 d1 pi/2; pi/3 a2 l2 theta2; deg(-30) a3 d3 0; -pi/4 a4 l4 theta4; 0 a5 l5 theta5"


@pytest.mark.parametrize("name", NEEDED)
def test_an_arm_needs_as_many_states_as_its_way_has_and_not_one_less(name: str) -> None:
    plan, chain = derivation(name).plan, build_chain(robot(name))
    assert derive_plan(chain, plan.task, budget=NEEDED[name]) == plan
    with pytest.raises(NoClosedForm):
        derive_plan(chain, plan.task, budget=NEEDED[name] - 1)


def test_a_dead_end_is_looked_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    visits: Counter[tuple[object, ...]] = Counter()
    longest = 0
    stages = search.stages

    def watched(state: State) -> Iterator[Any]:
        nonlocal longest
        visits[len(state.chain.joints), state.first, state.end, state.known.edges, state.known.lengths] += 1
        for rules, view in stages(state):
            longest = max(longest, *(len(equation.poly) for equation in view.equations))
            yield rules, view

    monkeypatch.setattr(search, "stages", watched)
    chain = build_chain(from_inline(SLIDES, convention="paul", name="arm"))
    with pytest.raises(NoClosedForm, match="d1, d3, theta5"):
        derive_plan(chain, Task.POSITION_AXIS)
    assert len(visits) > 2
    assert set(visits.values()) == {1}
    assert longest < 300


@pytest.mark.parametrize(("led_by", "tried"), [(None, [0, 1, 2]), (0, [0]), (1, [0, 1]), (2, [0, 1, 2])])
def test_three_candidates_of_a_state_are_tried_one_after_the_other(
    monkeypatch: pytest.MonkeyPatch, led_by: int | None, tried: list[int]
) -> None:
    """Until one of them leads to a plan; where none does the search is back at the state."""
    state, _ = start(build_chain(robot("three_slides")), Task.POSITION)
    built: list[int] = []

    def candidate(number: int) -> Candidate:
        def build(names: Names) -> Outcome:
            built.append(number)
            known = state.known.with_length("d1")
            for other in ("d2", "d3") if number == led_by else (f"none{number}",):
                known = known.with_length(other)
            return Outcome((), known)

        return Candidate(number, 0, "d1", build)

    monkeypatch.setattr(search, "ranked", lambda here: iter(map(candidate, range(5))) if here == state else iter(()))
    found = search._Search(100).run(state, Names(set()), ())
    assert built == tried
    assert (found is None) == (led_by is None)
