"""The outcome as Markdown: a table for each thing that was timed, a line an entry, ratios to kinsym."""

from __future__ import annotations

import platform
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from kinsym.check.compiler import compiler_version
from tests.benchmarks.environment import PACKAGES
from tests.benchmarks.speed.arms import ARMS
from tests.benchmarks.speed.cold import Cold
from tests.benchmarks.speed.entries import Group
from tests.benchmarks.speed.judge import judged
from tests.benchmarks.speed.native import compilers


@dataclass(frozen=True, kw_only=True)
class Line:
    """One entry: nanoseconds (median of the turns), the median ratio of turns to the first entry, and the verdict."""

    arm: str
    name: str
    nanoseconds: float | None
    ratio: float | None
    answers: str
    goal: str
    met: bool = True


def lines_of(group: Group, results: Mapping[str, dict[str, Any]]) -> list[Line]:
    """The lines of a group. Ratios are taken turn by turn: what slows the machine slows both."""
    first = results[group.entries[0].name]
    goals = {goal.entry: goal for goal in group.goals}
    lines = []
    for entry in group.entries:
        result, title = results[entry.name], ARMS[group.arm].title
        if "refused" in result:
            short = result["refused"].splitlines()[0][:60]
            lines.append(Line(arm=title, name=entry.name, nanoseconds=None, ratio=None, answers=short, goal=""))
            continue
        times, base = np.array(result["seconds"]), np.array(first["seconds"])
        ratio = float(np.median(times / base))
        verdict = judged(group.kind, group.arm, group.inputs[: entry.number], result["answer"])
        goal = goals.get(entry.name)
        solutions = f"{verdict.mean:.2f}, " if group.kind == "ik" else ""
        wanted = "" if goal is None else f"{'<=' if goal.most else '>='} {goal.ratio:g}"
        met = goal is None or goal.met(ratio)
        lines.append(
            Line(
                arm=title,
                name=entry.name,
                nanoseconds=1e9 * statistics.median(result["seconds"]),
                ratio=ratio,
                answers=f"{solutions}{verdict.wrong} wrong, {verdict.worst:.0e}",
                goal=wanted and f"{wanted}{'' if met else ': missed'}",
                met=met,
            )
        )
    return lines


def document(
    outcome: Sequence[tuple[Group, list[Line]]],
    cold: Mapping[str, Mapping[str, Cold]],
    absent: Mapping[str, str],
    command: str,
) -> list[str]:
    """The lines of ``docs/performance.md``."""
    lines = ["# Performance", "", f"Printed by `{command}` on this machine:", "", *machine(), "", *LEGEND, ""]
    lines += ["![Times of one pose](performance.svg)", ""]
    for title, part in groupby(outcome, key=lambda item: item[0].title):
        lines += [f"## {title}", "", "| arm | entry | ns | ratio | answers | goal |", "|---|---|---:|---:|---|---|"]
        lines += [_row(line) for _, group in part for line in group]
        lines.append("")
    lines += ["## Derivation and emission in a cold process", "", *_cold(cold), ""]
    if absent:
        lines += ["Not asked: " + "; ".join(f"{name} ({why})" for name, why in absent.items()) + ".", ""]
    return lines[:-1]


def machine() -> list[str]:
    """Processor, compilers, Python, NumPy and the libraries."""
    names = [line.partition(": ")[2] for line in _processors() if line.startswith("model name")]
    peers = ", ".join(PACKAGES.values())
    return [
        f"- {names[0] if names else platform.processor() or platform.machine()}; one core, {platform.system()}",
        *(f"- {compiler_version(compiler)}" for compiler in compilers()),
        f"- Python {platform.python_version()}, NumPy {np.__version__}; {peers}",
    ]


LEGEND = (
    "Entries of a group run by turns on the same random poses, in one process on one core. *ns*: median of the turns,",
    "an input. *ratio*: time over that of the group's first entry, median over the turns. *answers*: solutions of a",
    "pose on average, wrong ones (off the pose by more than 1e-6), and the worst miss of the others, by the product of",
    "the rows' matrices, which no library computed. *goal*: what the ratio must be.",
)


def _processors() -> list[str]:
    path = Path("/proc/cpuinfo")
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def _row(line: Line) -> str:
    if line.nanoseconds is None or line.ratio is None:
        return f"| {line.arm} | {line.name} | | | refused: {line.answers} | |"
    return f"| {line.arm} | {line.name} | {line.nanoseconds:.0f} | {line.ratio:.2f} | {line.answers} | {line.goal} |"


def _cold(cold: Mapping[str, Mapping[str, Cold]]) -> list[str]:
    rows = ["| arm | kinsym, s | Robotics Toolbox, s | ratio |", "|---|---:|---:|---:|"]
    for arm, runs in cold.items():
        own, other = runs["kinsym"], runs.get("Robotics Toolbox", Cold(None, "not asked"))
        cells = [f"{run.seconds:.2f}" if run.seconds is not None else run.refused[:60] for run in (own, other)]
        ratio = f"{other.seconds / own.seconds:.1f}" if own.seconds and other.seconds else ""
        rows.append(f"| {ARMS[arm].title} | {cells[0]} | {cells[1]} | {ratio} |")
    return [
        *rows,
        "",
        "kinsym writes NumPy, C and LaTeX; Robotics Toolbox writes C. The least of the runs. Goal: >= 4.",
    ]
