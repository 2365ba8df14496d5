"""What the float C of an arm was found to be, as lines and as a section of ``docs/reliability.md``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from kinsym.check.compare import Findings
from kinsym.check.report import FAILED
from kinsym.check.single import (
    CLOSURE_LAW,
    EMPTY_LAW,
    FORWARD_LAW,
    JACOBIAN_LAW,
    KNOWN_LAW,
    ORDINARY_LAW,
    SAME_LAW,
)

WORST = {
    "fk": FORWARD_LAW,
    "Jacobian": JACOBIAN_LAW,
    "regular closure": ORDINARY_LAW,
    "every closure": CLOSURE_LAW,
    "joint error": KNOWN_LAW,
}
COUNTED = {"regular poses": KNOWN_LAW, "singular poses": EMPTY_LAW, "compared": SAME_LAW}
NAMES = ("robot", *COUNTED, *WORST, "failed")

_TEXT = """\
    {command}

The C of each robot with a closed form in single precision (`--real float`), held to the laws of
`kinsym/check/single.py` against the exact walk with 50 digits. A solution is *regular* where the least singular value
of the task's Jacobian, lengths in units of the arm, is above 0.01. *Regular poses*: those of a regular joint vector,
which has to be found; *joint error* is its largest error, times that singular value. *Singular poses*: the others,
most of them made so on purpose. *Compared*: poses of which the regular solutions are the exact walk's, one for one.
Closures are in units of the arm. *Failed* counts laws, those that every C is held to among them.
"""


def row(robot: str, findings: Findings) -> list[str]:
    """The cells of a robot."""
    counts = {law: sum(check.tried for check in findings.checks if check.law == law) for law in COUNTED.values()}
    worst = findings.measured["worst"]
    figures = [next(iter(worst.get(law, {}).values()), "") for law in WORST.values()]
    failed = [check.name for check in findings.checks if check.status == FAILED]
    return [robot, *(str(counts[law]) for law in COUNTED.values()), *figures, str(len(failed))]


def line(cells: Sequence[str]) -> str:
    """Cells for a terminal."""
    return "".join(f"{cell:<{max(len(name), 15) + 2}}" for name, cell in zip(NAMES, cells, strict=True)).rstrip()


def section(rows: Sequence[Sequence[str]], refused: Mapping[str, str], command: str) -> list[str]:
    """The section of the page; ``refused`` are the arms that have no float C."""
    table = [f"| {' | '.join(cells)} |" for cells in (NAMES, ["---"] * len(NAMES), *rows)]
    left = f"Refused, since their solver needs double precision: {', '.join(refused)}." if refused else ""
    return [*_TEXT.format(command=command).splitlines(), "", *table, *(["", left] if left else [])]
