"""From a robot to everything that is known of it, in one call.

It stands above the emitters, as the general solver's best way round its loop is chosen with the code that will be
generated.
"""

from __future__ import annotations

from dataclasses import replace

from kinsym.deadline import Deadline
from kinsym.derivation import Derivation, Nominal
from kinsym.emit.calibrate import calibrated
from kinsym.emit.program import build_schedule
from kinsym.errors import NoClosedForm, RobotError
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
from kinsym.robot.stand_in import stand_in

ASKEW = "axes that meet or are parallel in the nominal arm miss each other in this one, so that it has no closed form"
"""Why the general solver stands behind a nominal arm; the verdict of the search would name the least of the misses."""


def derive(robot: Robot, *, task: Task | None = None, deadline: float | None = None) -> Derivation:
    """Derive forward kinematics, Jacobian and inverse kinematics of a robot.

    ``deadline`` is the time in seconds that it may take (default: no limit). Raises
    :class:`kinsym.errors.NoClosedForm` where no rule applies and the general solver does not either, and where the arm
    has more joints than the task can tell, with the joints to lock; :class:`kinsym.errors.DeadlineExceeded` when the
    time is over; :class:`kinsym.errors.RobotError` where ``robot.nominal`` asks for what is not there.

    >>> from kinsym.robot import load
    >>> derive(load("puma560")).plan.maximum
    8
    """
    limit = Deadline(deadline)
    if robot.nominal:
        return _beside_nominal(robot, task, limit)
    derivation = _kinematics(robot, task)
    check_redundancy(derivation.robot, derivation.solved, limit)
    try:
        return _closed_form(derivation, limit)
    except NoClosedForm as refusal:
        general = _general(derivation, str(refusal), limit)
        if general is None:
            raise
        return replace(derivation, general=general)


def _kinematics(robot: Robot, task: Task | None) -> Derivation:
    """What needs no search: chains, forward kinematics, Jacobian and the task."""
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    solved = chain_to_solve(robot) if robot.locks else chain
    return Derivation(
        robot=replace(robot, task=task or robot.task or fitting_task(chain, solved)),
        chain=chain,
        solved=solved,
        forward=forward,
        jacobian=geometric_jacobian(chain, forward),
        plan=None,
        general=None,
    )


def _closed_form(derivation: Derivation, deadline: Deadline) -> Derivation:
    """The derivation with its plan; NoClosedForm where the search finds none."""
    plan = derive_plan(derivation.solved, derivation.robot.task or Task.POSE, deadline)
    return replace(derivation, plan=replace(plan, size=arm_size(derivation.chain)))


def _beside_nominal(robot: Robot, task: Task | None, deadline: Deadline) -> Derivation:
    """The closed form of the nominal arm, and the general solver of the robot for the poses where that is in doubt.

    RobotError where the nominal arm has no closed form, where the robot has one of its own, and where the general
    solver does not apply.
    """
    found = stand_in(robot)
    derivation = _kinematics(found.true, task)
    check_redundancy(derivation.robot, derivation.solved, deadline)
    where = f"nominal arm of {robot.name}"
    try:
        nominal = _closed_form(_kinematics(found.nominal, derivation.robot.task), deadline)
    except NoClosedForm:
        raise RobotError(
            "the special arm next to this one has no closed form either",
            where=where,
            remedy="Leave --nominal (nominal = true) out: the arm is solved without it.",
        ) from None
    try:
        _closed_form(derivation, deadline)
    except NoClosedForm:
        general = _general(derivation, ASKEW, deadline)
        if general is None or general.gate:
            raise RobotError(
                "Newton's steps need the general solver where they are in doubt, and it takes arms with six joints to"
                " solve for, or with five for a position and an axis",
                where=where,
                remedy="Lock a joint (--lock), or solve the nominal arm by itself.",
            ) from None
        return replace(derivation, general=general, nominal=Nominal(derivation=nominal, stand_in=found))
    raise RobotError(
        "the arm has a closed form as it stands",
        where=where,
        remedy="Leave --nominal (nominal = true) out: nothing has to be corrected.",
    )


def _general(derivation: Derivation, why: str, deadline: Deadline) -> GeneralPlan | None:
    """The general solver with its best ways round the loop; None where no way finds the solutions of every pose."""
    task = derivation.robot.task or Task.POSE
    general = general_plan(derivation.solved, task, why, deadline)
    if general is None:
        return None
    general = replace(general, size=arm_size(derivation.chain))
    general = calibrated(build_schedule(replace(derivation, general=general)), deadline)
    return general and replace(general, nonzero=nonzero(derivation.solved, general))
