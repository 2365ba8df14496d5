"""A chain as six joints with constant links between them, the form in which the general solver reads an arm."""

from __future__ import annotations

import random
from dataclasses import dataclass

from kinsym.algebra.field import residue
from kinsym.algebra.nested import nested
from kinsym.general.lines import Motion
from kinsym.general.plan import Link
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.links import Rigid

JOINTS = 6


@dataclass(frozen=True)
class Arm:
    """Six joints: kinds and signs, and B, L1 .. L6 over the ring of the chain.

    ``virtual`` tells that the sixth joint is not the robot's: it turns the tool about its own axis.
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

    def values(self, generator: random.Random) -> list[Motion]:
        """L1 .. L6 modulo the prime, parameters at their values where they have one and anywhere where not."""
        given = {name: residue(value) for name, value in self.chain.robot.parameters.items() if value is not None}
        names = self.chain.constants.sample(generator, given)
        ring = self.chain.ring
        return [
            (
                [[ring.evaluate(entry, names) for entry in row] for row in link.rotation],
                [ring.evaluate(entry, names) for entry in link.translation],
            )
            for link in self.links
        ]


def six_joints(chain: Chain) -> Arm | None:
    """The arm of a chain with six joints, or with five completed by a turn about the tool's axis; None for others."""
    count = len(chain.joints)
    if count not in (JOINTS - 1, JOINTS):
        return None
    virtual = count < JOINTS
    links = tuple(joint.after for joint in chain.joints)
    return Arm(
        chain=chain,
        kinds="".join(joint.kind for joint in chain.joints) + "R" * virtual,
        signs=tuple(joint.sign for joint in chain.joints) + (1,) * virtual,
        base=chain.base,
        links=(*links, Rigid.unit(chain.ring)) if virtual else links,
        virtual=virtual,
    )
