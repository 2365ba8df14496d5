"""Why there is no closed form: which joints are left, and which axes fail to meet or to be parallel."""

from __future__ import annotations

from kinsym.inverse.state import State
from kinsym.kinematics.chain import Chain
from kinsym.robot.model import Task


def verdict(state: State) -> str:
    """One message: what was found, what is left, what blocks it and what would help."""
    chain = state.chain
    known = [v for v in (j.variable for j in chain.joints) if v not in state.known.unknowns()]
    left = ", ".join(state.known.unknowns())
    found = f"after {', '.join(known)} " if known else ""
    count = len(chain.joints)
    if count > 6 or (state.task is not Task.POSE and count > 3):
        reason = f"{count} joints are more than the task {state.task.value} fixes"
        remedy = "Make joints constant or choose a task with more equations"
    else:
        reason = "no rule applies: " + _geometry(chain)
        remedy = "A closed form needs three consecutive axes that meet in a point or are parallel"
    return f"no closed form {found}for {left}: {reason}. {remedy}"


def _geometry(chain: Chain) -> str:
    sizes = [group.last for group in chain.groups]
    if max(sizes) >= 3:
        return "three axes are parallel, but the others do not separate"
    wrist = wrist_offsets(chain)
    if wrist:
        return "the last three axes do not meet (" + ", ".join(wrist) + ")"
    return "the equations of the remaining joints do not separate"


def wrist_offsets(chain: Chain) -> list[str]:
    """The lengths that keep the last three axes apart."""
    result = []
    for first, second in zip(chain.joints[-3:], chain.joints[-2:], strict=False):
        used = sorted({name for entry in first.after.translation[:2] for name in chain.ring.used(entry)})
        if any(first.after.translation[:2]):
            what = " and ".join(used) if used else "a distance"
            result.append(f"the axes of {first.variable} and {second.variable} miss by {what}")
    return result
