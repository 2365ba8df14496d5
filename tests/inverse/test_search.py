"""The search for a plan: it ends soon where there is none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

from kinsym.errors import NoClosedForm
from kinsym.inverse import search
from kinsym.inverse.state import State
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline
from kinsym.robot.model import Task

#: A made-up arm whose two slides can be put into hundreds of equations with hundreds of terms.
SLIDES = "pi/3 a1 d1 pi/2; pi/3 a2 l2 theta2; deg(-30) a3 d3 0; -pi/4 a4 l4 theta4; 0 a5 l5 theta5"  # alpha a d theta


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
        search.derive_plan(chain, Task.POSITION_AXIS)
    assert len(visits) > 2
    assert set(visits.values()) == {1}
    assert longest < 300
