"""From a robot to everything that is known of it, in one call."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition
from kinsym.inverse.families import Family, families
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.forward import Forward, forward_kinematics
from kinsym.kinematics.jacobian import Jacobian, geometric_jacobian
from kinsym.kinematics.singular import SingularSet, singular_set
from kinsym.kinematics.tasks import fitting_task
from kinsym.robot.model import Robot, Task


@dataclass(frozen=True, kw_only=True)
class Derivation:
    """A robot with its kinematics; ``robot.task`` is the task that was solved."""

    robot: Robot
    chain: Chain
    forward: Forward
    jacobian: Jacobian
    plan: Plan

    @property
    def constants(self) -> tuple[Definition, ...]:
        """The constants of the table that are no polynomials: sqrt(2), cosines and sines of twists."""
        return tuple(Definition(name=n, value=tree_of(e)) for n, e in self.chain.constants.formulas())

    @cached_property
    def singular(self) -> SingularSet:
        """Where the arm is singular: det J in factors, and what each of them means."""
        return singular_set(self.chain, self.plan.task)

    @cached_property
    def families(self) -> tuple[Family, ...]:
        """Where a joint is free, what follows it and what stays constant."""
        return families(self.chain, self.singular, self.plan)


def derive(robot: Robot, *, task: Task | None = None) -> Derivation:
    """Derive forward kinematics, Jacobian and inverse kinematics of a robot.

    Raises :class:`kinsym.errors.NoClosedForm` where no rule applies.

    >>> from kinsym.robot import load
    >>> derive(load("puma560")).plan.maximum
    8
    """
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    jacobian = geometric_jacobian(chain, forward)
    chosen = task or robot.task or fitting_task(chain, jacobian)
    plan = derive_plan(chain, chosen)
    return Derivation(robot=replace(robot, task=chosen), chain=chain, forward=forward, jacobian=jacobian, plan=plan)
