"""The long run in short: nothing is found on good code, and every fault on code that was broken on purpose."""

import pytest

from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests import arms
from tests.emit.built import needs_compiler
from tests.reliability import write_section
from tests.stress.measure import FAULTS, INSIDE, OUTSIDE, PAIR, RANDOM, Stress
from tests.stress.table import lines, section

POSES = 2000
ROBOT = "elbow_rrr"

#: What is changed in the C of the robot, and what that leads to.
BROKEN = {
    "lost": ("t_outer = 2.0 * outer * t,", "t_outer = -2.0 * outer * NEAR * t,"),
    "wrong": ("const double c3 = k_3;", "const double c3 = k_3 * 1.000001;"),
    "copies": (
        "found[count] = marks_of[arm];",
        "found[count] = marks_of[arm]; q[count][0] = q[0][0]; q[count][2] = q[0][2];",
    ),
    "broken": ("q[count][0] = theta1;", "q[count][0] = theta1 + 4.0;"),
    "batch": ("double s1_lanes", "double s1_lanes"),
}


def test_good_code():
    kinds = Stress(arms.derivation(ROBOT)).run(POSES)
    print([k.name for k in kinds])
