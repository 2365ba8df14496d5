"""``python -m tests.benchmarks.coverage``: the whole table, or part of it.

The full run tries the gallery and 50 arms of each class. The same seed gives the same table but for the times.
``--show CLASS NUMBER`` prints one random arm as a robot file.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
from collections.abc import Iterator

from kinsym.robot import gallery, load, to_toml
from tests.benchmarks.coverage.arms import CLASSES, arm
from tests.benchmarks.coverage.measure import Effort, Result, measure
from tests.benchmarks.coverage.table import GALLERY, PAGE, document, joined, section_of

QUICK = {"arms": 3, "poses": 3, "starts": 120}
FULL = {"arms": 50, "poses": 5, "starts": 300}

Job = tuple[str, str, Effort]


def main() -> None:
    """Measure and print; 1 if an arm broke."""
    options = _options()
    if options.show:
        print(to_toml(arm(options.show[0], int(options.show[1]), options.seed)), end="")
        return
    defaults = QUICK if options.quick else FULL
    count = defaults["arms"] if options.arms is None else options.arms
    effort = Effort(
        poses=options.poses or defaults["poses"], starts=options.starts or defaults["starts"], seed=options.seed
    )
    jobs = list(_jobs(options.only, count, effort, quick=options.quick))
    results: list[Result] = []
    with multiprocessing.Pool(options.workers, maxtasksperchild=50) as pool:
        for result in pool.imap(_run, jobs):
            results.append(result)
            print(f"\r{len(results)} of {len(jobs)} arms", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if len(results) < len(jobs):
        sys.exit(f"the run ended after {len(results)} of {len(jobs)} arms: nothing is written")
    lines = document(results, " ".join(["python -m tests.benchmarks.coverage", *_shown(options)]))
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if options.write:
        old = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        PAGE.write_text(joined(text, section_of(old)), encoding="utf-8", newline="\n")
    sys.exit(1 if any(result.kind == "broken" for result in results) else 0)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.coverage", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a few arms of each class, about a minute")
    parser.add_argument("--arms", type=int, help="random arms of each class (50; 0 for the gallery alone)")
    parser.add_argument("--poses", type=int, help="random poses of each arm (5)")
    parser.add_argument("--starts", type=int, help="starts of the oracle for each pose (300)")
    parser.add_argument("--seed", type=int, default=1, help="another number, other arms and poses (1)")
    parser.add_argument("--only", action="append", metavar="CLASS", help=f"a class, or {GALLERY}; may be repeated")
    parser.add_argument("--workers", type=int, default=2, help="processes (2)")
    parser.add_argument("--write", action="store_true", help=f"also write {PAGE.name}")
    parser.add_argument("--show", nargs=2, metavar=("CLASS", "NUMBER"), help="print one random arm and stop")
    options = parser.parse_args()
    for name in [*(options.only or ()), *(options.show or ())[:1]]:
        if name not in CLASSES and (name != GALLERY or options.show):
            parser.error(f"there is no class {name!r}. Classes: {', '.join([GALLERY, *CLASSES])}")
    if options.show and not options.show[1].isdecimal():
        parser.error(f"--show: {options.show[1]!r} is no number of an arm: give 0, 1, 2, ...")
    return options


def _shown(options: argparse.Namespace) -> list[str]:
    words = ["--quick"] if options.quick else []
    for name in ("arms", "poses", "starts"):
        value = getattr(options, name)
        words += [] if value is None else [f"--{name} {value}"]
    return [*words, f"--seed {options.seed}", *(f'--only "{name}"' for name in options.only or ())]


def _jobs(only: list[str] | None, count: int, effort: Effort, *, quick: bool) -> Iterator[Job]:
    if not only or GALLERY in only:
        yield from ((GALLERY, name, effort) for name in (gallery()[::3] if quick else gallery()))
    for name in CLASSES:
        if not only or name in only:
            yield from ((name, str(number), effort) for number in range(count))


def _run(job: Job) -> Result:
    group, name, effort = job
    robot = load(name) if group == GALLERY else arm(group, int(name), effort.seed)
    return measure(group, robot, effort)


if __name__ == "__main__":
    main()
