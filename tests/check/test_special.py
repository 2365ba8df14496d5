"""The check finds faults that show only for other shapes, next to borders, and at special values of the parameters."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from kinsym.check.compare import compare
from kinsym.check.control import STATUS_LAW
from kinsym.check.edges import EDGE_AGREE_LAW, EDGE_LAW, INSIDE, OUTSIDE, ROUGH_LAW, edges
from kinsym.check.laws import Judge
from kinsym.check.report import FAILED
from kinsym.check.shapes import SHAPE_LAW
from kinsym.check.strange import TILT_LAW
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.check.vanishing import REGULAR_LAW, VANISHING_LAW, special_values
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests.arms import derivation, robot
from tests.emit.built import needs_compiler

NAME = "planar_rr"
#: Faults that no arm of two joints shows, and an arm that does.
OTHERS = {EDGE_AGREE_LAW: "planar_rrr_paul", ROUGH_LAW: "scara"}
FAULTS = {
    "nothing": ("numpy", NAME, NAME, None),
    "one joint vector": ("numpy", "    return J\n", "    return J.reshape(-1, 6, 2)\n", SHAPE_LAW),
    "out of reach": ("numpy", "if not len(free):", "if False:", STATUS_LAW),
    "a singular pose": ("numpy", '"singular" if free.any() or border.any() else ', "", STATUS_LAW),
    "equal links": ("numpy", "wide + wide * wide", "wide - wide * wide", VANISHING_LAW),
    "whole turns": ("c", "ceil((angle - pi)", "ceil((angle + pi)", EDGE_LAW),
    "a root in doubt": ("c", "/ (entry_of[i] % 4 == 3 ? size", "/ (size < 0.0 ? size", EDGE_AGREE_LAW),
    "polished too often": ("c", "if (!(left > reach))", "if (0)", ROUGH_LAW),
}


@needs_compiler
@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.usefixtures("few_poses")
def test_faults_are_found(fault: str) -> None:
    language, old, new, law = FAULTS[fault]
    name = OTHERS.get(law or "", NAME)
    schedule = build_schedule(derivation(name))
    assert old in "".join(TARGETS[language](schedule).values())
    sources = {file: text for target in ("numpy", "c") for file, text in TARGETS[target](schedule).items()}
    endings = {"numpy": ".py", "c": ".c"}
    sources |= {file: text.replace(old, new) for file, text in sources.items() if file.endswith(endings[language])}
    failed = {check.law for check in compare(robot(name), schedule, sources).checks if check.status == FAILED}
    assert law in failed if law else not failed


def test_a_length_without_which_the_arm_cannot_move_must_not_be_zero() -> None:
    schedule = build_schedule(derivation("planar_rrr_paul"))
    schedule = replace(schedule, nonzero=tuple(item for item in schedule.nonzero if item.parameters != ("a2",)))
    failed = {check.law for check in compare(robot("planar_rrr_paul"), schedule, {}).checks if check.status == FAILED}
    assert failed == {REGULAR_LAW}


def test_a_pose_that_an_arm_of_few_joints_cannot_take_is_not_answered() -> None:
    schedule = replace(build_schedule(derivation("scara")), gate=False)
    findings = compare(robot("scara"), schedule, TARGETS["numpy"](schedule))
    assert TILT_LAW in {check.law for check in findings.checks if check.status == FAILED}


def test_what_may_be_zero_and_what_may_be_equal() -> None:
    schedule = build_schedule(derivation("planar_rrr_paul"))
    values = {"a1": Fraction(2), "a2": Fraction(-3), "a3": Fraction(5)}
    assert list(special_values(schedule, values, frozenset(values))) == [
        {**values, "a3": Fraction(0)},
        {**values, "a2": Fraction(-2)},
        {**values, "a3": Fraction(3)},
    ]
    assert list(special_values(schedule, {**values, "a3": Fraction(0)}, frozenset({"a2"}))) == []


def judge(name: str, values: dict[str, Fraction]) -> tuple[Judge, Any]:
    """The judge of an arm, and its task."""
    schedule = build_schedule(derivation(name))
    revolute = np.array([joint.kind == "R" for joint in schedule.joints])
    return Judge(TreeKinematics(schedule, values), schedule.task, revolute, float(schedule.tau)), schedule.task


def test_poses_lie_as_deep_as_they_say() -> None:
    """A stretched arm reaches as far as its links are long; the arm's size is the same length."""
    own, task = judge(NAME, {"l1": Fraction(3, 4), "l2": Fraction(1, 4)})
    at = edges(own, task, np.array([[0.3, 0.0], [0.3, 1.0]]))
    distance = np.linalg.norm(at.poses[:, :2, 3], axis=1)
    assert at.inside.tolist() == [True] * len(INSIDE) + [False] * len(OUTSIDE)
    assert 1.0 - distance == pytest.approx([*INSIDE, *(-depth for depth in OUTSIDE)], rel=0.02, abs=5e-16)


def test_an_arm_without_a_border_has_no_such_poses() -> None:
    own, task = judge("spherical_wrist", {"d6": Fraction(1)})
    assert not len(edges(own, task, np.array([[0.3, 0.0, 0.2]])).q)
    assert not len(edges(own, task, np.empty((0, 3))).q)
