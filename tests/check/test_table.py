"""Forward kinematics straight from tables, against transforms that can be checked by eye."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from kinsym.check.table import TableKinematics
from kinsym.robot import load


def test_one_arm_in_three_conventions() -> None:
    """The lecture's planar RRR arm in Craig's, Paul's and the screw table ends at the same place."""
    q = [0.3, -1.1, 2.0]
    poses = []
    for name in ("planar_rrr_craig", "planar_rrr_paul", "planar_rrr_screw"):
        robot = load(name)
        lengths = {parameter: Fraction(index + 2, 10) for index, parameter in enumerate(sorted(robot.parameters))}
        poses.append(TableKinematics(robot, lengths).forward(q))
    for pose in poses[1:]:
        assert [pose[i][:3] for i in range(3)] == [pytest.approx(poses[0][i][:3]) for i in range(3)]


def test_planar_arm_by_eye() -> None:
    """Two links at right angles."""
    table = TableKinematics(load("planar_rr"), {"l1": Fraction(1), "l2": Fraction(2)})
    pose = table.forward([0, math.pi / 2])
    assert [float(row[3]) for row in pose[:3]] == pytest.approx([1, 2, 0])
    assert float(pose[0][1]) == pytest.approx(-1)


def test_prismatic_joint_by_eye() -> None:
    """A longer joint moves the end along its own axis and turns nothing."""
    table = TableKinematics(
        load("stanford_screw"), {name: Fraction(1, 2) for name in load("stanford_screw").parameters}
    )
    short, long = (table.forward([0.2, 0.4, d3, 0.1, 0.6, -0.3]) for d3 in (0.5, 0.75))
    moved = [float(after[3] - before[3]) for after, before in zip(long[:3], short[:3], strict=True)]
    assert math.hypot(*moved) == pytest.approx(0.25)
    assert [row[:3] for row in long[:3]] == [row[:3] for row in short[:3]]
