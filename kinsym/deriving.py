"""From a robot to everything that is known of it, in one call.

It stands above the emitters, as the general solver's best way round its loop is chosen with the code that will be
generated.
"""

from __future__ import annotations

from dataclasses import replace

from kinsym.deadline import Deadline
from kinsym.derivation import Derivation
from kinsym.emit.calibrate import calibrated
from kinsym.emit.program import build_schedule
from kinsym.errors import NoClosedForm
from kinsym.general.plan import GeneralPlan
from kinsym.general.select import general_plan, nonzero
from kinsym.inverse.assemble import arm_size
from kinsym.inverse.locks import check_redundancy
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import build_chain, chain_to_solve
from kinsym.kinematics.forward import forward_kinematics
from kinsym.kinematics.jacobian import geometric_jacobian
from kinsym.kinematics.tasks import fitting_task
from kinsym.robot.model import Robot, Task


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
    task = derivation.robot.task or Task.POSE
    general = general_plan(derivation.solved, task, str(refusal), deadline)
    if general is None:
        return None
    general = replace(general, size=arm_size(derivation.chain))
    general = calibrated(build_schedule(replace(derivation, general=general)), deadline)
    return general and replace(general, nonzero=nonzero(derivation.solved, general))
