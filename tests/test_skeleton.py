"""The figure of an arm: true at every posture of every robot, and as a person would draw it."""

from __future__ import annotations

import importlib.util
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from kinsym.errors import RobotError
from kinsym.postures import general_posture
from kinsym.robot import from_inline, gallery, load
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from kinsym.skeleton import Linkage, linkage

GENERATED = Path(__file__).resolve().parent.parent / "generated"


def values_of(robot: Robot) -> dict[str, float]:
    return {name: 0.3 + 0.1 * i for i, (name, value) in enumerate(robot.parameters.items()) if value is None}


def module(name: str) -> ModuleType:
    """The committed NumPy module: forward kinematics that has nothing in common with this geometry."""
    spec = importlib.util.spec_from_file_location(name, GENERATED / name / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def postures(arm: Linkage, count: int = 5) -> np.ndarray:
    return np.random.default_rng(3).uniform(-2.0, 2.0, (count, len(arm.kinds)))


@pytest.mark.parametrize("name", gallery())
def test_the_figure_ends_where_the_forward_kinematics_does(name: str) -> None:
    robot = load(name)
    arm = linkage(robot, values_of(robot))
    q = postures(arm)
    posture, poses = arm.at(q), module(name).fk(q, **values_of(robot))
    assert np.abs(posture.frames[:, -1] - poses).max() < 1e-12
    assert np.abs(posture.path[:, -1] - poses[:, :3, 3]).max() < 1e-12


@pytest.mark.parametrize("name", gallery())
def test_links_are_rigid_and_leave_their_axes_at_right_angles(name: str) -> None:
    """Between two axes a link runs along their common normal, wherever the frames of the table lie."""
    robot = load(name)
    arm = linkage(robot, values_of(robot))
    posture = arm.at(postures(arm))
    ways = np.diff(posture.path, axis=1)
    links, along, axes = ways[:, 2:-1:2], ways[:, 1:-1:2], posture.joints[..., :3, 2]
    assert np.abs(np.einsum("kni,kni->kn", links, axes[:, :-1])).max() < 1e-12
    if all(joint.kind != "fixed" for joint in robot.joints):
        skew = np.linalg.norm(np.cross(axes[:, :-1], axes[:, 1:]), axis=-1) > 0.1
        assert np.abs(np.einsum("kni,kni->kn", links, axes[:, 1:])[skew]).max(initial=0.0) < 1e-12
    lengths = np.linalg.norm(links, axis=-1)
    assert np.abs(lengths - lengths[0]).max() < 1e-12
    assert np.abs(np.cross(along, axes)).max() < 1e-12
    turning = np.array([kind == "R" for kind in arm.kinds])
    shifts = np.einsum("kni,kni->kn", along, axes)[:, turning]
    assert np.abs(shifts - shifts[0]).max(initial=0.0) < 1e-12


def test_the_corners_of_a_puma() -> None:
    """By its table at home: a2 along x, d3 along axis 3, which points to -y, a3 along x, d4 along axis 4, up."""
    corners = linkage(load("puma560")).at(np.zeros(6)).path
    a2, a3, d3, d4 = 0.4318, 0.0203, 0.15005, 0.4318
    way = [(0, 0, 0), (a2, 0, 0), (a2, -d3, 0), (a2 + a3, -d3, 0), (a2 + a3, -d3, d4)]
    distinct = [corners[0], *(end for start, end in pairwise(corners) if np.abs(end - start).max() > 1e-9)]
    assert np.allclose(distinct, way, atol=1e-12)


def test_a_slide_draws_its_link_out() -> None:
    arm = linkage(load("stanford_arm"))
    q = np.array([[0.3, 0.8, 0.4, 0.1, 0.2, 0.3], [0.3, 0.8, 0.7, 0.1, 0.2, 0.3]])
    ways = np.linalg.norm(np.diff(arm.at(q).path, axis=1), axis=-1)
    assert np.allclose(ways[1] - ways[0], [0, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0, 0, 0])


def test_a_calibrated_table_does_not_run_off() -> None:
    """Axes 2 and 3 are off parallel by 0.001 rad, which puts the feet of their normal 200 m and more away."""
    rows = "pi/2 0 0.4 theta1; 0.001 0.4 250 theta2; 0 0.3 -250 theta3"
    arm = linkage(from_inline(rows, convention="paul", name="calibrated"))
    assert arm.size < 2.0
    assert np.abs(arm.at(postures(arm)).path).max() < 2.0
    assert np.abs(arm.at(np.zeros(3)).frames[..., :3, 3]).max() > 200.0


def test_frames_are_those_of_the_table() -> None:
    robots = [load(f"planar_rrr_{kind}") for kind in ("paul", "craig", "screw")]
    paul, craig, screw = (linkage(robot, dict.fromkeys(robot.parameters, 1.0)) for robot in robots)
    assert paul.frame_names == ("0", "1", "2", "3")
    assert screw.frame_names == ("0", "tool")
    assert paul.at(np.zeros(3)).frames[:, 0, 3].tolist() == [0, 1, 2, 3]
    assert craig.at(np.zeros(3)).frames[:4, 0, 3].tolist() == [0, 0, 1, 2]
    turned = paul.at([0.5, 0.0, 0.0]).frames[1]
    assert np.allclose(turned[:2, 0], [np.cos(0.5), np.sin(0.5)])


@pytest.mark.parametrize(
    ("name", "plane"), [("planar_rr", (0, 1)), ("planar_rrr_screw", (0, 1)), ("scara", None), ("puma560", None)]
)
def test_which_arms_move_in_a_plane(name: str, plane: tuple[int, int] | None) -> None:
    robot = load(name)
    assert linkage(robot, values_of(robot)).plane == plane


def test_a_plane_that_stands() -> None:
    axis = {"type": "R", "s": ["0", "1", "0"]}
    rows = [{**axis, "s0": ["0", "0", "0"]}, {**axis, "s0": ["1", "0", "0"]}]
    home = {"u0": [1, 0, 0], "v0": [0, 1, 0], "w0": [0, 0, 1], "q0": [2, 0, 0]}
    robot = from_draft({"name": "arm", "convention": "screw", "joints": rows, "home": home}, where="arm")
    assert linkage(robot).plane == (0, 2)


def test_a_value_is_needed_for_every_length() -> None:
    with pytest.raises(RobotError, match=r"l1, l2 have no value.*--bind l1=VALUE --bind l2=VALUE"):
        linkage(load("planar_rr"))
    with pytest.raises(RobotError, match="l2 = nan is no number"):
        linkage(load("planar_rr"), {"l1": 1.0, "l2": float("nan")})


@pytest.mark.parametrize("name", ["kuka_iiwa", "franka_panda", "puma560", "gudel_fp1", "planar_rrr_paul"])
def test_a_general_posture_is_inside_the_limits_and_bent(name: str) -> None:
    robot = load(name)
    arm = linkage(robot, values_of(robot))
    q = general_posture(arm)
    assert (q > arm.limits[:, 0]).all()
    assert (q < arm.limits[:, 1]).all()
    assert (q == general_posture(arm)).all()
    assert np.abs(q).min() > 0.1


def test_a_held_joint_stands_at_its_value() -> None:
    assert general_posture(linkage(load("kuka_iiwa")), {"theta3": 0.25})[2] == 0.25
