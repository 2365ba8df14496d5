"""What is read as a pose; spatialmath and SciPy have stand-ins with what is asked of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from kinsym.errors import RobotError
from kinsym.frames import solve_tool_at_goal, wrist_at_goal
from kinsym.live import live
from kinsym.poses import as_poses
from kinsym.robot import load

TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
POSE = np.array([[0.0, -1.0, 0.0, 0.3], [1.0, 0.0, 0.0, 0.2], [0.0, 0.0, 1.0, 0.4], [0.0, 0.0, 0.0, 1.0]])


class SE3:
    """As in spatialmath: one matrix is an array, several are a list."""

    def __init__(self, *matrices: np.ndarray) -> None:
        self.A = matrices[0] if len(matrices) == 1 else list(matrices)


class Rotation:
    """As in SciPy."""

    def __init__(self, matrix: np.ndarray) -> None:
        self._matrix = matrix

    def as_matrix(self) -> np.ndarray:
        """(3, 3), or (n, 3, 3) of several."""
        return self._matrix


@pytest.mark.parametrize(
    "given",
    [
        POSE,
        POSE.tolist(),
        SE3(POSE),
        (Rotation(TURN), [0.3, 0.2, 0.4]),
        [TURN, POSE[:3, 3]],
        (TURN.tolist(), (0.3, 0.2, 0.4)),
    ],
)
def test_one_pose(given: Any) -> None:
    np.testing.assert_array_equal(as_poses(given), POSE)


@pytest.mark.parametrize(
    "given",
    [
        [POSE, POSE],
        (POSE, POSE),
        SE3(POSE, POSE),
        (Rotation(np.array([TURN, TURN])), [0.3, 0.2, 0.4]),
        (Rotation(TURN), [POSE[:3, 3]] * 2),
    ],
)
def test_two_poses(given: Any) -> None:
    np.testing.assert_array_equal(as_poses(given), [POSE, POSE])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (None, r"the goal has the shape \(\)"),
        ("north", r"the goal is no matrix of numbers"),
        (np.eye(3), r"the goal has the shape \(3, 3\)\. A pose has the shape \(4, 4\)\. Give a matrix"),
        ([[1.0], [2.0, 3.0]], r"the goal is no matrix of numbers"),
        ((Rotation(TURN), [1.0, 2.0]), r"the vector of the goal has the shape \(2,\)"),
        ((Rotation(TURN), "here"), r"the vector of the goal is no matrix of numbers"),
        ((Rotation(np.array([TURN] * 2)), np.zeros((3, 3))), r"rotations \(2, 3, 3\) and vectors \(3, 3\)"),
        (Rotation(TURN), r"the goal is no matrix of numbers"),
        ((TURN, None), r"the vector of the goal (is no matrix|has the shape)"),
    ],
)
def test_everything_else_is_refused(given: Any, message: str) -> None:
    with pytest.raises(RobotError, match=message):
        as_poses(given, "the goal")


def test_arms_and_frames_read_them() -> None:
    arm = live(load("planar_rr"), {"l1": 0.4, "l2": 0.3})
    q = np.array([0.3, 0.7])
    pose = arm.fk(q)
    for given in (SE3(pose), (Rotation(pose[:3, :3]), pose[:3, 3])):
        found = arm.ik(given)
        assert np.abs(found - q).max(axis=1).min() < 1e-12
        assert arm.solve(given).status == "solved"
        np.testing.assert_array_equal(solve_tool_at_goal(arm, given), found)
        np.testing.assert_array_equal(wrist_at_goal(given, tool=SE3(np.eye(4))), pose)
    with pytest.raises(RobotError, match="goal T_S_G is no rigid motion"):
        wrist_at_goal((2.0 * TURN, [0.0, 0.0, 0.0]))
