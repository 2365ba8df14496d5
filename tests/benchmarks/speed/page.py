"""The outcome as Markdown: a table for each thing that was timed, a line an entry, ratios to kinsym."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from kinsym.check.compiler import compiler_version
from tests.benchmarks.environment import PACKAGES
from tests.benchmarks.speed.arms import ARMS, Floats
from tests.benchmarks.speed.cold import Cold
from tests.benchmarks.speed.entries import Goal, Group
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
    goals: tuple[str, ...]


def lines_of(group: Group, results: Mapping[str, dict[str, Any]]) -> list[Line]:
    """The lines of a group. Ratios are taken turn by turn: what slows the machine slows both."""
    seconds = {name: np.array(result["seconds"]) for name, result in results.items() if "seconds" in result}
    first = group.entries[0].name
    if first not in seconds:
        raise RuntimeError(f"{group.title}, {group.arm}: {results[first]['refused']}")
    lines = []
    for entry in group.entries:
        result, title = results[entry.name], ARMS[group.arm].title
        if "refused" in result:
            short = result["refused"].splitlines()[0][:60]
            lines.append(Line(arm=title, name=entry.name, nanoseconds=None, ratio=None, answers=short, goals=()))
            continue
        verdict = judged(group.kind, group.arm, group.inputs[: len(result["answer"])], result["answer"])
        goals = [goal for goal in group.goals if goal.entry == entry.name and (goal.over or first) in seconds]
        solutions = f"{verdict.mean:.2f}, " if group.kind == "ik" else ""
        lines.append(
            Line(
                arm=title,
                name=entry.name,
                nanoseconds=1e9 * float(np.median(seconds[entry.name])),
                ratio=_ratio(seconds, entry.name, first),
                answers=f"{solutions}{verdict.wrong} wrong, {verdict.worst:.0e}",
                goals=tuple(_told(goal, _ratio(seconds, entry.name, goal.over or first)) for goal in goals),
            )
        )
    return lines


def _ratio(seconds: Mapping[str, Floats], name: str, over: str) -> float:
    """The median over the turns that both had: what slows the machine slows both."""
    turns = min(len(seconds[name]), len(seconds[over]))
    return float(np.median(seconds[name][:turns] / seconds[over][:turns]))


def _told(goal: Goal, ratio: float) -> str:
    """A goal, and the ratio where it is not the one in the line or is missed."""
    wanted = f"{'<=' if goal.most else '>='} {goal.ratio:g}{f' x {goal.over}' if goal.over else ''}"
    return wanted if goal.met(ratio) else f"{wanted}: missed, {ratio:.2f}"


def document(
    outcome: Sequence[tuple[Group, list[Line]]],
    cold: Mapping[str, Mapping[str, Cold]],
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
    "Entries of a group run by turns on the same random poses, in one process on one core. *ns*: processor time of one",
    "input, median of the turns. *ratio*: time over that of the group's first entry, median over the turns. *answers*:",
    "solutions of a pose on average, wrong ones (off the pose by more than 1e-6), and the worst miss of the others, by",
    "the product of the rows' matrices, which no library computed. *goal*: what the ratio must be.",
)
COLD = (
    "Processor seconds of a whole process, the least of the runs. kinsym writes NumPy, C and LaTeX, Robotics Toolbox",
    "C. Goal: a ratio of 4 or more.",
)


def _processors() -> list[str]:
    path = Path("/proc/cpuinfo")
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def _row(line: Line) -> str:
    if line.nanoseconds is None or line.ratio is None:
        return f"| {line.arm} | {line.name} | | | refused: {line.answers} | |"
    figures = f"{line.nanoseconds:.0f} | {line.ratio:.2f}"
    return f"| {line.arm} | {line.name} | {figures} | {line.answers} | {'; '.join(line.goals)} |"


def _cold(cold: Mapping[str, Mapping[str, Cold]]) -> list[str]:
    rows = ["| arm | kinsym, s | Robotics Toolbox, s | ratio |", "|---|---:|---:|---:|"]
    for arm, runs in cold.items():
        own, other = runs["kinsym"], runs.get("Robotics Toolbox", Cold(None, "not asked"))
        cells = [f"{run.seconds:.2f}" if run.seconds is not None else run.refused[:60] for run in (own, other)]
        ratio = f"{other.seconds / own.seconds:.1f}" if own.seconds and other.seconds else ""
        rows.append(f"| {ARMS[arm].title} | {cells[0]} | {cells[1]} | {ratio} |")
    return [*rows, "", *COLD]
