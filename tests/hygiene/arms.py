"""An arm of each kind of generated C."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline, load
from kinsym.robot.model import Robot
from kinsym.robot.snapping import EXACT
from tests.arms import LOCKED, SHAPES, robot
from tests.general.arms import COBOTS, cobot

#: A Puma with twists off by a milliradian and axes that miss each other by fractions of a millimetre.
NOMINAL = (
    "pi/2+0.0007 0.0004 0.4 theta1; 0.0011 0.5 0.0003 theta2; pi/2+0.0004 0.02 0.0002 theta3; "
    "-pi/2-0.0012 0.0003 0.6 theta4; pi/2 -0.0002 0.0005 theta5; 0 0 0.1 theta6"
)
KINDS = ("skew_wrist", "general_pieper", "planar_rpr", "slides_between", "scorbot_5r", "rail_and_elbow", "nominal")
"""Between them they use every kernel, the general solver and sweeps over locked joints."""
MORE = ("sliding_rpr", "jaco", "five_joints", "single", "three_slides", "spheres", "panda")
"""What the gallery does not have besides."""


def robot_of(name: str) -> Robot:
    """A shape, a cobot without a closed form, the nominal arm, or a robot of the gallery."""
    if name == "nominal":
        return replace(from_inline(NOMINAL, convention="paul", name=name, snapping=EXACT), nominal=True)
    if name in COBOTS:
        return cobot(name)
    return robot(name) if name in SHAPES or name in LOCKED else load(name)


@cache
def schedule(name: str) -> Schedule:
    """What is emitted for it."""
    return build_schedule(derive(robot_of(name)))
