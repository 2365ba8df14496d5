"""``python -m tests.stress [ROBOT ...] [--poses 1000000] [--write]``: robots with a closed form at special poses."""

from __future__ import annotations

import argparse
import sys

from kinsym.robot import gallery
from tests import arms
from tests.reliability import write_section
from tests.stress.measure import Kind, Stress
from tests.stress.table import HEAD, lines, section

TITLE = "Long runs"


def main() -> None:
    """Ask, print and perhaps write; 1 if anything was lost, wrong, twice, no number or another in the batch."""
    options = _options()
    results: dict[str, list[Kind]] = {}
    print(HEAD)
    for name in options.robots or gallery():
        derivation = arms.derivation(name)
        if derivation.plan is None:
            print(f"{name:<20}no closed form: `python -m tests.benchmarks.general` asks its solver", flush=True)
            continue
        results[name] = Stress(derivation).run(options.poses)
        print("\n".join(lines(name, results[name])), flush=True)
        if options.write:
            _write(results, list(results), options.poses)  # a run that is cut off leaves what it came to
    if options.write:
        _write(results, options.robots, options.poses)
    sys.exit(1 if any(any(kind.faults.values()) for kinds in results.values() for kind in kinds) else 0)


def _write(results: dict[str, list[Kind]], robots: list[str], poses: int) -> None:
    write_section(TITLE, section(results, " ".join(["python -m tests.stress", *robots, f"--poses {poses}"])))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.stress", description=__doc__)
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="arms; all of the gallery if none is named")
    parser.add_argument("--poses", type=int, default=1_000_000, help="poses of each robot (1000000)")
    parser.add_argument("--write", action="store_true", help="also write the section of docs/reliability.md")
    options = parser.parse_args()
    if options.poses < 1000:
        parser.error("--poses must be 1000 at least, so that every kind of pose is there")
    return options


if __name__ == "__main__":
    main()
