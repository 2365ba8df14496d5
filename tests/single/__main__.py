"""``python -m tests.single [ROBOT ...] [--write]``: the C in single precision of arms, by default of the gallery."""

from __future__ import annotations

import argparse
import sys

from kinsym.check.compare import compare
from kinsym.check.report import FAILED
from kinsym.emit import TARGETS
from kinsym.errors import DoesNotApply
from kinsym.robot import gallery
from tests import arms
from tests.reliability import write_section
from tests.single.arms import single_schedule
from tests.single.table import NAMES, line, row, section

TITLE = "Single precision"


def main() -> int:
    """Derive, check, print and perhaps write; 1 if a law failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.single", description=__doc__)
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="arms; all of the gallery if none is named")
    parser.add_argument("--write", action="store_true", help="also write the section of docs/reliability.md")
    options = parser.parse_args()
    rows, refused = [], {}
    print(line(NAMES))
    for name in options.robots or gallery():
        try:
            schedule = single_schedule(name)
        except DoesNotApply as refusal:
            refused[name] = str(refusal)
            print(f"{name}: {refusal}", flush=True)
            continue
        findings = compare(arms.derivation(name).robot, schedule, TARGETS["c"](schedule))
        rows.append(row(name, findings))
        print(line(rows[-1]), flush=True)
        for check in findings.checks:
            if check.status == FAILED:
                print(f"    {check.name}: {check.failed} of {check.tried} {check.note}", flush=True)
    if options.write:
        command = " ".join(["python -m tests.single", *options.robots])
        write_section(TITLE, section(rows, refused, command))
    return 1 if any(cells[-1] != "0" for cells in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
