"""Time to derive and emit each robot of the gallery: ``python -m tests.benchmarks.derivation [NAME ...]``.

Every run is a process of its own, as a user starts it, and runs no checks. The best of three is shown; the limit
is 3 s on two cores.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence

from kinsym.robot import gallery

RUNS = 3
LIMIT = 3.0


def seconds(arguments: Sequence[str]) -> float:
    """The best wall time of a few cold runs of kinsym."""
    best = float("inf")
    for _ in range(RUNS):
        with tempfile.TemporaryDirectory() as folder:
            start = time.perf_counter()
            subprocess.run([sys.executable, "-m", "kinsym", *arguments, *_output(arguments, folder)], check=True)
            best = min(best, time.perf_counter() - start)
    return best


def _output(arguments: Sequence[str], folder: str) -> list[str]:
    return ["--no-check", "--quiet", "-o", folder] if arguments[0] == "derive" else []


def main() -> None:
    """Print a table."""
    slow = 0
    for name in sys.argv[1:] or gallery():
        taken = seconds(["derive", name])
        slow += taken > LIMIT
        print(f"{name:<20} {taken:6.2f} s{'  TOO SLOW' if taken > LIMIT else ''}", flush=True)
    sys.exit(1 if slow else 0)


if __name__ == "__main__":
    main()
