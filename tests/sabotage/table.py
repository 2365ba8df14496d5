"""The score of a mutation run: how many of the mutants that change a result the checks catch, and which they do not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from tests.sabotage.mutant import KINDS
from tests.sabotage.reasons import reason_of, reasons
from tests.sabotage.run import CAUGHT, EQUAL, LANGUAGES, ROUNDING, STILLBORN, SURVIVED, Outcome

_TEXT = """\
    {command}

One change at a time is made in what is generated: a sign flipped, a sine and a cosine swapped, a branch dropped, a
constant changed by a millionth of itself (0 becomes 1e-6), two parameters swapped, a guard removed. `c` and `numpy` are
changes of that source alone; `plan` changes a tree or a step that both languages and the exact walk are made from.
Places are drawn at random from all there are. *Caught*: a law of `kinsym check` fails (that the file is not what kinsym
would write, which `kinsym check` says as well, does not count), or the checks crash or never end. What is not caught is
asked for everything that the code can be asked, hundreds of poses next to singular ones and at borders, noisy, far
and broken ones, windings, odd limits and parameters among it, and held against good code: *equal* to the bit, or to
rounding (1e-9; next to singular poses, the same solutions; of rotations known to few digits, solutions that reach them
as well), or else it has *survived*. A mutant that does not compile is *stillborn*. The score is caught / (caught +
survived). An arm without a closed form is tried with one choice of its parameters, others with the checks' three.
"""


def score(outcomes: Sequence[Outcome]) -> float:
    """The share of those that change a result which the checks catch; 1 if none does."""
    counts = Counter(outcome.outcome for outcome in outcomes)
    changing = counts[CAUGHT] + counts[SURVIVED]
    return counts[CAUGHT] / changing if changing else 1.0


def percent(outcomes: Sequence[Outcome]) -> str:
    """The score with one digit after the point, 100.0 only where nothing survived."""
    return f"{int(1000 * score(outcomes)) / 10:.1f}"


def lines(robot: str, language: str, outcomes: Sequence[Outcome]) -> list[str]:
    """One line for the counts, one for each mutant that is not caught."""
    counts = Counter(outcome.outcome for outcome in outcomes)
    told = ", ".join(
        f"{counts[kind]} {kind}" for kind in (CAUGHT, SURVIVED, EQUAL, ROUNDING, STILLBORN) if counts[kind]
    )
    quiet = [one for one in outcomes if one.outcome != CAUGHT]
    head = f"{robot:<20}{language:<7}{len(outcomes):>5} mutants: {told}; {percent(outcomes)} %"
    return [head, *(f"    {_line(one)}" for one in quiet)]


def section(results: Mapping[tuple[str, str], Sequence[Outcome]], command: str) -> list[str]:
    """The section of the page."""
    every = [one for outcomes in results.values() for one in outcomes]
    text = [*_TEXT.format(command=command).splitlines(), ""]
    text += _table("robot", {robot: _of(results, robot=robot) for robot in dict.fromkeys(key[0] for key in results)})
    text += [
        "",
        *_table("language", {name: _of(results, language=name) for name in LANGUAGES if _of(results, language=name)}),
    ]
    text += ["", *_table("change", {kind: [one for one in every if one.mutant.kind == kind] for kind in KINDS})]
    laws = Counter(one.reason.partition(": ")[2] or one.reason for one in every if one.outcome == CAUGHT)
    text += ["", "| first law that failed | mutants |", "|---|---|"]
    text += [f"| {law} | {number} |" for law, number in laws.most_common()]
    survivors = [one for one in every if one.outcome == SURVIVED]
    text += ["", f"In all {len(every)} mutants; of those that change a result {percent(every)} % are caught."]
    if survivors:
        text += ["", "Survivors, and where they differ from good code:", "", "```text", *map(_line, survivors), "```"]
    quiet = [one for one in every if one.outcome in (EQUAL, ROUNDING)]
    if quiet:
        text += [
            "",
            "Not caught, and equal to good code in all that was asked; the terminal has each of them:",
        ]
        text += ["", "| mutants | by the part of the code, why answers can stay |", "|---|---|"]
        counts = Counter(reason_of(one.robot, one.mutant) for one in quiet)
        text += [f"| {counts[reason]} | {reason} |" for reason in reasons() if counts[reason]]
    return text


def _of(results: Mapping[tuple[str, str], Sequence[Outcome]], robot: str = "", language: str = "") -> list[Outcome]:
    return [
        one
        for (name, written), outcomes in results.items()
        if name == (robot or name) and written == (language or written)
        for one in outcomes
    ]


def _table(head: str, rows: Mapping[str, Sequence[Outcome]]) -> list[str]:
    names = (head, "mutants", CAUGHT, "survived", EQUAL, ROUNDING, STILLBORN, "score, %")
    text = [f"| {' | '.join(names)} |", "|---" * len(names) + "|"]
    for name, outcomes in rows.items():
        counts = Counter(one.outcome for one in outcomes)
        numbers = [counts[kind] for kind in (CAUGHT, SURVIVED, EQUAL, ROUNDING, STILLBORN)]
        text.append(f"| {' | '.join([name, str(len(outcomes)), *map(str, numbers), percent(outcomes)])} |")
    return text


def _line(one: Outcome) -> str:
    reason = f" ({one.reason})" if one.reason else ""
    return f"{one.outcome}{reason}: {one.robot}, {one.mutant}"
