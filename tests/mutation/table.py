"""The score of a mutation run: how many mutants the tests kill, which ones they cannot, and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence

from tests.mutation.mutants import PACKAGES
from tests.mutation.run import KILLED, SURVIVED, Outcome

EQUAL = "equal"

_TEXT = """\
    {command}

One change at a time is made in the Python of `kinsym/algebra/`, `kinsym/kinematics/` and `kinsym/inverse/`, in a copy
of the tree: an operator, a comparison or a number is another one, a condition is turned round, a loop does nothing, a
decorator is gone. cosmic-ray {version} makes the changes; which, is drawn with the seed, a place first and then one of
the ways to change it. Annotations, `strict`, `kw_only`, `is` for `==` and caches are left alone: nothing that is
computed depends on them. *Killed*: a test of those that `tests/mutation/killers.py` names for the module fails, or runs
for 5 s more than three times the longest of them without the change. *Equal*: no test can fail, for the reason that
stands below. The score is killed / (killed + survived).
"""


def judged(outcome: Outcome, why: str) -> str:
    """Killed, equal or survived."""
    return outcome.outcome if outcome.outcome == KILLED or not why else EQUAL


def score(verdicts: Sequence[str]) -> float:
    """The share of the mutants that change something which the tests kill; 1 if none does."""
    counts = Counter(verdicts)
    changing = counts[KILLED] + counts[SURVIVED]
    return counts[KILLED] / changing if changing else 1.0


def percent(verdicts: Sequence[str]) -> str:
    """The score with one digit after the point, 100.0 only where nothing survived."""
    return f"{int(1000 * score(verdicts)) / 10:.1f}"


def line(outcome: Outcome, why: str) -> str:
    """One mutant and what became of it."""
    verdict = judged(outcome, why)
    told = why if verdict == EQUAL else outcome.reason
    return f"{verdict:<9}{outcome.seconds:>7.1f} s  {outcome.mutant}" + (f"  ({told})" if told else "")


def section(
    outcomes: Sequence[tuple[Outcome, str]], places: Mapping[str, int], command: str, version: str
) -> list[str]:
    """The section of the page: outcomes with the reasons they are equal, the number of places of each package."""
    text = [*_TEXT.format(command=command, version=version).splitlines(), ""]
    rows = {f"`kinsym/{name}/`": [one for one in outcomes if one[0].mutant.package == name] for name in PACKAGES}
    sizes = dict(zip(rows, (places[name] for name in PACKAGES), strict=True))
    text += _table("package", rows, lambda name: f"{sizes[name]}")
    kinds = sorted({_kind(one) for one, _ in outcomes})
    text += ["", *_table("change", {kind: [one for one in outcomes if _kind(one[0]) == kind] for kind in kinds})]
    killers = Counter(_killer(one) for one, _ in outcomes if one.outcome == KILLED)
    text += ["", "| killed by | mutants |", "|---|---|"]
    text += [f"| {name} | {number} |" for name, number in sorted(killers.items(), key=lambda each: (-each[1], each[0]))]
    verdicts = [judged(*one) for one in outcomes]
    text += ["", f"In all {len(outcomes)} mutants; of those that change something {percent(verdicts)} % are killed."]
    for title, verdict in (("Survivors:", SURVIVED), ("Equal, and why:", EQUAL)):
        found = [one for one in outcomes if judged(*one) == verdict]
        if found:
            text += ["", title, ""]
            text += [f"* `{one.mutant}`" + (f": {why}" if verdict == EQUAL else "") for one, why in found]
    return text


def _table(
    head: str, rows: Mapping[str, Sequence[tuple[Outcome, str]]], places: Callable[[str], str] | None = None
) -> list[str]:
    names = [head, *(["places"] if places else []), "mutants", KILLED, "survived", EQUAL, "score, %"]
    text = [f"| {' | '.join(names)} |", "|---" * len(names) + "|"]
    for name, outcomes in rows.items():
        verdicts = [judged(*one) for one in outcomes]
        counts = [str(verdicts.count(verdict)) for verdict in (KILLED, SURVIVED, EQUAL)]
        cells = [name, *([places(name)] if places else []), str(len(outcomes)), *counts, percent(verdicts)]
        text.append(f"| {' | '.join(cells)} |")
    return text


def _kind(outcome: Outcome) -> str:
    """A change by the words of cosmic-ray's name for it: `number replacer`."""
    name = outcome.mutant.operator.partition("_")[0]
    return "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name).strip()


def _killer(outcome: Outcome) -> str:
    """The file of the test that failed, or how the mutant ended."""
    file = outcome.reason.partition("::")[0]
    return f"`{file}`" if file.startswith("tests/") else "its own examples" if file.endswith(".py") else file
