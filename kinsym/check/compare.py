"""Exact walk, NumPy and compiled C on the same poses: the checks behind every report.

The sources are written into a private folder and used as a user would use them: the module is imported, the C is
compiled with the promised flags. Every law is tried for several choices of the parameters.
"""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kinsym.check.cpp import hold_ikfast
from kinsym.check.examination import Examination
from kinsym.check.ledger import Ledger
from kinsym.check.poses import UNIFORM, Counts, draws, lengths_of
from kinsym.check.report import Check
from kinsym.check.sources import load

if TYPE_CHECKING:
    from kinsym.emit.schedule import Schedule
    from kinsym.robot.model import Robot

Progress = Callable[[str], None]

CHOICES = 3
FULL = Counts(uniform=600, quarter=300, singular=360, pair=60)
DIVIDED = Counts(uniform=210, quarter=100, singular=120, pair=20)
#: Poses that the exact elimination of an arm without a closed form sees in all; each takes it a fifth of a second, and
#: ten times as long where every twist and offset of a table is a number of its own.
ELIMINATED, SLOWLY = 48, 24


@dataclass(frozen=True, kw_only=True)
class Findings:
    """What came out: the laws, the figures of the robot, the figures of this machine."""

    checks: tuple[Check, ...]
    figures: dict[str, Any] = field(default_factory=dict)
    measured: dict[str, Any] = field(default_factory=dict)


def compare(
    robot: Robot, schedule: Schedule, sources: Mapping[str, str], progress: Progress = lambda text: None
) -> Findings:
    """Hold the sources (file name -> text) of one robot to every law.

    Source that cannot be imported, compiled or run is a failed law, not an exception.
    """
    ledger = Ledger()
    poses, solutions = Counter[str](), Counter[int]()
    with tempfile.TemporaryDirectory(prefix="kinsym-") as folder:
        loaded = load(schedule, sources, Path(folder), ledger, progress)
        choices = draws(schedule.parameters, lengths_of(robot), schedule.digest, CHOICES)
        for number, parameters in enumerate(choices):
            progress(f"checking, parameters {number + 1} of {len(choices)}" if len(choices) > 1 else "checking")
            targets = loaded.solvers(parameters)
            examination = Examination(
                robot=robot,
                schedule=schedule,
                parameters=parameters,
                number=number,
                counts=counts_of(schedule),
                targets=targets,
                ledger=ledger,
            )
            examination.run()
            if loaded.ikfast is not None and number == 0:  # the choice that is the table's, which it holds
                rows = examination.samples.of(UNIFORM)
                known, reached = examination.q[rows], examination.poses[rows]
                hold_ikfast(ledger, loaded.ikfast, examination.judge, poses=reached, q=known)
            poses.update(examination.poses_by_kind())
            solutions.update(examination.solution_counts)
        return Findings(
            checks=ledger.checks(),
            figures={
                "poses": sum(poses.values()),
                "poses_by_kind": dict(poses),
                "choices_of_parameters": len(choices),
                "solutions_at_random_poses": _spread(solutions),
            },
            measured={"worst": ledger.worst(), "cases": ledger.tallies, **loaded.versions},
        )


def counts_of(schedule: Schedule) -> Counts:
    """How many samples one choice of the parameters gets; an arm without parameters has one choice alone."""
    number = CHOICES if schedule.parameters else 1
    counts = FULL if number == 1 else DIVIDED
    if schedule.general:
        counts = replace(counts, exact=(SLOWLY if schedule.nominal else ELIMINATED) // number)
    return counts


def _spread(counts: Counter[int]) -> dict[str, int]:
    if not counts:
        return {}
    usual = max(sorted(counts), key=lambda number: counts[number])
    return {"least": min(counts), "usual": usual, "most": max(counts)}
