"""What the checks of ``kinsym derive`` say of an arm that nobody has looked at."""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.check.compare import compare
from kinsym.check.report import FAILED
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from tests.benchmarks.coverage.arms import arm

LANGUAGES = ("numpy", "c")


@dataclass(frozen=True)
class Outcome:
    """One arm of a class: its number, how many laws were tried and which of them failed, or what was raised."""

    name: str
    number: int
    laws: int
    failed: tuple[str, ...]


def outcome(job: tuple[str, int, int]) -> Outcome:
    """Derive and check one arm, given by class, number and seed; what is raised counts as a failed law."""
    name, number, seed = job
    try:
        robot = arm(name, number, seed)
        schedule = build_schedule(derive(robot))
        sources = {file: text for language in LANGUAGES for file, text in TARGETS[language](schedule).items()}
        checks = compare(robot, schedule, sources).checks
    except Exception as error:  # whatever a user would see
        return Outcome(name, number, 0, (f"{type(error).__name__}: {error}",))
    failed = [f"{check.name}: {check.failed} of {check.tried}" for check in checks if check.status == FAILED]
    return Outcome(name, number, len(checks), tuple(failed))
