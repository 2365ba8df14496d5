"""The report of one derivation, with or without checks."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import asdict
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kinsym import __version__
from kinsym.check.deviation import recorded
from kinsym.check.figures import singular_figures
from kinsym.check.report import Report
from kinsym.emit.operations import inverse_operations, line_operations
from kinsym.emit.prose.nominal import label
from kinsym.robot.locking import lock_text
from kinsym.robot.summary import to_toml
from kinsym.robot.text import value_text

if TYPE_CHECKING:
    from kinsym.check.compare import Findings
    from kinsym.emit.schedule import NominalStarts, Schedule
    from kinsym.robot.model import Robot


def report_of(robot: Robot, schedule: Schedule, sources: Mapping[str, str], findings: Findings | None) -> Report:
    """Everything the report holds; without findings it says that nothing was checked."""
    return Report(
        name=schedule.name,
        title=schedule.title,
        version=__version__,
        digest=schedule.digest,
        task=schedule.task.value,
        joints=tuple(f"{joint.name} ({joint.kind}{_locked(robot, joint.name)})" for joint in schedule.joints),
        parameters={parameter.name: _value(parameter.value) for parameter in schedule.parameters},
        maximum=schedule.maximum,
        branches=schedule.branches,
        table=to_toml(robot).splitlines(),
        singular=singular_figures(schedule),
        operations={
            "forward": asdict(line_operations(schedule, schedule.forward)),
            **({} if schedule.general else {"inverse": asdict(inverse_operations(schedule))}),
            "jacobian": asdict(line_operations(schedule, schedule.jacobian)),
        },
        checks=findings.checks if findings else (),
        figures=findings.figures if findings else {},
        files={name: hashlib.sha256(text.encode()).hexdigest() for name, text in sources.items()},
        measured=findings.measured if findings else {},
        deviation=None if robot.deviation is None else recorded(robot.deviation),
        nominal=None if schedule.nominal is None else _nominal(schedule.nominal),
        real=schedule.real.name,
    )


def _nominal(nominal: NominalStarts) -> dict[str, Any]:
    """What solves the arm, what that guarantees, and in what the nominal arm differs."""
    return {"says": list(label(nominal.deviation, nominal.band)), **recorded(nominal.deviation)}


def _locked(robot: Robot, name: str) -> str:
    return f", locked: {lock_text(robot.locks[name])}" if name in robot.locks else ""


def _value(value: Fraction | None) -> str | None:
    return None if value is None else value_text(value)
