"""``python -m tests.unseen [CLASS ...] [--arms 5] [--seed 1] [--workers 2] [--write]``: made-up arms are checked."""

from __future__ import annotations

import argparse
import sys
from multiprocessing import Pool

from tests.benchmarks.coverage.arms import CLASSES
from tests.reliability import write_section
from tests.unseen.measure import Outcome, outcome

TITLE = "Arms that nobody has looked at"

_TEXT = """\
    {command}

Random arms of the classes of `docs/coverage.md` are derived, and their NumPy and C checked as `kinsym derive` checks
them. A law that fails is printed by name, and so is what is raised.

| class | arms | laws | arms with a law that failed |
|---|---|---|---|
"""


def main() -> int:
    """Derive, check, print and perhaps write; 1 if a law failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.unseen", description=__doc__)
    parser.add_argument("classes", nargs="*", metavar="CLASS", help="classes; all by default")
    parser.add_argument("--arms", type=int, default=5, help="arms of each class (5)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (1)")
    parser.add_argument("--workers", type=int, default=2, help="arms that are looked at at a time (2)")
    parser.add_argument("--write", action="store_true", help="also write the section of docs/reliability.md")
    options = parser.parse_args()
    if unknown := set(options.classes) - set(CLASSES):
        parser.error(f"no such class: {', '.join(sorted(unknown))}; there are {', '.join(CLASSES)}")
    jobs = [(name, number, options.seed) for name in options.classes or CLASSES for number in range(options.arms)]
    outcomes = []
    with Pool(options.workers) as pool:
        for found in pool.imap(outcome, jobs):
            outcomes.append(found)
            print(f"{found.name} {found.number}: {found.laws} laws, {len(found.failed)} failed", flush=True)
            for law in found.failed:
                print(f"    {law}", flush=True)
    if options.write:
        named = [f'"{name}"' for name in options.classes]
        command = " ".join(["python -m tests.unseen", *named, f"--arms {options.arms} --seed {options.seed}"])
        write_section(TITLE, section(outcomes, command))
    return 1 if any(found.failed for found in outcomes) else 0


def section(outcomes: list[Outcome], command: str) -> list[str]:
    """The section of the page: a line for each class, then the laws that failed."""
    text = _TEXT.format(command=command).splitlines()
    for name in dict.fromkeys(found.name for found in outcomes):
        arms = [found for found in outcomes if found.name == name]
        failed = sum(bool(found.failed) for found in arms)
        text.append(f"| {name} | {len(arms)} | {sum(found.laws for found in arms)} | {failed} |")
    wrong = [found for found in outcomes if found.failed]
    text += ["", f"In all {len(outcomes)} arms, {len(wrong)} with a law that failed.", ""]
    text += [f"* {found.name}, {found.number}: {law}" for found in wrong for law in found.failed]
    return text


if __name__ == "__main__":
    sys.exit(main())
