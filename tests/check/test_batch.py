"""The check finds what is wrong in the batch functions of the C alone."""

from __future__ import annotations

import pytest

from kinsym.check.batch import SINGLE_FORWARD_LAW, SINGLE_LAW
from kinsym.check.compare import compare
from kinsym.check.report import FAILED
from kinsym.check.sources import COMPILE
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests.arms import derivation, robot
from tests.emit.built import needs_compiler

NAME = "planar_rr"
FAULTS = {
    "nothing": ("planar_rr_ik_batch", "planar_rr_ik_batch", set()),
    "a joint value": ("[path][0][k] = theta1;", "[path][0][k] = theta1 + 1e-9;", {SINGLE_LAW}),
    "a branch lost": ("block->solved[path + 1][k] = real1", "block->solved[path + 1][k] = 0.0", {SINGLE_LAW}),
    "marks not heeded": ("block.marked[k] <= 0.0", "block.marked[k] <= 9.0", {SINGLE_LAW}),
    "no pose answered": ("block.real[k] > 0.0 && ", "", {SINGLE_LAW}),
    "the last block": ("k < n ? k : n - 1", "k < n - 1 ? k : 0", {SINGLE_LAW}),
    "how many are reached": ("reached += count > 0;", "reached -= count > 0;", {SINGLE_LAW}),
    "forward kinematics": ("block->T[3][k] = ", "block->T[3][k] = 1e-11 + ", {SINGLE_FORWARD_LAW}),
    "a function gone": ("planar_rr_fk_batch", "planar_rr_fk_many", {COMPILE}),
}


@needs_compiler
@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.usefixtures("few_poses")
def test_faults_are_found(fault: str) -> None:
    old, new, laws = FAULTS[fault]
    schedule = build_schedule(derivation(NAME))
    sources = {name: text.replace(old, new) for name, text in TARGETS["c"](schedule).items()}
    assert old in "".join(TARGETS["c"](schedule).values())
    findings = compare(robot(NAME), schedule, sources)
    assert {check.law for check in findings.checks if check.status == FAILED} == laws
