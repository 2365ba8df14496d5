"""What generated code says of a solution beside its values: its branch and the marks of its steps.

A branch is numbered as if every step had all its roots. Where the roots of a step meet, the first stands for them and
the place of the last is empty: that is where a twin belongs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import prod
from typing import Any

from kinsym.emit.schedule import Schedule
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import KERNELS
from kinsym.emit.source.needs import ENTRIES
from kinsym.emit.source.statements import KernelCall, View


def c_marks(schedule: Schedule, statements: Iterable[View]) -> dict[str, Any]:
    """The expressions of C that the templates need: twin branch, masks of joints by kind of mark."""
    calls, ends, _ = _calls(schedule, statements)

    def way(call: KernelCall, stride: int) -> str:
        root = f"branch / {stride} % {call.roots}" if stride > 1 else f"branch % {call.roots}"
        return f"{stride}u" if call.roots == 2 else f"{stride}u * ({call.roots - 1}u - {root})"

    def bit(call: KernelCall, mark: str) -> str:
        return f"({call.mark} & {mark} ? {_joints(call)}u : 0u)"

    return {
        **_common(schedule, calls, ends),
        "twin": " : ".join([*(f"{c.mark} & IS_BORDER ? {way(c, s)}" for c, s in ends), "0u"]),
        "masks": _masks(calls, ends, bit, "IS_"),
    }


def numpy_marks(schedule: Schedule, statements: Iterable[View]) -> dict[str, Any]:
    """The same for arrays; ``apart`` is how many places a twin lies behind its solution."""
    calls, ends, _ = _calls(schedule, statements)
    entries = [ENTRIES[name] for name in _closure(schedule)]

    def way(call: KernelCall, stride: int) -> str:
        if call.roots == 2:
            return str(stride)
        axes = "".join(", 1" for _ in range(call.level + 1))
        return f"{stride} * np.arange({call.roots - 1}, -1, -1).reshape({call.roots}{axes})"

    def bit(call: KernelCall, mark: str) -> str:
        return f"np.where({call.mark} & {mark}, {_joints(call)}, 0)"

    apart = "0"
    for call, stride in reversed(ends):
        apart = f"np.where({call.mark} & _BORDER, {way(call, stride)}, {apart})"
    return {
        **_common(schedule, calls, ends),
        "apart": apart,
        "masks": _masks(calls, ends, bit, "_"),
        "bits": ", ".join(["mark", "free", "border", *(["apart"] if ends else [])]),
        "rows": f"np.array({[row for row, _ in entries]})",
        "columns": f"np.array({[column for _, column in entries]})",
        "slides": f"np.array({[joint.kind == 'P' for joint in schedule.joints]})",
    }


def _calls(
    schedule: Schedule, statements: Iterable[View]
) -> tuple[list[KernelCall], list[tuple[KernelCall, int]], list[int]]:
    """The kernels that mark, those of them whose branch can end with the stride of their roots, and all strides."""
    calls = [view for view in statements if isinstance(view, KernelCall)]
    strides = [prod(schedule.widths[level + 1 :]) for level in range(schedule.depth)]
    ends = [(c, strides[c.branch - 1]) for c in calls if KERNELS[c.rule].ends and c.branch is not None]
    return calls, ends, strides


def _common(schedule: Schedule, calls: list[KernelCall], ends: list[tuple[KernelCall, int]]) -> dict[str, Any]:
    return {
        "marked": calls,
        "ending": bool(ends),
        "several": bool(calls) and schedule.maximum > 1,
        "sliding": any(joint.kind == "P" for joint in schedule.joints),
        "closure": _closure(schedule),
        "held": [place for place, joint in enumerate(schedule.joints) if joint.name in schedule.locked],
    }


def _closure(schedule: Schedule) -> tuple[str, ...]:
    """The entries of the pose that a solution is compared in."""
    entries = gate_entries(schedule.task)
    return entries.rotation + entries.position


def _masks(
    calls: list[KernelCall], ends: list[tuple[KernelCall, int]], bit: Callable[[KernelCall, str], str], prefix: str
) -> dict[str, str]:
    """Numbers with a bit for each joint whose step has a mark."""
    free = [bit(call, f"{prefix}FREE") for call in calls if KERNELS[call.rule].free]
    border = [bit(call, f"{prefix}BORDER") for call, _ in ends]
    return {"free": " | ".join(free) or "0", "border": " | ".join(border) or "0"}


def _joints(call: KernelCall) -> int:
    return sum(1 << joint for joint in call.joints)
