"""URDF files for the tests, written joint by joint."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

QUARTER = "1.5707963267948966"
"""pi/2 as a program prints it."""
TURN = '<limit lower="-3.1" upper="3.1" effort="1" velocity="1"/>'


@dataclass(frozen=True)
class J:
    """One joint; ``inside`` is put into its element as it stands."""

    name: str
    kind: str
    parent: str
    child: str
    xyz: str = "0 0 0"
    rpy: str = "0 0 0"
    axis: str = "0 0 1"
    inside: str = ""

    def text(self) -> str:
        return (
            f'<joint name="{self.name}" type="{self.kind}"><parent link="{self.parent}"/><child link="{self.child}"/>'
            f'<origin xyz="{self.xyz}" rpy="{self.rpy}"/><axis xyz="{self.axis}"/>{self.inside}</joint>'
        )


def urdf(*joints: J, name: str = "arm", before: str = "") -> str:
    """The text of a file with these joints and the links they name."""
    links = dict.fromkeys(link for joint in joints for link in (joint.parent, joint.child))
    lines = ['<?xml version="1.0"?>', before, f'<robot name="{name}">', *(f'<link name="{link}"/>' for link in links)]
    return "\n".join([*lines, *(joint.text() for joint in joints), "</robot>", ""])


def write(folder: Path, text: str, name: str = "arm.urdf") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def ur5(quarter: str = QUARTER) -> str:
    """A UR5 with the frames and numbers of universal_robot/ur_description (ROS, CB series), pi/2 as it is given."""
    return urdf(
        J("world_joint", "fixed", "world", "base_link"),
        J("shoulder_pan", "revolute", "base_link", "shoulder", "0 0 0.089159", inside=TURN),
        J("shoulder_lift", "revolute", "shoulder", "upper_arm", "0 0.13585 0", f"0 {quarter} 0", "0 1 0", TURN),
        J("elbow", "revolute", "upper_arm", "forearm", "0 -0.1197 0.425", axis="0 1 0", inside=TURN),
        J("wrist_1", "revolute", "forearm", "wrist_1_link", "0 0 0.39225", f"0 {quarter} 0", "0 1 0", TURN),
        J("wrist_2", "revolute", "wrist_1_link", "wrist_2_link", "0 0.093 0", inside=TURN),
        J("wrist_3", "revolute", "wrist_2_link", "wrist_3_link", "0 0 0.09465", axis="0 1 0", inside=TURN),
        J("flange", "fixed", "wrist_3_link", "ee_link", "0 0.0823 0", f"0 0 {quarter}"),
        name="ur5 (CB)",
    )


def planar() -> str:
    """Three links of 0.4, 0.3 and 0.2 m, the meshes of which do not exist."""
    mesh = '<visual><geometry><mesh filename="package://nowhere/none.stl"/></geometry></visual>'
    text = urdf(
        J("j1", "continuous", "base", "l1", "0 0 0.1"),
        J("j2", "continuous", "l1", "l2", "0.4 0 0"),
        J("j3", "continuous", "l2", "l3", "0.3 0 0"),
        J("tip", "fixed", "l3", "tool", "0.2 0 0"),
        name="planar",
    )
    return text.replace('<link name="l1"/>', f'<link name="l1">{mesh}</link>')


def scara(mimic: str) -> str:
    """A SCARA arm whose spindle turn, or the gripper after it, follows another joint."""
    follow = '<mimic joint="j2" multiplier="-1"/>'
    return urdf(
        J("j1", "revolute", "base", "l1", "0 0 0.4", inside=TURN),
        J("j2", "revolute", "l1", "l2", "0.325 0 0", inside=TURN),
        J("j3", "prismatic", "l2", "l3", "0.275 0 0", f"{QUARTER} 0 0", "0 -1 0", '<limit lower="0" upper="0.2"/>'),
        J("j4", "revolute", "l3", "tool", "0 0 0", axis="0 -1 0", inside=TURN + (follow if mimic == "j4" else "")),
        J("jaw", "prismatic", "tool", "finger", "0 0.1 0", inside=follow if mimic == "jaw" else ""),
        name="scara",
    )


def panda() -> str:
    """The seven joints of franka_ros (modified Denavit-Hartenberg frames) with two fingers; the right one mimics."""
    links = [f"panda_link{i}" for i in range(9)]
    rolls = ("0", f"-{QUARTER}", QUARTER, QUARTER, f"-{QUARTER}", QUARTER, QUARTER)
    places = ("0 0 0.333", "0 0 0", "0 -0.316 0", "0.0825 0 0", "-0.0825 0.384 0", "0 0 0", "0.088 0 0")
    arm = [
        J(f"panda_joint{i}", "revolute", links[i - 1], links[i], place, f"{roll} 0 0", inside=TURN)
        for i, (roll, place) in enumerate(zip(rolls, places, strict=True), start=1)
    ]
    slide = '<limit lower="0" upper="0.04" effort="1" velocity="1"/>'
    return urdf(
        *arm,
        J("panda_joint8", "fixed", "panda_link7", "panda_link8", "0 0 0.107"),
        J("hand_joint", "fixed", "panda_link8", "panda_hand", rpy="0 0 -0.7853981633974483"),
        J("finger_1", "prismatic", "panda_hand", "leftfinger", "0 0 0.0584", axis="0 1 0", inside=slide),
        J(
            "finger_2",
            "prismatic",
            "panda_hand",
            "rightfinger",
            "0 0 0.0584",
            axis="0 -1 0",
            inside=slide + '<mimic joint="finger_1"/>',
        ),
        name="panda",
    )
