"""Robots from URDF, the format of ROS: one serial chain of the tree of links becomes an exact table."""

from kinsym.robot.urdf.conversion import from_urdf

__all__ = ["from_urdf"]
