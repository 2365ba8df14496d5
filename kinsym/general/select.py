"""From an arm without a closed form to its plan.

Five joints are completed by a virtual one. Where the task leaves the turn about the tool's axis open, it makes that
turn; where the task is a whole pose, of which five joints reach few, only solutions count in which it stands still.
"""

from __future__ import annotations

from kinsym.deadline import Deadline
from kinsym.general.arm import Arm, six_joints
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.general.ranks import holds, usable
from kinsym.inverse.assemble import arm_size
from kinsym.inverse.nonzero import conditions_of, zeros
from kinsym.inverse.plan import Nonzero
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.tasks import mobility
from kinsym.robot.model import Task


def general_plan(chain: Chain, task: Task, why: str, deadline: Deadline = NO_LIMIT) -> GeneralPlan | None:
    """The plan of a six-joint arm that a verdict leaves without a closed form; None if it has none either."""
    arm = six_joints(chain, task)
    if arm is None or task not in ((Task.POSE, Task.POSITION_AXIS) if arm.virtual else (Task.POSE,)):
        return None
    if mobility(chain) < len(chain.joints):
        return None
    own = range(1, len(chain.joints) + 1)
    if arm.kinds.count("P") == 2:
        return _plan(arm, task, why, (), tuple(number for number in own if arm.kinds[number - 1] == "R"))
    cuts = [cut for cut in usable(arm, deadline) if cut.suppressed in own]
    return _plan(arm, task, why, tuple(cuts), ()) if cuts else None


def nonzero(chain: Chain, plan: GeneralPlan) -> tuple[Nonzero, ...]:
    """What must not vanish of the table: with it, a way round the loop that the plan takes could not be used."""
    arm = six_joints(chain, plan.task)
    if arm is None:
        return ()
    needed = {name for name, given in zeros(chain) if not all(holds(arm, cut, given) for cut in plan.cuts)}
    return conditions_of(chain, needed)


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
        gate=arm.virtual and task is Task.POSE,
        size=arm_size(arm.chain),
        why=why,
    )
