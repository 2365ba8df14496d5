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

from kinsym.methods import euler, pieper, screws, screws_inverse
from kinsym.methods.document import MethodDerivation
from kinsym.robot.model import Robot

Method = Callable[[Robot], MethodDerivation]

METHODS: Mapping[str, Method] = MappingProxyType(
    {
        pieper.NAME: pieper.pieper,
        euler.NAME: euler.zyz,
        screws.NAME: screws.screws,
        screws_inverse.NAME: screws_inverse.screws_inverse,
    }
)
"""Every method by its name on the command line."""

TITLES: Mapping[str, str] = MappingProxyType(
    {module.NAME: module.TITLE for module in (pieper, euler, screws, screws_inverse)}
)
"""What the lecture calls each of them."""

__all__ = ["METHODS", "TITLES", "Method", "MethodDerivation"]
