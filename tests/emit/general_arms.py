"""Schedules of six-joint arms without a closed form, made without the search and without calibration."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from kinsym.derivation import Derivation
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.general.arm import six_joints
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.general.ranks import usable
from kinsym.inverse.assemble import arm_size
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.forward import forward_kinematics
from kinsym.kinematics.jacobian import geometric_jacobian
from kinsym.robot import from_inline
from kinsym.robot.model import Task

SKEW = (
    ("deg(60)", "0.3", "0.2"),
    ("deg(-45)", "0.5", "0.1"),
    ("pi/2", "0.4", "-0.2"),
    ("deg(30)", "0.2", "0.3"),
    ("-pi/2", "0.3", "0.15"),
    ("0", "0.1", "0.2"),
)
"""A made-up arm whose neighbouring axes are all skew: alpha, a, d."""

#: Paul tables, cells alpha a d theta.
TABLES = {
    "skew": "; ".join(f"{alpha} {a} {d} theta{k}" for k, (alpha, a, d) in enumerate(SKEW, 1)),
    # Parameters without values in the table, a joint that is counted backwards, an offset.
    "lengths": "pi/2 a1 d1 theta1; pi/2 a2 d2 -theta2; deg(60) a3 d3 theta3; "
    "pi/2 a4 d4 theta4+pi/2; pi/2 a5 d5 theta5; 0 a6 d6 theta6",
    # The geometry of the FANUC CRX-10iA, symmetric to its mirror image: two ranks are lost at every root.
    "mirrored": "-pi/2 0 0.245 theta1; pi 0.54 0 theta2; -pi/2 0 0 theta3; "
    "pi/2 0 -0.54 theta4; -pi/2 0 0.15 theta5; pi 0 -0.16 theta6",
    # The geometry of the UFACTORY xArm6: axes 2 and 3 parallel, two pairs that meet.
    "cobot": "-pi/2 0 0.267 theta1; 0 0.2895 0 theta2; -pi/2 0.0775 0 theta3; "
    "pi/2 0 0.3425 theta4; -pi/2 0.076 0 theta5; 0 0 0.097 theta6",
}


def with_slides(*numbers: int) -> str:
    """The table of the skew arm with some joints that slide."""
    rows = [
        f"{alpha} {a} d{k} 0.3" if k in numbers else f"{alpha} {a} {d} theta{k}"
        for k, (alpha, a, d) in enumerate(SKEW, 1)
    ]
    return "; ".join(rows)


TABLES |= {f"slide{number}": with_slides(number) for number in range(1, 7)}
TABLES |= {f"slides{one}{two}": with_slides(one, two) for one, two in ((1, 2), (2, 5), (3, 4), (3, 6))}
#: Five joints: a sixth that turns the tool about its own axis completes them.
FIVE = "; ".join(TABLES["skew"].split("; ")[:5])


@cache
def general_schedule(name: str) -> Schedule:
    """The schedule of an arm by the name of its table, with two cuts that differ in more than the order of x and y."""
    return _schedule(name, TABLES[name], Task.POSE, gate=False)


@cache
def five_joints(task: Task) -> Schedule:
    """The skew arm without its last joint: solved for a point and an axis, or for poses of which it reaches few."""
    return _schedule("five", FIVE, task, gate=task is Task.POSE)


def _schedule(name: str, table: str, task: Task, gate: bool) -> Schedule:
    robot = from_inline(table, convention="paul", name=name)
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    arm = six_joints(chain, task)
    if arm is None:
        raise ValueError(f"{name} has neither five nor six joints")
    two_slides = arm.kinds.count("P") == 2
    turning = tuple(number for number, kind in enumerate(arm.kinds, 1) if kind == "R")
    plan = GeneralPlan(
        task=task,
        kinds=arm.kinds,
        signs=arm.signs,
        base=arm.link(arm.base),
        links=tuple(arm.link(link) for link in arm.links),
        cuts=() if two_slides else _two(usable(arm)),
        suppressed=turning if two_slides else (),
        virtual=arm.virtual,
        gate=gate,
        maximum=8 if two_slides else 16,
        size=arm_size(chain),
        why="",
    )
    return build_schedule(
        Derivation(
            robot=replace(robot, task=task),
            chain=chain,
            solved=chain,
            forward=forward,
            jacobian=geometric_jacobian(chain, forward),
            plan=None,
            general=plan,
        )
    )


def _two(cuts: list[Cut]) -> tuple[Cut, Cut]:
    first = cuts[0]
    return first, next(cut for cut in cuts if (cut.dropped, cut.backward) != (first.dropped, first.backward))
