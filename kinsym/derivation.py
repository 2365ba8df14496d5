"""From a robot to everything that is known of it, in one call."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition
from kinsym.errors import NoClosedForm
from kinsym.general.calibrate import calibrated
from kinsym.general.plan import GeneralPlan
from kinsym.general.select import general_plan
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.forward import Forward, forward_kinematics
from kinsym.kinematics.jacobian import Jacobian, geometric_jacobian
from kinsym.kinematics.tasks import fitting_task
from kinsym.robot.model import Robot, Task


@dataclass(frozen=True, kw_only=True)
class Derivation:
    """A robot with its kinematics; ``robot.task`` is the task that was solved.

    Exactly one of ``plan`` (closed form) and ``general`` (one angle from a polynomial) is there.
    """

    robot: Robot
    chain: Chain
    forward: Forward
    jacobian: Jacobian
    plan: Plan | None
    general: GeneralPlan | None = None

    @property
    def constants(self) -> tuple[Definition, ...]:
        """The constants of the table that are no polynomials: sqrt(2), cosines and sines of twists."""
        return tuple(Definition(name=n, value=tree_of(e)) for n, e in self.chain.constants.formulas())


def derive(robot: Robot, *, task: Task | None = None) -> Derivation:
    """Derive forward kinematics, Jacobian and inverse kinematics of a robot.

    Raises :class:`kinsym.errors.NoClosedForm` where no rule applies and the general solver does not either.

    >>> from kinsym.robot import load
    >>> derive(load("puma560")).plan.maximum
    8
    """
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    jacobian = geometric_jacobian(chain, forward)
    chosen = task or robot.task or fitting_task(chain, jacobian)
    plan, general = _inverse(chain, chosen)
    derivation = Derivation(
        robot=replace(robot, task=chosen),
        chain=chain,
        forward=forward,
        jacobian=jacobian,
        plan=plan,
        general=general,
    )
    return _calibrated(derivation, general) if general else derivation


def _calibrated(derivation: Derivation, general: GeneralPlan) -> Derivation:
    """The derivation with the best ways round the loop; what no way can solve is refused."""
    from kinsym.emit.program import build_schedule

    best = calibrated(build_schedule(derivation))
    if best is None:
        raise NoClosedForm(general.why)
    return replace(derivation, general=best)


def _inverse(chain: Chain, task: Task) -> tuple[Plan | None, GeneralPlan | None]:
    """The closed form, or where there is none the general solver of six joints."""
    try:
        return derive_plan(chain, task), None
    except NoClosedForm as refusal:
        general = general_plan(chain, task, str(refusal))
        if general is None:
            raise
        return None, general
