"""Time of the batch functions in C: ``python -m tests.benchmarks.c_batch_speed [NAME ...]``.

For each robot, compiler and set of flags the time of a pose: all solutions by ``ik`` and by ``ik_batch``, and forward
kinematics by ``fk`` and by ``fk_batch``. The four run by turns on the same random poses, the best of many turns is
shown. Every timed answer is verified: ``ik_batch`` gives the solutions of ``ik``, and the worst distance of their
forward kinematics from the pose stands in the last column.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from kinsym.check.compiler import compiler_version
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import load

ROBOTS = ("puma560", "ur5", "kuka_kr6_r900", "stanford_arm")
COMPILERS = ("gcc", "clang")
FLAGS = ("-O3", "-O3 -mavx2 -mfma", "-O3 -march=native")
POSES = 4000  # the answers of so many Puma poses take 1.5 MB

PROGRAM = r"""
#include "@.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N = POSES, J = MACRO_JOINTS, M = MACRO_MAX_SOLUTIONS };
static double q[N][J], T[N][16], again[N][16], one[N * M][J], many[N * M][J];
static int counts[N], batch_counts[N];

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#define TIMED(best, work) do { \
    const double start = seconds(); \
    work; \
    best = fmin(best, seconds() - start); \
} while (0)

int main(void)
{
    double ik = 1e9, ik_batch = 1e9, fk = 1e9, fk_batch = 1e9, closure = 0.0, apart = 0.0;
    int found = 0;
    srand(1);
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < J; ++j) {
            q[i][j] = 6.28 * (rand() / (double)RAND_MAX - 0.5);
        }
        @_fk(q[i], NULL, T[i]);
    }
    for (int turn = 0; turn < 100; ++turn) {
        TIMED(ik, for (int i = 0; i < N; ++i) { counts[i] = @_ik(T[i], NULL, one + M * i); });
        TIMED(ik_batch, @_ik_batch(T[0], N, NULL, NULL, many, batch_counts));
        TIMED(fk, for (int i = 0; i < N; ++i) { @_fk(q[i], NULL, again[i]); });
        TIMED(fk_batch, @_fk_batch(q[0], N, NULL, again[0]));
    }
    for (int i = 0; i < N; ++i) {
        if (counts[i] != batch_counts[i] || counts[i] < 1) {
            return 1;
        }
        found += counts[i];
        for (int k = M * i; k < M * i + counts[i]; ++k) {
            double pose[16];
            for (int j = 0; j < J; ++j) {
                apart = fmax(apart, fabs(remainder(one[k][j] - many[k][j], 6.283185307179586)));
            }
            @_fk(many[k], NULL, pose);
            for (int j = 0; j < 16; ++j) {
                closure = fmax(closure, fabs(pose[j] - T[i][j]));
            }
        }
        for (int j = 0; j < 16; ++j) {
            closure = fmax(closure, fabs(again[i][j] - T[i][j]));
        }
    }
    if (!(apart < 1e-6)) {
        return 2;
    }
    printf("%8.1f %8.1f %8.1f %8.1f %10.2f %10.1e\n", 1e9 * ik / N, 1e9 * ik_batch / N, 1e9 * fk / N,
        1e9 * fk_batch / N, found / (double)N, closure);
    return 0;
}
"""


def measure(schedule: Schedule, compiler: str, flags: str, folder: Path) -> str:
    """A line of figures; raises where an answer is wrong."""
    program = PROGRAM.replace("@", schedule.name).replace("POSES", str(POSES)).replace("MACRO", schedule.name.upper())
    for name, text in (TARGETS["c"](schedule) | {"speed.c": program}).items():
        (folder / name).write_text(text, encoding="utf-8")
    # GNU's C99 has the clock; products and sums stay apart, as with -std=c99.
    command = [compiler, "-std=gnu99", "-ffp-contract=off", *flags.split(), "speed.c", f"{schedule.name}.c"]
    subprocess.run([*command, "-o", "speed", "-lm"], cwd=folder, check=True)
    return subprocess.run([folder / "speed"], check=True, capture_output=True, text=True).stdout.rstrip()


def lines(names: tuple[str, ...]) -> Iterator[str]:
    """The table."""
    processor = [line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    yield processor[0].partition(": ")[2] if processor else "processor unknown"
    yield f"ns a pose: {'ik':>29} {'ik_batch':>8} {'fk':>8} {'fk_batch':>8} {'solutions':>10} {'closure':>10}"
    for compiler in filter(shutil.which, COMPILERS):
        yield compiler_version(compiler)
        for name in names:
            schedule = build_schedule(derive(load(name)))
            for flags in FLAGS:
                with tempfile.TemporaryDirectory() as folder:
                    yield f"{name:<14}{flags:<18}{measure(schedule, compiler, flags, Path(folder))}"


def main() -> None:
    """Print the table for robots whose table has a value for every parameter."""
    for line in lines(tuple(sys.argv[1:]) or ROBOTS):
        print(line, flush=True)


if __name__ == "__main__":
    main()
