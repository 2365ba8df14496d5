"""The entries of the pose that a task is about.

An arm with fewer joints than its task has equations reaches only some poses; each of its solutions is put through
the forward kinematics and compared with the pose in these entries.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.robot.model import Task


@dataclass(frozen=True, kw_only=True)
class GateEntries:
    """Names of entries without a unit, and of entries that are lengths."""

    rotation: tuple[str, ...] = ()
    position: tuple[str, ...] = ()


_U, _V, _W, _P = (tuple(f"{column}_{row}" for row in "xyz") for column in "uvwp")

_ENTRIES = {
    Task.POSE: GateEntries(rotation=_U + _V + _W, position=_P),
    Task.POSITION: GateEntries(position=_P),
    Task.ORIENTATION: GateEntries(rotation=_U + _V + _W),
    Task.PLANAR: GateEntries(rotation=("u_x", "u_y"), position=("p_x", "p_y")),
    Task.SCARA: GateEntries(rotation=("u_x", "u_y"), position=_P),
    Task.POSITION_AXIS: GateEntries(rotation=_W, position=_P),
}


def gate_entries(task: Task) -> GateEntries:
    """The entries that a solution of a task must reach."""
    return _ENTRIES[task]
