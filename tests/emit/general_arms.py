"""Schedules of six-joint arms without a closed form, made without the search and without calibration."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from kinsym.derivation import Derivation
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.general.plan import Cut
from kinsym.general.select import general_plan
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


def with_slide(number: int) -> str:
    """The table of the skew arm with one joint that slides."""
    rows = [
        f"{alpha} {a} d{k} 0.3" if k == number else f"{alpha} {a} {d} theta{k}"
        for k, (alpha, a, d) in enumerate(SKEW, 1)
    ]
    return "; ".join(rows)


TABLES |= {f"slide{number}": with_slide(number) for number in range(1, 7)}


@cache
def general_schedule(name: str) -> Schedule:
    """The schedule of an arm by the name of its table, with two cuts that differ in more than the order of x and y."""
    robot = from_inline(TABLES[name], convention="paul", name=name)
    chain = build_chain(robot)
    forward = forward_kinematics(chain)
    plan = general_plan(chain, Task.POSE, "")
    if plan is None:
        raise ValueError(f"{name} has no cut")
    first = plan.cuts[0]
    second = next(cut for cut in plan.cuts if _way(cut) != _way(first))
    return build_schedule(
        Derivation(
            robot=replace(robot, task=Task.POSE),
            chain=chain,
            forward=forward,
            jacobian=geometric_jacobian(chain, forward),
            plan=None,
            general=replace(plan, cuts=(first, second)),
        )
    )


def _way(cut: Cut) -> tuple[int, bool]:
    return cut.dropped, cut.backward
