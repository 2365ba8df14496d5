"""``python -m tests.mutation [--sample N] [--seed S] [--minutes M] [--write]``: do the tests see broken mathematics?

It takes ``pip install cosmic-ray`` beside what the tests need, and for each mutant as long as its tests run until one
fails: most die within a second.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from itertools import islice
from math import inf
from pathlib import Path

from tests.mutation.mutants import PACKAGES, places, sample, version
from tests.mutation.reasons import reason, reasons
from tests.mutation.run import Laboratory, Outcome
from tests.mutation.table import judged, line, percent, score, section
from tests.reliability import write_section

TITLE = "The tests see broken mathematics"
ENOUGH = 0.95


def main() -> None:
    """Try mutants, print and perhaps write; 1 if fewer than 95 % of those that change something are killed."""
    options = _options()
    made_by, every = version(), {package: places(package) for package in PACKAGES}
    drawn = sample([place for there in every.values() for place in there], options.seed)
    outcomes: list[Outcome] = []
    end = time.monotonic() + 60.0 * options.minutes
    with tempfile.TemporaryDirectory(prefix="kinsym-") as folder:
        laboratory = Laboratory(Path(folder).resolve())
        for mutant in islice(drawn, options.sample):
            outcomes.append(laboratory.try_out(mutant))
            # a run is long: reasons may be written while it goes on
            print(line(outcomes[-1], reason(mutant, reasons())), flush=True)
            if time.monotonic() > end:
                break
    outcomes.sort(key=lambda one: (PACKAGES.index(one.mutant.package), one.mutant.module, one.mutant.line))
    found = [(outcome, reason(outcome.mutant, reasons())) for outcome in outcomes]
    verdicts = [judged(*one) for one in found]
    print(f"{len(found)} mutants, score {percent(verdicts)} %")
    if options.write:
        command = f"python -m tests.mutation --sample {len(found)} --seed {options.seed}"
        write_section(TITLE, section(found, {name: len(there) for name, there in every.items()}, command, made_by))
    sys.exit(0 if score(verdicts) >= ENOUGH else 1)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__)
    parser.add_argument("--sample", type=int, default=120, help="mutants (120)")
    parser.add_argument("--seed", type=int, default=1, help="another number, other mutants (1)")
    parser.add_argument("--minutes", type=float, default=inf, help="end after so many, with a smaller sample")
    parser.add_argument("--write", action="store_true", help="also write the section of docs/reliability.md")
    options = parser.parse_args()
    if options.sample < 1:
        parser.error("--sample must be 1 at least")
    return options


if __name__ == "__main__":
    main()
