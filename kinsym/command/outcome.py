"""What was counted and checked, as lines on the terminal, and the exit status that follows."""

from __future__ import annotations

from pathlib import Path

from kinsym.check.report import FAILED, NOT_RUN, Check, Report
from kinsym.command.screen import Screen


def say_operations(report: Report, screen: Screen) -> None:
    """What each generated function computes, counted exactly; the solver that searches for roots has no count."""
    from kinsym.emit.operations import Operations

    screen.heading("Operations of the C")
    for key, name in (("forward", "fk"), ("inverse", "ik"), ("jacobian", "jacobian")):
        counts = report.operations.get(key)
        told = "as many as its search for roots takes" if counts is None else str(Operations(**counts))
        screen.say(f"  {name:<9} {told}")
    screen.say()


def say_checks(report: Report, screen: Screen) -> None:
    """The laws, one line each, and the figures."""
    screen.heading("Checks")
    if report.verdict == NOT_RUN:
        screen.say("  none (--no-check)\n")
        return
    figures = report.figures
    kinds = ", ".join(f"{count} {kind}" for kind, count in figures["poses_by_kind"].items() if count)
    screen.say(f"  {figures['poses']} poses: {kinds}")
    spread = figures["solutions_at_random_poses"]
    if spread:
        screen.say(
            f"  solutions at a random pose: {spread['least']} to {spread['most']}, usually {spread['usual']},"
            f" at most {report.maximum}"
        )
    for law, checks in _by_law(report).items():
        statuses = {check.status for check in checks}
        mark = "FAILED" if FAILED in statuses else "not run" if statuses == {NOT_RUN} else "ok"
        limit = next((f" ({check.limit})" for check in checks if check.limit), "")
        screen.item(mark, f"{law}{limit}: {', '.join(check.outcome() for check in checks)}")
        for check in checks:
            if check.note:
                screen.item("", f"{check.subject}: {check.note}")
    for case, number in report.measured["cases"].items():
        if number:
            screen.item("note", f"{case}: {number}")
    screen.say()


def _by_law(report: Report) -> dict[str, list[Check]]:
    laws: dict[str, list[Check]] = {}
    for check in report.checks:
        laws.setdefault(check.law, []).append(check)
    return laws


def verdict(report: Report, folder: Path, screen: Screen) -> int:
    """The exit status, and one line on standard error where it is not plain success."""
    for check in report.checks:
        if check.status == NOT_RUN:
            screen.warn(f"{check.name}: not run, {check.note}.")
    if report.verdict != FAILED:
        return 0
    failed = [check.name for check in report.checks if check.status == FAILED]
    screen.warn(
        f"{len(failed)} of {len(report.checks)} checks failed: {'; '.join(failed)}. "
        f"Do not use the files in {folder}; the report there tells more."
    )
    return 1
