"""The checks on arms with locked joints: they pass, and they see what is wrong there."""

from __future__ import annotations

import json

import numpy as np
import pytest

from kinsym.check.answers import FOUND_LAW, INVERSE_LAW
from kinsym.check.batch import SWEEP_LAW
from kinsym.check.compare import compare
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.examination import Examination
from kinsym.check.ledger import Ledger
from kinsym.check.poses import Counts
from kinsym.check.report import FAILED
from kinsym.check.reporting import report_of
from kinsym.check.walk import ExactWalk
from kinsym.command.rendering import rendered
from kinsym.emit.program import build_schedule
from tests.arms import derivation

FEW = Counts(uniform=40, quarter=20, singular=24, pair=0)


@pytest.mark.parametrize("name", ["panda", "rail_and_elbow", "screw", "screw_slide", "five_left", "four_parallel_held"])
def test_every_law_is_kept(name: str) -> None:
    found = derivation(name)
    schedule = build_schedule(found)
    findings = compare(found.robot, schedule, rendered(found, schedule, ("numpy", "c")))
    assert [check for check in findings.checks if check.status == FAILED] == []
    assert findings.figures["poses_by_kind"]["uniform"] >= 600
    swept = [check for check in findings.checks if check.law == SWEEP_LAW]
    assert bool(swept) == bool(schedule.inputs)


def examination(name: str) -> Examination:
    """The examination of an arm, not yet run."""
    found = derivation(name)
    schedule = build_schedule(found)
    values = {parameter.name: parameter.value for parameter in schedule.parameters if parameter.value is not None}
    return Examination(
        robot=found.robot, schedule=schedule, parameters=values, number=0, counts=FEW, targets=[], ledger=Ledger()
    )


def test_samples_stand_where_a_joint_is_held() -> None:
    """An input takes any value, a joint held at one that value; singular samples lose a motion of the free joints."""
    held, given = examination("panda_held"), examination("panda")
    assert (held.q[:, 6] == np.pi / 4).all()
    assert np.ptp(given.q[:, 6]) > 3.0
    for one in (held, given):
        exact = one.samples.of("singular") & (one.samples.offset == 0.0)
        assert exact.sum() > 0
        heights = one._volume(one.q)
        assert heights[exact].max() < 1e-7 * np.median(heights[one.samples.of("uniform")])


def test_two_branches_are_not_joined_by_moving_the_locked_joint() -> None:
    """The elbow turns freely round a circle, but not while theta3 is locked: its two places are two solutions."""
    one = examination("kuka_iiwa")
    q, count = one.exact.inverse(one.poses[:1], one.q[:1])
    assert count[0] == 8
    assert one.judge.joined(q[:, :1], q[:, :1], one.poses[:1]).all()
    assert not one.judge.joined(q[:, :1].repeat(7, axis=1), q[:, 1:], one.poses[:1]).any()


def test_the_exact_walk_takes_locked_values_from_the_reference() -> None:
    schedule = build_schedule(derivation("kuka_iiwa"))
    values = {parameter.name: parameter.value for parameter in schedule.parameters if parameter.value is not None}
    walk = ExactWalk(schedule, values)
    q = [0.4, -0.7, 0.5, 1.1, -0.3, 0.8, 2.0]
    pose = [*walk.forward(q), [0, 0, 0, 1]]
    found = walk.inverse(pose, q) or []
    assert len(found) == 8
    assert all(solution[2] == 0.5 for solution in found)
    assert min(max(abs(a - b) for a, b in zip(solution, q, strict=True)) for solution in found) < 1e-40
    assert all(solution[2] == 0 for solution in walk.inverse(pose) or [])
    assert ExactSolver(schedule, values).walk.size == walk.size


FAULTS = {
    "sweep not that of the values": ("q.reshape(-1, 8, 7), valid", "q.reshape(-1, 8, 7)[::-1], valid", SWEEP_LAW),
    "value not given back": ("np.add(theta3, empty,", "np.add(0.0 * theta3, empty,", INVERSE_LAW),
    "value ignored": (
        "c3 = np.cos(theta3)\n    s3 = np.sin(theta3)\n    size",
        "c3, s3 = 1.0, 0.0\n    size",
        FOUND_LAW,
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.usefixtures("few_poses")
def test_faults_are_found(fault: str) -> None:
    old, new, law = FAULTS[fault]
    found = derivation("kuka_iiwa")
    schedule = build_schedule(found)
    (text,) = rendered(found, schedule, ("numpy",)).values()
    assert text.count(old) == 1
    findings = compare(found.robot, schedule, {"kuka_iiwa.py": text.replace(old, new)})
    assert law in {check.law for check in findings.checks if check.status == FAILED}


def test_the_report_says_what_is_locked() -> None:
    found = derivation("rail_and_elbow")
    schedule = build_schedule(found)
    content = json.loads(report_of(found.robot, schedule, {}, None).text())
    assert content["joints"][0] == "d1 (P, locked: input)"
    assert content["joints"][3] == "theta4 (R, locked: 0.3)"
    assert content["joints"][1] == "theta2 (R)"
    assert "[locks]" in content["table"]
