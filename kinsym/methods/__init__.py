"""The lecture's methods, each as a derivation that one can ask for.

A method takes a robot and returns a :class:`~kinsym.methods.document.MethodDerivation`: sentences, numbered equations,
conditions and solutions, all derived from the robot's own chain and proved before they are stated. A method that does
not fit a robot raises :class:`~kinsym.errors.DoesNotApply`, which says which axes, joints or rows are why.

>>> from kinsym.robot import load
>>> METHODS["pieper"](load("puma560")).solutions[0].unknown
'theta3'
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from kinsym.methods.algebraic import algebraic
from kinsym.methods.decoupled import decoupled
from kinsym.methods.denavit import craig, paul
from kinsym.methods.document import MethodDerivation
from kinsym.methods.euler import zyz
from kinsym.methods.frame_loop import frames
from kinsym.methods.geometric import geometric
from kinsym.methods.half_angle import reduction
from kinsym.methods.loop_closure import loop_closure
from kinsym.methods.pieper import pieper
from kinsym.methods.planar_workspace import workspace
from kinsym.methods.screws import screws
from kinsym.methods.screws_inverse import screws_inverse
from kinsym.robot.model import Robot

Method = Callable[[Robot], MethodDerivation]

METHODS: Mapping[str, Method] = MappingProxyType(
    {
        "loop_closure": loop_closure,
        "craig": craig,
        "paul": paul,
        "screws": screws,
        "frames": frames,
        "workspace": workspace,
        "screws_inverse": screws_inverse,
        "algebraic": algebraic,
        "geometric": geometric,
        "half_angle": reduction,
        "pieper": pieper,
        "zyz": zyz,
        "decoupled": decoupled,
    }
)
"""Every method by its name on the command line, in the order of the lecture."""

__all__ = ["METHODS", "Method", "MethodDerivation"]
