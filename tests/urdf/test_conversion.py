"""A chain of a URDF file and the table made of it have the same forward kinematics.

The expected poses are computed here with NumPy from the file's definition alone: a fixed turn Rz(yaw) Ry(pitch)
Rx(roll) at xyz, then the motion about or along the axis (Rodrigues).
"""

from __future__ import annotations

import random
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.check.table import TableKinematics
from kinsym.deriving import derive
from kinsym.robot import load, parse
from kinsym.robot.model import Robot
from kinsym.robot.snapping import EXACT, snapping_of
from kinsym.robot.urdf.document import UrdfJoint, read_urdf
from kinsym.robot.urdf.path import joints_between
from tests.urdf.trees import QUARTER, J, panda, planar, scara, ur5, urdf, write

Array = np.ndarray[Any, np.dtype[np.float64]]


def turned(axis: Array, angle: float) -> Array:
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return pose


def moved(vector: Array) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = vector
    return pose


def expected(joints: tuple[UrdfJoint, ...], q: list[float]) -> Array:
    pose, values = np.eye(4), iter(q)
    for joint in joints:
        roll, pitch, yaw = (float(value) for value in joint.rpy)
        pose = pose @ moved(np.array(joint.xyz, dtype=float))
        pose = pose @ turned(np.eye(3)[2], yaw) @ turned(np.eye(3)[1], pitch) @ turned(np.eye(3)[0], roll)
        axis = np.array(joint.axis, dtype=float)
        if joint.kind == "prismatic":
            pose = pose @ moved(next(values) * axis / np.linalg.norm(axis))
        elif joint.kind != "fixed":
            pose = pose @ turned(axis, next(values))
    return pose


def off(robot: Robot, path: Path, base: str | None = None, tip: str | None = None) -> float:
    """The largest difference of an entry of T over five joint vectors."""
    joints = joints_between(read_urdf(path, shown_as="x"), base, tip, where="x")
    table = TableKinematics(robot, {name: value for name, value in robot.parameters.items() if value is not None})
    generator = random.Random(1)
    worst = 0.0
    for _ in range(5):
        q = [generator.uniform(-3, 3) for _ in robot.variables]
        worst = max(worst, np.abs(expected(joints, q) - np.array(table.forward(q), dtype=float)).max())
    return worst


def columns(robot: Robot, name: str) -> list[str]:
    return [str(getattr(joint, name)) for joint in robot.joints]


def test_a_ur5_becomes_the_table_of_its_maker(tmp_path: Path) -> None:
    """Twists and lengths are those of the gallery's UR5 up to the direction of the axes."""
    path = write(tmp_path, ur5())
    robot = load(str(path))
    assert robot.name == "ur5_CB"
    assert robot.title == "ur5 (CB)"
    assert robot.source == "arm.urdf, world to ee_link"
    assert columns(robot, "alpha")[:5] == ["-pi/2", "0", "0", "-pi/2", "pi/2"]
    values = {name: abs(value) for name, value in robot.parameters.items() if value is not None}
    gallery = load("ur5").parameters
    assert {name: abs(value) for name, value in gallery.items() if value is not None} == values
    assert robot.base is None
    assert all(joint.limits is not None and joint.limits[1] == Fraction("3.1") for joint in robot.joints)
    assert robot.deviation is not None
    assert robot.deviation.position < 1e-16
    assert robot.deviation.rotation < 1e-15
    assert off(robot, path) < 1e-14


def test_rounded_numbers_are_made_exact_and_told(tmp_path: Path) -> None:
    """1.5708 is pi/2; the change of each number and its effect on T are reported, and the effect is the true one."""
    path = write(tmp_path, ur5("1.5708"))
    robot = load(str(path))
    assert columns(robot, "alpha")[:5] == ["-pi/2", "0", "0", "-pi/2", "pi/2"]
    assert robot.deviation is not None
    assert [change.where for change in robot.deviation.changes] == [
        "joint shoulder_lift, rpy",
        "joint wrist_1, rpy",
        "joint flange, rpy",
    ]
    assert all(change.difference == pytest.approx(3.673205e-6, rel=1e-6) for change in robot.deviation.changes)
    assert "joint wrist_1, rpy: 1.5708 is read as pi/2 (off by 3.7e-06)." in robot.notes
    assert robot.notes[-1].startswith("3 numbers read as special values; the forward kinematics differs")
    assert robot.deviation.position / 3 < off(robot, path) < 2 * robot.deviation.rotation
    assert 1e-6 < robot.deviation.position < 1e-5


def test_exact_takes_the_numbers_as_they_are(tmp_path: Path) -> None:
    path = write(tmp_path, ur5("1.5708"))
    robot = load(str(path), snapping=EXACT)
    assert robot.deviation is not None
    assert robot.deviation.changes == ()
    assert off(robot, path) < 1e-14
    rest = robot.joints[1].theta - parse("theta2")  # type: ignore[operator]
    assert float(rest) == pytest.approx(1.5708 - np.pi / 2, abs=1e-16)


def test_axes_that_are_parallel_or_meet_but_for_rounding(tmp_path: Path) -> None:
    """What an export of CAD makes of a UR5: noise of 1e-8 in every number."""
    generator = random.Random(5)

    def noise(text: str) -> str:
        return " ".join(f"{float(word) + generator.uniform(-1e-8, 1e-8):.12f}" for word in text.split())

    text = ur5()
    for key in ("xyz", "rpy"):
        text = re.sub(rf'(<origin[^>]* {key}=")([^"]*)', lambda found: found[1] + noise(found[2]), text)
    path = write(tmp_path, text)
    robot = load(str(path))
    assert derive(robot).plan.maximum == 8
    assert robot.deviation is not None
    assert 1e-10 < robot.deviation.position < 1e-6
    assert off(robot, path) < 1e-6
    assert len(load(str(path), snapping=EXACT).parameters) > len(robot.parameters)


def test_a_wider_tolerance_on_demand(tmp_path: Path) -> None:
    """Three digits are no rounding that anyone could be sure of: a note by default, made exact by --snap."""
    path = write(tmp_path, ur5("1.57"))
    plain = load(str(path))
    assert plain.deviation is not None
    assert plain.deviation.changes == ()
    robot = load(str(path), snapping=snapping_of("1e-3"))
    assert columns(robot, "alpha")[:5] == ["-pi/2", "0", "0", "-pi/2", "pi/2"]


@pytest.mark.parametrize(
    ("axis", "note"),
    [
        ("0 0 0.99999", "0, 0, 0.99999 is read as 0, 0, 1 (off by 1.0e-05)."),
        ("0 0 -2.5", "0 0 -2.5 is read as a unit vector (off by 1.5e+00)."),
        ("0.1 0.2 0.3", "0.1 0.2 0.3 is read as a unit vector (off by 6.3e-01)."),
    ],
)
def test_an_axis_is_normalised_and_that_is_told(tmp_path: Path, axis: str, note: str) -> None:
    path = write(tmp_path, urdf(J("j1", "prismatic", "a", "b", axis=axis), name="slide"))
    robot = load(str(path))
    assert robot.notes[2] == f"joint j1, axis: {note}"
    assert robot.variables == ("d1",)
    assert columns(robot, "d") == ["d1"]
    assert off(robot, path) < 1e-14


def test_an_axis_of_rounded_cosines(tmp_path: Path) -> None:
    """An axis of five digits, 30 degrees from the one before it, though its angle is off by 2e-6 rad."""
    text = urdf(J("j1", "continuous", "a", "b"), J("j2", "continuous", "b", "c", "0.3 0 0", axis="0 0.5 0.86603"))
    robot = load(str(write(tmp_path, text)))
    assert columns(robot, "alpha")[0] in ("-pi/6", "pi/6")
    assert robot.deviation is not None
    assert 1e-7 < robot.deviation.rotation < 1e-5
    assert load(str(tmp_path / "arm.urdf"), snapping=EXACT).joints[0].alpha not in (parse("pi/6"), parse("-pi/6"))


def test_planar_arm_without_its_meshes(tmp_path: Path) -> None:
    robot = load(str(write(tmp_path, planar())))
    assert columns(robot, "a") == ["a1", "a2", "a3"]
    assert columns(robot, "alpha") == ["0", "0", "0"]
    assert [float(value or 0) for value in robot.parameters.values()] == [0.4, 0.3, 0.2, 0.1]


def test_scara_with_a_gripper_that_follows(tmp_path: Path) -> None:
    path = write(tmp_path, scara("jaw"))
    robot = load(str(path), tip_link="tool")
    assert robot.variables == ("theta1", "theta2", "d3", "theta4")
    assert [joint.kind for joint in robot.joints] == ["R", "R", "P", "R"]
    assert off(robot, path, tip="tool") < 1e-14
    assert robot.joints[2].limits == (0, Fraction(1, 5))


def test_panda_between_any_two_links(tmp_path: Path) -> None:
    """The file's frames are those of Franka's modified DH table; the lengths come out again."""
    path = write(tmp_path, panda())
    robot = load(str(path), tip_link="panda_link8")
    assert sorted(float(value or 0) for value in robot.parameters.values()) == [
        -0.0825, 0.0825, 0.088, 0.107, 0.316, 0.333, 0.384
    ]  # fmt: skip
    assert off(robot, path, tip="panda_link8") < 1e-14
    for base, tip in (("panda_link1", "panda_hand"), ("panda_link3", "leftfinger"), ("panda_link6", "panda_link7")):
        part = load(str(path), base_link=base, tip_link=tip)
        assert off(part, path, base, tip) < 1e-14
        assert part.source == f"arm.urdf, {base} to {tip}"


GENERIC = ["0.3 -0.7 1.1", "1 2 3", "-2.5 0.4 0.1"]


@pytest.mark.parametrize("seed", range(12))
def test_any_chain(tmp_path: Path, seed: int) -> None:
    """Axes in any direction, axes parallel, opposite, meeting and skew, fixed joints anywhere."""
    generator = random.Random(seed)
    joints = []
    for i in range(generator.randint(1, 8)):
        kind = "revolute" if i == 0 else generator.choice(["revolute", "continuous", "prismatic", "fixed"])
        rpy = generator.choice(
            ["0 0 0", f"{QUARTER} 0 0", f"0 -{QUARTER} {QUARTER}", "3.141592653589793 0 0", *GENERIC]
        )
        xyz = generator.choice(["0 0 0", "0 0 0.3", "0.2 0 -0.1", "0.11 -0.2 0.3"])
        axis = generator.choice(["0 0 1", "0 -1 0", "1 0 0", "0 0 -1", "1 1 0", "0.2 -0.3 0.5"])
        limits = '<limit lower="-2" upper="1"/>' if seed % 2 else ""
        joints.append(J(f"j{i}", kind, f"l{i}", f"l{i + 1}", xyz, rpy, axis, limits))
    path = write(tmp_path, urdf(*joints))
    robot = load(str(path))
    assert off(robot, path) < 1e-13
    assert robot.deviation is not None
    assert robot.deviation.position < 1e-14


@pytest.mark.parametrize(
    ("given", "stem", "name"),
    [
        ("my-robot 2", "x", "my_robot_2"),
        ("", "arm-7", "arm_7"),
        ("7axis", "arm", "arm"),
        ("class", "if", "class_arm"),
        ("Ärmchen", "x", "Armchen"),
        ("&#10;...", "0", "arm"),
        ("7", "7", "urdf_arm"),
        ("a" * 60, "x", "a" * 40),
        ("numpy", "numpy", "numpy_arm"),
    ],
)
def test_a_safe_name(tmp_path: Path, given: str, stem: str, name: str) -> None:
    path = write(tmp_path, urdf(J("j1", "continuous", "a", "b"), name=given), f"{stem}.urdf")
    assert load(str(path)).name == name
    assert load(str(path), name="mine").name == "mine"


def test_a_joint_without_a_range_is_told(tmp_path: Path) -> None:
    text = urdf(
        J("j1", "revolute", "a", "b", inside='<limit effort="1" velocity="1"/>'), J("j2", "continuous", "b", "c")
    )
    robot = load(str(write(tmp_path, text)))
    assert [joint.limits for joint in robot.joints] == [None, None]
    assert [note for note in robot.notes if "range" in note] == [
        "joint j1: its limit gives no range, so it has none here."
    ]


def test_parameters_can_be_bound(tmp_path: Path) -> None:
    path = write(tmp_path, planar())
    assert list(load(str(path), bindings={"a1": Fraction(1, 2)}).parameters) == ["a2", "a3", "d3"]
