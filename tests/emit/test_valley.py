"""Marked roots from which the pose is reached only along a curve on which it hardly changes.

At these poses two borders cross: the root that a border merged leaves the next angle up to half a radian from where it
belongs, while the distance to the pose changes by 1e-8 and less on the way.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.emit.built import needs_compiler
from tests.emit.made_from import Arm, exactly, in_c, in_numpy, lost

WRIST_ON_AXIS_2 = ("three axes meet, 4-6", 18)
AXES_IN_LINE = ("7R locked, spherical ends", 7)
#: Joint vectors by arm; what is 0 is the joint that is moved, from where the arm is singular by so much.
CASES = {
    WRIST_ON_AXIS_2: (
        [3.0681155264115336, -2.001853474008702, 0.0, 1.233929731683188, 0.7433566468344303, 0.1444556533654126],
        -2.0311308013378460 + np.array([2.8e-7, -1.8e-8, 5.6e-10]),
    ),
    AXES_IN_LINE: (
        [-2.66968266123358, 2.142303538866217, 0.0, -1.923500936841139, 2.775543386210246, -1.402001609689345],
        np.array([-2.09e-9, -2.6e-10]),
    ),
}


def joint_vectors(made_up: Arm) -> np.ndarray:
    joints, moved = CASES[made_up]
    q = np.tile(joints, (len(moved), 1))
    q[:, 2] = moved
    return q


@pytest.mark.parametrize("made_up", CASES)
def test_the_module_reaches_them(made_up: Arm) -> None:
    q = joint_vectors(made_up)
    assert not lost(made_up, in_numpy(made_up), q, q)


@needs_compiler
@pytest.mark.parametrize("made_up", CASES)
def test_the_c_reaches_them(made_up: Arm) -> None:
    q = joint_vectors(made_up)
    assert not lost(made_up, in_c(made_up), q, q)


def test_the_exact_walk_reaches_them() -> None:
    q = joint_vectors(WRIST_ON_AXIS_2)
    assert not lost(WRIST_ON_AXIS_2, exactly(WRIST_ON_AXIS_2), q, q)
