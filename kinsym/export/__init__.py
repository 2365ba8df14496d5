"""A robot with numbers as a file of another program: a URDF skeleton, a DHRobot of the Robotics Toolbox.

To add a program: a function from a robot to text in a module of this package, and an entry here with the ending of
its files.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kinsym.export.rtb import rtb
from kinsym.export.urdf import urdf
from kinsym.robot.model import Robot


@dataclass(frozen=True, kw_only=True)
class Format:
    """How a robot is written for one program, and the name of the file with the robot's name for {}."""

    text: Callable[[Robot], str]
    file: str


FORMATS = {"urdf": Format(text=urdf, file="{}.urdf"), "rtb": Format(text=rtb, file="{}_rtb.py")}

__all__ = ["FORMATS", "Format", "rtb", "urdf"]
