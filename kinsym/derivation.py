"""From a robot to everything that is known of it, in one call."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition
from kinsym.deadline import Deadline
from kinsym.errors import NoClosedForm
from kinsym.general.calibrate import calibrated
from kinsym.general.plan import GeneralPlan
from kinsym.general.select import general_plan
from kinsym.inverse.assemble import arm_size
from kinsym.inverse.branches import Branches, branches
from kinsym.inverse.families import Family, families
from kinsym.inverse.locks import check_redundancy
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain, build_chain, chain_to_solve
from kinsym.kinematics.forward import Forward, forward_kinematics
from kinsym.kinematics.jacobian import Jacobian, geometric_jacobian
from kinsym.kinematics.singular import SingularSet, singular_set
from kinsym.kinematics.tasks import fitting_task
from kinsym.robot.model import Robot, Task


@dataclass(frozen=True, kw_only=True)
class Derivation:
    """A robot with its kinematics; ``robot.task`` is the task that was solved.

    ``chain`` has every joint, ``solved`` those that no lock holds: forward kinematics and Jacobian are of the one, the
    plan is of the other. Exactly one of ``plan`` (closed form) and ``general`` (one angle from a polynomial) is there.
    """

    robot: Robot
    chain: Chain
    solved: Chain
    forward: Forward
    jacobian: Jacobian
    plan: Plan | None
    general: GeneralPlan | None

    @property
    def constants(self) -> tuple[Definition, ...]:
        """The constants of the table that are no polynomials: sqrt(2), cosines and sines of twists."""
        return _definitions(self.chain)

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


def derive(robot: Robot, *, task: Task | None = None, deadline: float | None = None) -> Derivation:
    """Derive forward kinematics, Jacobian and inverse kinematics of a robot.

    ``deadline`` is the time in seconds that it may take (default: no limit). Raises
    :class:`kinsym.errors.NoClosedForm` where no rule applies and the general solver does not either, and where the arm
    has more joints than the task can tell, with the joints to lock; :class:`kinsym.errors.DeadlineExceeded` when the
    time is over.

    >>> from kinsym.robot import load
    >>> derive(load("puma560")).plan.maximum
    8
    """
    limit = Deadline(deadline)
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    jacobian = geometric_jacobian(chain, forward)
    solved = chain_to_solve(robot) if robot.locks else chain
    chosen = task or robot.task or fitting_task(chain, solved)
    robot = replace(robot, task=chosen)
    check_redundancy(robot, solved, limit)
    derivation = Derivation(
        robot=robot, chain=chain, solved=solved, forward=forward, jacobian=jacobian, plan=None, general=None
    )
    try:
        plan = derive_plan(solved, chosen, limit)
    except NoClosedForm as refusal:
        general = _general(derivation, refusal, limit)
        if general is None:
            raise
        return replace(derivation, general=general)
    return replace(derivation, plan=replace(plan, size=arm_size(chain)))


def _general(derivation: Derivation, refusal: NoClosedForm, deadline: Deadline) -> GeneralPlan | None:
    """The general solver with its best ways round the loop; None where no way finds the solutions of every pose."""
    from kinsym.emit.program import build_schedule

    task = derivation.robot.task or Task.POSE
    general = general_plan(derivation.solved, task, str(refusal), deadline)
    if general is None:
        return None
    general = replace(general, size=arm_size(derivation.chain))
    return calibrated(build_schedule(replace(derivation, general=general)), deadline)


def _definitions(chain: Chain) -> tuple[Definition, ...]:
    return tuple(Definition(name=n, value=tree_of(e)) for n, e in chain.constants.formulas())
