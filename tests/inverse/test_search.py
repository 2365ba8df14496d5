"""The search stays within its budget of states, and says how far it came."""

from __future__ import annotations

import pytest

from kinsym.errors import NoClosedForm
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import build_chain
from tests.arms import derivation, robot

# Candidates on the way of each arm: one for every unknown, but two angles of a triangle or a quartic come together.
NEEDED = {"planar_rr": 1, "planar_rrr_paul": 2, "puma560": 5, "fanuc_s900w": 5, "ur5": 5, "gantry_wrist": 6}


@pytest.mark.parametrize("name", NEEDED)
def test_an_arm_needs_as_many_states_as_its_way_has_and_not_one_less(name: str) -> None:
    plan, chain = derivation(name).plan, build_chain(robot(name))
    assert derive_plan(chain, plan.task, budget=NEEDED[name]) == plan
    with pytest.raises(NoClosedForm):
        derive_plan(chain, plan.task, budget=NEEDED[name] - 1)
