"""What generated code needs for a controller: names of branches, joint limits, which joints are wound."""

from __future__ import annotations

import textwrap
from typing import Any

from kinsym.emit.printer import decimal
from kinsym.emit.schedule import Schedule, Solve
from kinsym.emit.source.wrapping import WIDTH


def control_names(schedule: Schedule) -> dict[str, Any]:
    """The names that the templates of both languages read.

    A schedule that names no branches, because its solutions are the roots of one polynomial, numbers them.
    """
    numbered = tuple(f"solution {number}" for number in range(1, schedule.maximum + 1))
    held = [joint.name in schedule.locked for joint in schedule.joints]
    winding = [joint.kind == "R" and not locked for joint, locked in zip(schedule.joints, held, strict=True)]
    return {
        "branch_names": schedule.branches or numbered,
        "branch_meanings": [line for meaning in schedule.meanings for line in _item(meaning)],
        "families": _families(schedule),
        "winding": winding,
        "held_joints": held,
        "joint_kinds": "".join(
            "L" if locked else joint.kind for joint, locked in zip(schedule.joints, held, strict=True)
        ),
    }


def python_limits(schedule: Schedule) -> list[str]:
    """The limits of the joints as pairs."""
    return [
        "(-math.inf, math.inf)" if joint.limits is None else f"({decimal(joint.limits[0])}, {decimal(joint.limits[1])})"
        for joint in schedule.joints
    ]


def c_limits(schedule: Schedule, side: int) -> str:
    """The lower (side 0) or upper (side 1) limits as a list of initialisers."""
    infinite = "HUGE_VAL" if side else "-HUGE_VAL"
    return ", ".join(infinite if joint.limits is None else decimal(joint.limits[side]) for joint in schedule.joints)


def _families(schedule: Schedule) -> list[tuple[int, int]]:
    """For each joint or sum that a family is named by, its bits and those of all joints that move along the family."""
    place = {joint.name: number for number, joint in enumerate(schedule.joints)}
    steps = [statement.step for statement in schedule.inverse if isinstance(statement, Solve)]
    joints = {step.unknown: [place[name] for name, _ in step.reference] for step in steps}
    found: dict[int, int] = {}
    for family in schedule.singular.families if schedule.singular else ():
        own = sum(1 << joint for joint in joints.get(family.free, ()))
        moving = sum(1 << place[name] for name in family.follows)
        if own and moving:
            found[own] = found.get(own, own) | moving
    return list(found.items())


def _item(text: str) -> list[str]:
    return textwrap.wrap(
        f"{text}.",
        WIDTH - 4,
        initial_indent="  ",
        subsequent_indent="    ",
        break_long_words=False,
        break_on_hyphens=False,
    )
