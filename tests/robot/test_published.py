"""The tables of the gallery are the robots that their sources describe."""

from __future__ import annotations

import numpy as np
import pytest

from kinsym.check.table import TableKinematics
from kinsym.robot import load
from tests.robot.published import TABLES, URDF, Floats, table_pose, urdf_pose

#: Two joint vectors of no symmetry; sliding joints take the same numbers in metres.
VECTORS = ([0.3, -0.7, 1.1, 0.4, -0.9, 2.1, 0.2], [-1.2, 0.5, -0.4, 2.0, 0.8, -0.6, 1.5])

#: Sources round right angles: Techman's and Yaskawa's files write pi/2 with seven digits.
ROUNDED = 2e-6


def pose_of(name: str, q: list[float]) -> Floats:
    robot = load(name)
    values = {key: value for key, value in robot.parameters.items() if value is not None}
    assert len(values) == len(robot.parameters)
    return np.array(TableKinematics(robot, values).forward(q), dtype=np.float64)


@pytest.mark.parametrize("vector", VECTORS, ids=["first", "second"])
@pytest.mark.parametrize("name", URDF)
def test_against_the_urdf(name: str, vector: list[float]) -> None:
    q = vector[: len(load(name).moving)]
    assert np.abs(pose_of(name, q) - urdf_pose(name, q)).max() < ROUNDED


@pytest.mark.parametrize("vector", VECTORS, ids=["first", "second"])
@pytest.mark.parametrize("name", TABLES)
def test_against_the_printed_table(name: str, vector: list[float]) -> None:
    q = vector[: len(load(name).moving)]
    assert np.abs(pose_of(name, q) - table_pose(name, q)).max() < 1e-12


def test_sole_of_the_nao() -> None:
    # Standing, the sole is under the hip: HipOffsetY = 50, 85 + 100 + 102.9 + 45.19 below the torso (Kofinas 2012).
    wanted = np.eye(4)
    wanted[:3, 3] = 0, 0.05, -(0.085 + 0.1 + 0.1029 + 0.04519)
    assert np.abs(pose_of("nao_left_leg", [0.0] * 6) - wanted).max() < 1e-12


def test_slides_of_the_gudel() -> None:
    # One metre on each slide moves one coordinate of the tool by a metre, in the order z, y, x.
    start = pose_of("gudel_fp1", [0.0, 0.0, 0.0])[:3, 3]
    moved = np.array([pose_of("gudel_fp1", list(q))[:3, 3] - start for q in np.eye(3)])
    assert np.abs(moved - [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]).max() < 1e-12


def test_comau_at_zero() -> None:
    # The forearm lies: 50 + 305.94 + 80 mm forwards, 365 + 270 + 50 mm up; the flange looks forwards.
    pose = pose_of("comau_racer3", [0.0, 0.0, -np.pi / 2, 0.0, 0.0, 0.0])
    assert np.abs(pose[:3, 3] - [0.05 + 0.30594 + 0.08, 0, 0.365 + 0.27 + 0.05]).max() < 1e-12
    assert np.abs(pose[:3, 2] - [1, 0, 0]).max() < 1e-12


def test_links_of_the_jaco() -> None:
    # Its two bends of 60 degrees: sin(30) / sin(60) of D4 and D5 belong to each of the links beside them (Jaco.py).
    share = np.sin(np.pi / 6) / np.sin(np.pi / 3)
    wanted = {"d4": 0.2073 + share * 0.0743, "d5": 2 * share * 0.0743, "d6": share * 0.0743 + 0.1687}
    given = load("kinova_jaco").parameters
    assert {name: float(given[name] or 0) for name in wanted} == pytest.approx(wanted, abs=5e-9)
