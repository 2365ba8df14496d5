"""The singular set against the numbers of the Jacobian; and that a wrong factor is found out."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from kinsym.algebra.tree import Num, Sym, mul
from kinsym.check.evaluate import compiled, floating
from kinsym.check.ledger import Ledger
from kinsym.check.poses import draws, generator, lengths_of, uniform
from kinsym.check.report import FAILED
from kinsym.check.singular_set import DETERMINANT_LAW, ZERO_LAW, hold_singular_set
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from tests.arms import NAMES, derivation, robot


def outcome(schedule: Schedule, name: str) -> dict[str, Any]:
    """The laws by name: how many cases were tried and how many failed."""
    (parameters, *_) = draws(schedule.parameters, lengths_of(robot(name)), schedule.digest, 1)
    target: Any = TreeKinematics(schedule, parameters)
    target.name = "trees"
    revolute = np.array([joint.kind == "R" for joint in schedule.joints])
    starts = uniform(revolute, max(target.size, 1.0), 40, generator(schedule.digest, 0))
    for item in schedule.held:
        if item.name in schedule.locked:
            starts[:, schedule.solution.index(item.name)] = compiled(item.value, floating())({})
    ledger = Ledger()
    hold_singular_set(ledger, target, schedule, parameters, starts)
    return {check.law: check for check in ledger.checks()}


@pytest.mark.parametrize("name", NAMES)
def test_the_jacobian_has_the_determinant_and_the_zeros_that_are_printed(name: str) -> None:
    laws = outcome(build_schedule(derivation(name)), name)
    singular = derivation(name).singular
    assert not any(check.status == FAILED for check in laws.values()), laws
    assert (DETERMINANT_LAW in laws) is singular.square
    assert (ZERO_LAW in laws) is bool(singular.listed)


@pytest.mark.parametrize("name", ["puma560", "ur5", "stanford_paul", "scorbot_5r"])
def test_a_wrong_product_and_a_wrong_zero_are_found_out(name: str) -> None:
    schedule = build_schedule(derivation(name))
    assert schedule.singular is not None
    first, *others = schedule.singular.set.conditions
    moved = replace(first, values=tuple(mul(Sym("c1"), Num(Fraction(2))) for _ in first.values))
    conditions = (moved, *others)
    angles = {definition.name: definition for definition in schedule.forward.definitions}
    wrong = replace(
        schedule.singular,
        set=replace(schedule.singular.set, conditions=conditions),
        angles=(*schedule.singular.angles, angles["c1"]),
    )
    laws = outcome(replace(schedule, singular=wrong), name)
    assert laws[ZERO_LAW].failed > 0
    assert not schedule.singular.set.square or laws[DETERMINANT_LAW].failed == laws[DETERMINANT_LAW].tried
