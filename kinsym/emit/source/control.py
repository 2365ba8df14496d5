"""What generated code needs for a controller: names of branches, joint limits, which joints are wound."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any

from kinsym.emit.printer import decimal
from kinsym.emit.schedule import Schedule
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
        "limits": [joint.limits for joint in schedule.joints],
        "winding": winding,
        "held_joints": held,
        "joint_kinds": "".join(
            "L" if locked else joint.kind for joint, locked in zip(schedule.joints, held, strict=True)
        ),
    }


def python_limits(schedule: Schedule) -> str:
    """The limits of the joints as a tuple of pairs."""
    pairs = (
        "(-math.inf, math.inf)" if joint.limits is None else f"({decimal(joint.limits[0])}, {decimal(joint.limits[1])})"
        for joint in schedule.joints
    )
    return _tuple(pairs)


def c_limits(schedule: Schedule, side: int) -> str:
    """The lower (side 0) or upper (side 1) limits as a list of initialisers."""
    infinite = "HUGE_VAL" if side else "-HUGE_VAL"
    return ", ".join(infinite if joint.limits is None else decimal(joint.limits[side]) for joint in schedule.joints)


def _tuple(items: Iterable[str]) -> str:
    parts = list(items)
    return f"({', '.join(parts)}{',' if len(parts) == 1 else ''})"


def _item(text: str) -> list[str]:
    return textwrap.wrap(
        f"{text}.",
        WIDTH - 4,
        initial_indent="  ",
        subsequent_indent="    ",
        break_long_words=False,
        break_on_hyphens=False,
    )
