"""Every equation of the pool holds for every pose the arm can make, at every moment of the derivation."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kinsym.inverse.pool import Pool
from kinsym.inverse.rules.base import Names
from kinsym.inverse.search import ranked
from kinsym.inverse.state import State, shortened, start
from kinsym.kinematics.chain import build_chain
from kinsym.robot.model import Task
from tests.arms import NAMES, derivation


def moments(name: str) -> list[State]:
    """The states that the search goes through."""
    found = derivation(name)
    state, _ = start(found.solved, found.plan.task)
    names = Names(set(found.solved.ring.index))
    states = [state]
    while state.known.unknowns():
        state = replace(state, known=next(ranked(state)).build(names).known)
        while (step := shortened(state)) is not None:
            state = step[0]
        states.append(state)
    return states


@pytest.mark.parametrize("name", NAMES)
def test_every_equation_vanishes_on_the_variety(name: str) -> None:
    count = 0
    for state in moments(name):
        pool = Pool(state)
        for cut in pool.cuts():
            for equation in pool.equations(cut):
                assert state.vanishes(equation.poly), equation.source
                count += 1
    assert count > 0


@pytest.mark.parametrize("name", ["puma560", "scara", "gantry_wrist", "stanford_paul"])
def test_the_order_in_which_cuts_are_asked_changes_nothing(name: str) -> None:
    """They share their vectors, whoever makes them first."""
    states = moments(name)
    for state in states:
        forward, backward = Pool(state), Pool(state)
        asked = [list(forward.equations(cut)) for cut in forward.cuts()]
        reverse = [list(backward.equations(cut)) for cut in reversed(backward.cuts())]
        assert asked == reverse[::-1]
        assert any(asked) or state is states[-1]


def test_a_wrong_sign_is_seen() -> None:
    found = derivation("puma560")
    state, _ = start(found.chain, found.plan.task)
    pool = Pool(state)
    for cut in pool.cuts():
        for equation in pool.equations(cut):
            if equation.lhs and equation.rhs:
                assert not state.vanishes(equation.lhs + equation.rhs), equation.source


def test_a_position_task_never_reads_the_orientation() -> None:
    chain = build_chain(derivation("elbow_rrr").robot)
    state, _ = start(chain, Task.POSITION)
    pool = Pool(state)
    for cut in pool.cuts():
        for equation in pool.equations(cut):
            used = {*chain.ring.used(equation.lhs), *chain.ring.used(equation.rhs)}
            assert not any(name[0] in "uvw" and name[1] == "_" for name in used)
