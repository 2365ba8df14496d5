"""``python -m tests.sabotage [ROBOT ...] [--sample N] [--seed S] [--language LANGUAGE] [--keep FILE] [--write]``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from kinsym.robot import gallery
from tests import arms
from tests.reliability import write_section
from tests.sabotage.record import Record
from tests.sabotage.run import LANGUAGES, Outcome, Sabotage
from tests.sabotage.table import lines, percent, score, section

TITLE = "The checks catch sabotage"
ENOUGH = 0.99


def main() -> None:
    """Try mutants, print and perhaps write; 1 if fewer than 99 % of those that change a result are caught."""
    options = _options()
    results: dict[tuple[str, str], list[Outcome]] = {}
    record = Record(options.keep)
    for name in options.robots or gallery():
        sabotage = Sabotage(arms.derivation(name))
        for language in options.language or LANGUAGES:
            mutants = sabotage.sample(language, options.sample, options.seed)
            results[name, language] = [
                record.find(name, mutant) or record.keep(sabotage.try_out(mutant)) for mutant in mutants
            ]
            print("\n".join(lines(name, language, results[name, language])), flush=True)
    every = [one for outcomes in results.values() for one in outcomes]
    print(f"{len(every)} mutants, score {percent(every)} %")
    if options.write:
        words = [*options.robots, f"--sample {options.sample}", f"--seed {options.seed}"]
        words += [f"--language {language}" for language in options.language or ()]
        write_section(TITLE, section(results, " ".join(["python -m tests.sabotage", *words])))
    sys.exit(0 if score(every) >= ENOUGH else 1)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.sabotage", description=__doc__)
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="arms; all of the gallery if none is named")
    parser.add_argument("--sample", type=int, default=20, help="mutants of each robot and language (20)")
    parser.add_argument("--seed", type=int, default=1, help="another number, other mutants (1)")
    parser.add_argument("--language", action="append", choices=LANGUAGES, help="may be repeated; all if none is named")
    parser.add_argument("--keep", type=Path, metavar="FILE", help="keep outcomes there, and do not try those again")
    parser.add_argument("--write", action="store_true", help="also write the section of docs/reliability.md")
    options = parser.parse_args()
    if options.sample < 1:
        parser.error("--sample must be 1 at least")
    return options


if __name__ == "__main__":
    main()
