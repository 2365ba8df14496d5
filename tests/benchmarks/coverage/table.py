"""The results as Markdown: a row an arm of the gallery, a row a class of random arms, singular poses by distance."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from tests.benchmarks.coverage.measure import DISTANCES, Result

PAGE = Path(__file__).resolve().parents[3] / "docs" / "coverage.md"
GALLERY = "gallery"
#: What other libraries do stands last on the page, under this heading, and is written by a command of its own.
HEADING = "## Peers"
OUTCOMES = ("poses", "answered", "lost", "wrong", "copies", "NaN")


def document(results: Sequence[Result], command: str) -> list[str]:
    """The lines of ``docs/coverage.md``."""
    shipped = [result for result in results if result.group == GALLERY]
    drawn = [result for result in results if result.group != GALLERY]
    groups = list(dict.fromkeys(result.group for result in drawn))
    lines = ["# Coverage", "", f"Printed by `{command}`.", "", *LEGEND, ""]
    if shipped:
        lines += ["## Gallery", "", *_table("arm", [(result.name, [result]) for result in shipped]), ""]
    if drawn:
        rows = [(group, [result for result in drawn if result.group == group]) for group in groups]
        lines += ["## Random arms", "", *_table("class", rows), ""]
    lines += ["## Singular poses by distance", "", *_by_distance(results), ""]
    lines += ["## Singular poses of the gallery by joint", "", *_by_joint(shipped), ""] if shipped else []
    return [*lines, "## Arms that fall short", "", *shortcomings(results)]


def joined(page: str, section: str) -> str:
    """The page with ``section``, which begins with the heading, in the place of the one that it has."""
    body = page.partition(HEADING)[0].rstrip("\n")
    return f"{body}\n\n{section}" if section else f"{body}\n"


def section_of(page: str) -> str:
    """The section on other libraries, empty if the page has none."""
    _, heading, rest = page.partition(HEADING)
    return heading + rest


LEGEND = (
    "- *derived*: in closed form (steps of degree two at most) + with a polynomial of higher degree / refused with the",
    "  reason / broken by an error. *time*: processor seconds to derive, median and worst.",
    "- *found*: solutions found of those there are at random poses. There are the joint vector that the pose was made",
    "  from, what damped least squares find from random starts, and what kinsym finds itself; each is proved by",
    "  forward kinematics that share nothing with kinsym.",
    "- *none*: poses without an answer. *wrong*: solutions whose closure is above 1e-9. *copies*: equal solutions.",
    "- *closure*: the largest entry of FK(q) - T that the task asks for, lengths in arm sizes or, where a slide of the",
    "  solution is drawn out further than that, in its length.",
    "- *singular*: poses at zeros of the task's Jacobian and 1e-3 to 1e-15 beside them. *answered*: at least one exact",
    "  solution. *lost*: the joint vector that the pose was made from is not joined to any solution.",
)


def _table(title: str, rows: Iterable[tuple[str, list[Result]]]) -> list[str]:
    lines = [
        f"| {title} | derived | found | % | none | wrong / copies / NaN | closure median, 99.9 %, worst | time"
        " | singular | answered | lost | wrong / copies / NaN |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    lines += [f"| {name} | {' | '.join(_cells(results))} |" for name, results in rows]
    return lines


def _cells(results: list[Result]) -> list[str]:
    kinds = Counter(result.kind for result in results)
    higher = sum(count for kind, count in kinds.items() if kind.startswith("degree"))
    there, found = sum(r.there for r in results), sum(r.found for r in results)
    closures = np.array([value for r in results for value in r.closures])
    seconds = np.array([r.seconds for r in results])
    singular = sum((r.singular_total for r in results), Counter[str]())
    tail = [f"{np.quantile(closures, share):.0e}" for share in (0.5, 0.999, 1.0)] if closures.size else []
    return [
        f"{kinds['closed form']} + {higher} / {kinds['refused']} / {kinds['broken']}",
        f"{found} of {there}" if there else "",
        f"{_floored(found, there)}" if there else "",
        str(sum(r.unanswered for r in results)) if there else "",
        " / ".join(str(sum(counts)) for counts in zip(*((r.wrong, r.copies, r.broken) for r in results), strict=True)),
        ", ".join(tail),
        f"{np.median(seconds):.2f}, {seconds.max():.2f}",
        *(str(singular[key]) for key in ("poses", "answered", "lost")),
        f"{singular['wrong']} / {singular['copies']} / {singular['NaN']}",
    ]


def _floored(found: int, there: int) -> str:
    """A percentage that says 100 only where nothing is missing."""
    return f"{np.floor(1e4 * found / there) / 100:.2f}"


def _by_distance(results: Sequence[Result]) -> list[str]:
    lines = [f"| distance | {' | '.join(OUTCOMES)} |", "|---" * (len(OUTCOMES) + 1) + "|"]
    for distance in DISTANCES:
        total = sum((count for r in results for (_, d), count in r.singular.items() if d == distance), Counter[str]())
        name = f"{distance:.0e}" if distance else "exactly"
        lines.append(f"| {name} | {' | '.join(str(total[key]) for key in OUTCOMES)} |")
    return lines


def _by_joint(results: Sequence[Result]) -> list[str]:
    lines = [f"| arm | joint moved | {' | '.join(OUTCOMES)} |", "|---" * (len(OUTCOMES) + 2) + "|"]
    for result in results:
        for joint in dict.fromkeys(joint for joint, _ in result.singular):
            total = sum((count for (j, _), count in result.singular.items() if j == joint), Counter[str]())
            lines.append(f"| {result.name} | {joint} | {' | '.join(str(total[key]) for key in OUTCOMES)} |")
    return lines


def shortcomings(results: Sequence[Result]) -> list[str]:
    """One line for each arm that is refused or that loses, repeats or invents a solution."""
    lines = []
    for result in results:
        singular = result.singular_total
        faults = {
            "solutions lost": result.there - result.found,
            "wrong": result.wrong,
            "copies": result.copies,
            "NaN": result.broken,
            "singular poses unanswered": singular["poses"] - singular["answered"],
            "singular poses lost": singular["lost"],
            "singular poses with a wrong solution": singular["wrong"],
            "copies at singular poses": singular["copies"],
        }
        words = [f"{name} {count}" for name, count in faults.items() if count]
        if result.reason:
            words.append(f"{result.kind}: {result.reason.splitlines()[0]}")
        if words:
            lines.append(f"- {result.group}, {result.name}: {'; '.join(words)}")
    return lines or ["None."]
