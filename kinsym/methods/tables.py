"""A robot's table in the convention that a method of the lecture is stated in, and which axes of it meet."""

from __future__ import annotations

from dataclasses import replace

from sympy import Expr, Integer

from kinsym.errors import DoesNotApply
from kinsym.inverse.neighbours import MEET, changes, paul_table
from kinsym.kinematics.chain import build_chain, chain_to_solve
from kinsym.kinematics.convert import convert
from kinsym.robot.model import Convention, Joint, Robot

ZERO = Integer(0)


def unlocked(robot: Robot) -> Robot:
    """The robot with its locked joints as constant rows of Paul's table: the lecture's methods know no locked joint.

    Raises :class:`DoesNotApply` where there is no such table.
    """
    if not robot.locks:
        return robot
    table = paul_table(chain_to_solve(robot))
    if table is None:
        raise DoesNotApply(
            f"no method applies to {robot.name} with {', '.join(robot.locks)} locked: the rows that are left have no "
            f"exact form. Lock at multiples of pi/2, or use the usual derivation."
        )
    return table


def craig_table(robot: Robot) -> Robot:
    """The robot in Craig's convention: Paul's cells a and alpha one row later, other tables by way of the chain.

    Raises :class:`kinsym.errors.RobotError` where the table cannot be written exactly.
    """
    ahead = all(joint.variable is not None for joint in robot.joints[: len(robot.moving)])
    if robot.convention is Convention.CRAIG and ahead:
        return robot
    plain = len(robot.joints) == len(robot.moving)
    if robot.convention is not Convention.PAUL or not plain:
        return convert(robot, Convention.CRAIG)
    joints: list[Joint] = []
    alpha: Expr = ZERO
    a: Expr = ZERO
    for joint in robot.joints:
        joints.append(replace(joint, alpha=alpha, a=a))
        alpha, a = joint.alpha or ZERO, joint.a or ZERO
    if alpha != 0 or a != 0:
        joints.append(Joint(kind="fixed", variable=None, alpha=alpha, a=a, d=ZERO, theta=ZERO))
    return replace(robot, convention=Convention.CRAIG, joints=tuple(joints))


def needs_wrist(robot: Robot, method: str, *, alone: bool = False) -> None:
    """Raise :class:`DoesNotApply` unless the last three of six joints turn about one point.

    With ``alone`` three joints may be a wrist without an arm.
    """
    kinds = [joint.kind for joint in robot.moving]
    if len(kinds) != 6 and not (alone and kinds == ["R"] * 3):
        joints = f"{len(kinds)} joint{'s' * (len(kinds) != 1)}"
        raise DoesNotApply(f"{method} does not apply to {robot.name}: it needs six joints, this arm has {joints}.")
    sliding = [str(number) for number, kind in enumerate(kinds, start=1) if kind == "P" and number > 3]
    if sliding:
        raise DoesNotApply(
            f"{method} does not apply to {robot.name}: the last three joints must turn, joint {sliding[0]} slides."
        )
    table = paul_table(build_chain(robot))
    count = len(kinds)
    lacking = [] if table is None else [c for c in changes(table, range(1, count + 1)) if c.effect == MEET]
    wrist = next((change for change in lacking if change.axes == (count - 2, count - 1, count)), None)
    if wrist is None:
        return
    reason = ", ".join(map(str, wrist.misses))
    others = _meeting(table, [change.axes for change in lacking]) if table is not None else []
    if not others:
        raise DoesNotApply(f"no three axes meet, so {method} does not apply to {robot.name}: {reason}.")
    raise DoesNotApply(
        f"{method} does not apply to {robot.name}: axes 4, 5, 6 do not meet in a point ({reason}); "
        f"axes {', '.join(map(str, others[0]))} do, but the lecture states it for the last three."
    )


def _meeting(table: Robot, lacking: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    """The consecutive triples of turning axes that lack nothing to meet in a point."""
    kinds = [joint.kind for joint in table.joints]
    triples = [(i + 1, i + 2, i + 3) for i in range(len(kinds) - 2) if kinds[i : i + 3] == ["R"] * 3]
    return [triple for triple in triples if triple not in lacking]
