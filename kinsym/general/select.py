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
    if arm.kinds.count("P") == 2:
        return _plan(arm, task, why, (), tuple(n for n, kind in enumerate(arm.kinds, start=1) if kind == "R"))
    cuts = usable(arm)
    return _plan(arm, task, why, tuple(cuts), ()) if cuts else None


def _plan(arm: Arm, task: Task, why: str, cuts: tuple[Cut, ...], suppressed: tuple[int, ...]) -> GeneralPlan:
    return GeneralPlan(
        task=task,
        kinds=arm.kinds,
        signs=arm.signs,
        base=arm.link(arm.base),
        links=tuple(arm.link(link) for link in arm.links),
        cuts=cuts,
        suppressed=suppressed,
        maximum=8 if suppressed else 16,
        virtual=arm.virtual,
        size=size_of(arm.chain),
        why=why,
    )
