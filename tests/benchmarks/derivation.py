"""Time to derive and emit each robot of the gallery: ``python -m tests.benchmarks.derivation [NAME ...]``.

Every run is a process of its own, as a user starts it, and runs no checks. As in an installed package the bytecode is
there; it goes into a folder of its own. The best of three is shown, in seconds on the wall and of the processor. The
limit is on the latter, so that a busy machine changes little: 1.5 s for the robots of the lecture, 3 s for others.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from kinsym.robot import gallery

RUNS = 3
LIMIT = 3.0
LECTURE = (
    "cylindrical_rpp",
    "elbow_6r_screw",
    "elbow_rrr",
    "fanuc_s900w",
    "planar_rr",
    "planar_rrr_craig",
    "planar_rrr_paul",
    "planar_rrr_screw",
    "puma560",
    "scara",
    "scorbot_5r",
    "spherical_wrist",
    "stanford_arm",
    "stanford_paul",
    "stanford_screw",
    "ur5",
)
LECTURE_LIMIT = 1.5


def seconds(name: str, folder: Path, environment: Mapping[str, str]) -> tuple[float, float]:
    """One cold run of kinsym: wall time and time of the processor."""
    command = [sys.executable, "-m", "kinsym", "derive", name, "--no-check", "--quiet", "-o", str(folder / name)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, env=environment)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print a table; the exit status is 1 if a robot takes too long."""
    slow = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": str(folder / "bytecode"), "PYTHONDONTWRITEBYTECODE": ""}
        seconds("planar_rr", folder, environment)
        print(f"{'':<20} {'wall':>8} {'processor':>11}")
        for name in sys.argv[1:] or gallery():
            wall, taken = map(min, zip(*(seconds(name, folder, environment) for _ in range(RUNS)), strict=True))
            limit = LECTURE_LIMIT if name in LECTURE else LIMIT
            slow += taken > limit
            print(f"{name:<20} {wall:6.2f} s {taken:9.2f} s{'  TOO SLOW' if taken > limit else ''}", flush=True)
    sys.exit(1 if slow else 0)


if __name__ == "__main__":
    main()
