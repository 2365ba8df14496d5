"""A condition under which an arm is singular, proved at random postures modulo the prime."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from kinsym.algebra.linear import kernel
from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import Tree
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.meaning import Meaning, meaning
from kinsym.kinematics.singular.posture import Posture
from kinsym.kinematics.singular.zeros import Zero, postures, somewhere
from kinsym.robot.model import Task

#: How many postures of a set are looked at.
POSTURES = 2


@dataclass(frozen=True)
class Arm:
    """A chain with its task, and some of its postures to compare others with."""

    chain: Chain
    task: Task

    @cached_property
    def ordinary(self) -> list[Posture]:
        """Random postures."""
        return somewhere(self.chain, POSTURES)

    def loses(self, posture: Posture) -> bool:
        """Whether the joints can move at a posture without moving what the task asks for."""
        return bool(kernel(posture.jacobian(self.task)))


@dataclass(frozen=True, kw_only=True)
class Condition:
    """A factor of det J: the arm is singular where it is zero; or two expressions that have to be zero at once.

    ``polys`` and, as they are printed, ``values`` must vanish. ``zeros`` are the parts of that set, two angles where a
    factor is one cosine or sine; ``whole`` tells that the arm is singular wherever ``polys`` vanish, not on these parts
    alone. ``power`` is how often the factor occurs.
    """

    polys: tuple[Poly, ...]
    values: tuple[Tree, ...]
    power: int
    zeros: tuple[Zero, ...]
    whole: bool
    meaning: Meaning


def condition(arm: Arm, zeros: list[Zero]) -> Condition | None:
    """Those of some sets of postures at which the rank of J falls, None if it falls on none of them."""
    kept: list[Zero] = []
    singular: list[Posture] = []
    for zero in zeros:
        found = postures(arm.chain, zero, POSTURES)
        if found and all(map(arm.loses, found)):
            kept.append(zero)
            singular += found
    if not kept:
        return None
    polys = tuple(part.poly for part in kept[0])
    return Condition(
        polys=polys,
        values=tuple(nested(arm.chain.ring, poly) for poly in polys),
        power=1,
        zeros=tuple(kept),
        whole=len(kept) == len(zeros),
        meaning=meaning(arm.task, singular, arm.ordinary),
    )
