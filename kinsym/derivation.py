"""Everything that is known of a robot; :func:`kinsym.deriving.derive` finds it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition
from kinsym.general.plan import GeneralPlan
from kinsym.inverse.branches import Branches, branches
from kinsym.inverse.families import Family, families
from kinsym.inverse.plan import Plan
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import Forward
from kinsym.kinematics.jacobian import Jacobian
from kinsym.kinematics.singular import SingularSet, singular_set
from kinsym.robot.model import Robot, Task
from kinsym.robot.stand_in import StandIn

MOST_TERMS = 500
"""An entry of the pose with more terms than this is not written out; of the gallery's arms none has more than 30."""


@dataclass(frozen=True, kw_only=True)
class Derivation:
    """A robot with its kinematics; ``robot.task`` is the task that was solved.

    ``chain`` has every joint, ``solved`` those that no lock holds: forward kinematics and Jacobian are of the one, the
    plan is of the other. Exactly one of ``plan`` (closed form) and ``general`` (one angle from a polynomial) is there.
    Beside ``general`` there may be ``nominal``, the closed form of another arm that is asked first.
    """

    robot: Robot
    chain: Chain
    solved: Chain
    forward: Forward
    jacobian: Jacobian
    plan: Plan | None
    general: GeneralPlan | None
    nominal: Nominal | None = None

    @property
    def constants(self) -> tuple[Definition, ...]:
        """The constants of the table that are no polynomials: sqrt(2), cosines and sines of twists."""
        return _definitions(self.chain)

    @property
    def long(self) -> bool:
        """Whether the entries of the pose, multiplied out, are too long for a page: twists and offsets all over."""
        return any(len(entry) > MOST_TERMS for column in self.forward.columns for entry in column)

    @property
    def held(self) -> tuple[Definition, ...]:
        """What the inverse kinematics knows of the locked joints: where they are held, cosines and sines."""
        values = {name: cell for name, cell in self.robot.locks.items() if cell is not None}
        common = {item.name for item in self.constants}
        return (
            *(Definition(name=name, value=tree_of(cell)) for name, cell in values.items()),
            *(item for item in _definitions(self.solved) if item.name not in common),
        )

    @property
    def angles(self) -> tuple[Angle, ...]:
        """The angles that have names, those between the nodes of either chain."""
        own = {angle.label: angle for angle in self.chain.angles.values()}
        return tuple((own | {a.label: a for a in self.solved.angles.values() if a.label not in own}).values())

    @cached_property
    def singular(self) -> SingularSet:
        """Where the arm is singular: det J in factors, and what each of them means."""
        return singular_set(self.solved, self.robot.task or Task.POSE)

    @cached_property
    def families(self) -> tuple[Family, ...]:
        """Where a step of the closed form leaves a joint free, what follows it and what stays constant."""
        return families(self.solved, self.singular, self.plan) if self.plan else ()

    @cached_property
    def branches(self) -> Branches:
        """The names of the branches, in the order of the generated code."""
        return branches(self.solved, self.plan) if self.plan else Branches(names=(), meanings=())


@dataclass(frozen=True, kw_only=True)
class Nominal:
    """The special arm next to a robot, with its closed form, and what tells the two apart."""

    derivation: Derivation
    stand_in: StandIn


def _definitions(chain: Chain) -> tuple[Definition, ...]:
    return tuple(Definition(name=n, value=tree_of(e)) for n, e in chain.constants.formulas())
