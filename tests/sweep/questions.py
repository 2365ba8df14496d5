"""What the tests of sweeps ask, and an answer made up point by point."""

from __future__ import annotations

from typing import Any

import numpy as np

from kinsym.robot import load
from kinsym.skeleton import linkage
from kinsym.workspace.grids import slice_grid
from kinsym.workspace.sweeping import Question, Workspace, found

LENGTHS = {"l1": 0.4, "l2": 0.25}
LINKS = {"l1": 0.4, "l2": 0.3, "l3": 0.1}


def planar(points: int = 21, **changes: Any) -> Question:
    """Two links in their plane."""
    robot = load("planar_rr")
    x, y, z = slice_grid(linkage(robot, LENGTHS), points, "z", 0.0)
    return Question(**{"robot": robot, "kind": "reachable", "x": x, "y": y, "z": z, "values": LENGTHS, **changes})


def three_links(points: int = 21, **changes: Any) -> Question:
    """Three links in their plane, 24 orientations a point."""
    robot = load("planar_rrr_craig")
    x, y, z = slice_grid(linkage(robot, LINKS), points, "z", 0.0)
    asked = {"robot": robot, "kind": "reachable", "x": x, "y": y, "z": z, "values": LINKS, "count": 24}
    return Question(**{**asked, **changes})


def some(kind: str = "reachable", shape: tuple[int, int, int] = (3, 2, 1)) -> Workspace:
    """Half metres with 0, 1, .. 4, 0, .. of four orientations reached."""
    axes = [tuple(0.5 * k for k in range(n)) for n in shape]
    question = Question(robot=load("puma560"), kind=kind, x=axes[0], y=axes[1], z=axes[2], count=4)
    return found(question, np.arange(np.prod(shape)) % 5)
