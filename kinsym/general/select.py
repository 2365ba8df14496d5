"""From an arm without a closed form to its plan."""

from __future__ import annotations

from kinsym.general.arm import Arm, six_joints
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.general.ranks import usable
from kinsym.inverse.assemble import size_of
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.tasks import mobility
from kinsym.robot.model import Task


def general_plan(chain: Chain, task: Task, why: str) -> GeneralPlan | None:
    """The plan of a six-joint arm that a verdict leaves without a closed form; None if it has none either."""
    arm = six_joints(chain)
    if arm is None or arm.virtual or task is not Task.POSE or mobility(chain) < len(chain.joints):
        return None
    cuts = usable(arm)
    if not cuts:
        return None
    return _plan(arm, task, why, tuple(cuts))


def _plan(arm: Arm, task: Task, why: str, cuts: tuple[Cut, ...]) -> GeneralPlan:
    return GeneralPlan(
        task=task,
        kinds=arm.kinds,
        signs=arm.signs,
        base=arm.link(arm.base),
        links=tuple(arm.link(link) for link in arm.links),
        cuts=cuts,
        virtual=arm.virtual,
        size=size_of(arm.chain),
        why=why,
    )
