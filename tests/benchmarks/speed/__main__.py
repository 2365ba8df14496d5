"""``python -m tests.benchmarks.speed [--setup] [--write]``: every comparison of ``docs/performance.md``."""

from __future__ import annotations

import argparse
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.benchmarks import environment
from tests.benchmarks.speed import cold, own
from tests.benchmarks.speed.arms import ARMS
from tests.benchmarks.speed.entries import Group
from tests.benchmarks.speed.groups import CROWD, TOOLBOX, Material, groups
from tests.benchmarks.speed.page import Line, document, lines_of
from tests.benchmarks.speed.plot import chart

DOCS = Path(__file__).resolve().parents[3] / "docs"
#: Generators of C among the peers: the name of the library and of its file.
GENERATORS = ((TOOLBOX, "roboticstoolbox"), ("casadi", "casadi"))


def generated(
    arms: Sequence[str], folder: Path, where: Path, absent: dict[str, str], runs: int
) -> dict[str, dict[str, cold.Cold]]:
    """Time cold processes, kinsym's and the generators' by turns; the C that comes out lies in ``folder``."""
    taken: dict[str, dict[str, cold.Cold]] = {}
    for arm in arms:
        found: dict[str, list[cold.Cold]] = {}
        for _ in range(runs):
            print(f"deriving {arm} ...", file=sys.stderr, flush=True)
            found.setdefault("kinsym", []).append(cold.own(arm))
            for name, module in GENERATORS:
                if name not in absent:
                    found.setdefault(name, []).append(cold.peer(module, arm, where, folder))
        taken[arm] = {name: min(tried, key=lambda run: run.seconds or float("inf")) for name, tried in found.items()}
    return taken


def timed(list_of_groups: list[Group], where: Path, folder: Path, turns: int) -> list[tuple[Group, list[Line]]]:
    """Run the worker, in the peers' environment if there is one, and judge its answers."""
    job = folder / "job"
    job.write_bytes(pickle.dumps((list_of_groups, turns)))
    python = environment.interpreter(where)
    command = [str(python) if python.exists() else sys.executable, "-m", "tests.benchmarks.speed.worker", str(job)]
    subprocess.run(command, cwd=cold.ROOT, check=True)
    results = pickle.loads(job.with_suffix(".results").read_bytes())
    return [(group, lines_of(group, results[group.title, group.arm])) for group in list_of_groups]


def picture(outcome: Sequence[tuple[Group, list[Line]]], arm: str) -> str:
    """The plot of one arm: the fastest C of each entry, then Python."""
    best: dict[str, dict[str, float]] = {"C": {}, "Python": {}}
    for group, lines in outcome:
        language = group.title.partition(",")[0]
        if group.arm != arm or "one pose" not in group.title:
            continue
        for line in lines:
            if line.nanoseconds is not None:
                bars = best[language]
                bars[line.name] = min(line.nanoseconds, bars.get(line.name, float("inf")))
    return chart([(f"{ARMS[arm].title}, all solutions: {name}", list(bars.items())) for name, bars in best.items()])


def main() -> None:
    """Set up, generate, compile, time, print, write."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.speed", description=__doc__)
    parser.add_argument("--setup", action="store_true", help="install the peers into an environment of their own")
    parser.add_argument("--environment", type=Path, default=environment.FOLDER, help=f"where ({environment.FOLDER})")
    parser.add_argument("--arm", action="append", choices=tuple(ARMS), help="this arm alone (repeatable)")
    parser.add_argument("--turns", type=int, default=25, help="how often each entry is timed (25)")
    parser.add_argument(
        "--runs", type=int, default=3, help="cold processes for each arm, the first of which compiles (3)"
    )
    parser.add_argument("--crowd", type=int, default=CROWD, help=f"poses of the batches in Python ({CROWD})")
    parser.add_argument("--write", action="store_true", help="also write docs/performance.md and its plot")
    options = parser.parse_args()
    absent = environment.setup(options.environment) if options.setup else environment.missing(options.environment)
    with tempfile.TemporaryDirectory(prefix="kinsym-speed-") as name:
        folder = Path(name)
        others = folder / "others"
        others.mkdir()
        arms = options.arm or tuple(ARMS)
        taken = generated(arms, others, options.environment, absent, options.runs)
        bound, free = (
            {arm: own.prepare(ARMS[arm], folder / kind / arm, bound=kind == own.BOUND) for arm in arms}
            for kind in (own.BOUND, own.FREE)
        )
        refusals = {(name, arm): why for name, why in absent.items() for arm in arms}
        refusals |= {
            (name, arm): run.refused for arm, runs in taken.items() for name, run in runs.items() if run.refused
        }
        material = Material(bound=bound, free=free, others=others, refusals=refusals, crowd=options.crowd)
        outcome = timed(list(groups(material)), options.environment, folder, options.turns)
    outcome.sort(key=lambda item: item[0].title)
    command = f"python -m tests.benchmarks.speed --turns {options.turns} --runs {options.runs} --crowd {options.crowd}"
    text = "\n".join(document(outcome, taken, command)) + "\n"
    print(text, end="")
    if options.write:
        (DOCS / "performance.md").write_text(text, encoding="utf-8", newline="\n")
        (DOCS / "performance.svg").write_text(picture(outcome, arms[0]), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
