"""A chain as six joints with constant links between them, the form in which the general solver reads an arm."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

from kinsym.algebra.field import residue
from kinsym.algebra.nested import nested
from kinsym.general.lines import Motion
from kinsym.general.plan import Link
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.links import Rigid
from kinsym.robot.model import Task

JOINTS = 6

NOTHING: Mapping[str, int] = MappingProxyType({})
TILT = ((2, 3, 6), (3, -6, 2), (6, 2, -3))
"""Seven times a rotation whose z axis is in no special direction; it is its own inverse."""


@dataclass(frozen=True)
class Arm:
    """Six joints: kinds and signs, and B, L1 .. L6 over the ring of the chain.

    ``virtual`` tells that the sixth joint is not the robot's: it turns the tool about an axis through its origin.
    """

    chain: Chain
    kinds: str
    signs: tuple[int, ...]
    base: Rigid
    links: tuple[Rigid, ...]
    virtual: bool

    def link(self, rigid: Rigid) -> Link:
        """A constant transform as it is printed."""
        ring = self.chain.ring
        return Link(
            rotation=tuple(tuple(nested(ring, entry) for entry in row) for row in rigid.rotation),
            translation=tuple(nested(ring, entry) for entry in rigid.translation),
        )

    def values(self, generator: random.Random, zero: Mapping[str, int] = NOTHING) -> list[Motion]:
        """L1 .. L6 modulo the prime, parameters at their values where they have one and anywhere where not.

        ``zero`` holds the constants that are to have another value.
        """
        given = {name: residue(value) for name, value in self.chain.robot.parameters.items() if value is not None}
        names = self.chain.constants.sample(generator, given | dict(zero))
        ring = self.chain.ring
        return [
            (
                [[ring.evaluate(entry, names) for entry in row] for row in link.rotation],
                [ring.evaluate(entry, names) for entry in link.translation],
            )
            for link in self.links
        ]


def six_joints(chain: Chain, task: Task = Task.POSE) -> Arm | None:
    """The arm of a chain with six joints, or with five and one that is added; None for others.

    The added joint turns the tool about its own z axis if the task leaves that turn open. Where the task is the whole
    pose it stands still at a solution, and its axis is tilted: z is often axis 5 itself, about which two joints would
    leave the arm singular at every pose.
    """
    count = len(chain.joints)
    if count not in (JOINTS - 1, JOINTS):
        return None
    virtual = count < JOINTS
    links = tuple(joint.after for joint in chain.joints)
    if virtual:
        turn = Rigid.unit(chain.ring) if task is Task.POSITION_AXIS else _tilt(chain)
        links = (*links[:-1], links[-1].then(chain.ring, turn), turn)
    return Arm(
        chain=chain,
        kinds="".join(joint.kind for joint in chain.joints) + "R" * virtual,
        signs=tuple(joint.sign for joint in chain.joints) + (1,) * virtual,
        base=chain.base,
        links=links,
        virtual=virtual,
    )


def _tilt(chain: Chain) -> Rigid:
    ring = chain.ring
    x, y, z = (tuple(ring.number(Fraction(entry, 7)) for entry in row) for row in TILT)
    return Rigid(rotation=(x, y, z), translation=(ring.zero, ring.zero, ring.zero))
