"""Time of the generated C alone: nanoseconds a pose for each robot, compiler and set of flags.

    python -m tests.benchmarks.c_speed [--poses N] [--bind] ROBOT ...

The solutions of random poses are held against the forward kinematics, then the functions take turns with libm's atan2,
called on as many independent arguments, and the least time of many rounds counts. The unit of a machine is its atan2:
ratios hold where nanoseconds do not.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.robot.binding import bind
from kinsym.robot.loading import load

ROBOTS = ("puma560", "ur5", "stanford_arm", "kuka_kr6_r900")
COMPILERS = ("gcc", "clang")
FLAGS = ("-O3 -std=c99", "-O3 -march=native -fno-math-errno")
CLOSURE = 1e-9

DRIVER = """
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "NAME.h"

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

int main(void)
{
    static double q[POSES][UPPER_JOINTS], T[POSES][16];
    double found[UPPER_MAX_SOLUTIONS][UPPER_JOINTS], pose[16], J[6 * UPPER_JOINTS], best[4], worst = 0.0;
    volatile double sink = 0.0;
    long solutions = 0;
    srand(1);
    for (int i = 0; i < POSES; ++i) {
        for (int j = 0; j < UPPER_JOINTS; ++j) {
            q[i][j] = -3.1 + 6.2 * rand() / RAND_MAX;
        }
        NAME_fk(q[i], NULL, T[i]);
        const int count = NAME_ik(T[i], NULL, found);
        for (int k = 0; k < count; ++k) {
            NAME_fk(found[k], NULL, pose);
            for (int e = 0; e < 16; ++e) {
                worst = fmax(worst, fabs(pose[e] - T[i][e]));
            }
        }
        solutions += count;
    }
    best[0] = best[1] = best[2] = best[3] = HUGE_VAL;
    for (int round = 0; round < ROUNDS; ++round) {
        double sum = 0.0;
        const double t0 = now();
        for (int i = 0; i < POSES; ++i) {
            NAME_ik(T[i], NULL, found);
        }
        const double t1 = now();
        for (int i = 0; i < POSES; ++i) {
            NAME_fk(q[i], NULL, pose);
        }
        const double t2 = now();
        for (int i = 0; i < POSES; ++i) {
            NAME_jacobian(q[i], NULL, J);
        }
        const double t3 = now();
        for (int i = 0; i < POSES; ++i) {
            sum += atan2(T[i][1], T[i][0]);
        }
        const double t4 = now();
        sink += sum;
        best[0] = fmin(best[0], t1 - t0);
        best[1] = fmin(best[1], t2 - t1);
        best[2] = fmin(best[2], t3 - t2);
        best[3] = fmin(best[3], t4 - t3);
    }
    printf("[%.17g, %.17g, %.17g, %.17g, %.17g, %.17g]", best[0] / POSES, best[1] / POSES, best[2] / POSES,
           best[3] / POSES, (double)solutions / POSES, worst);
    return 0;
}
"""


def main() -> None:
    """One line a robot, compiler and set of flags."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robots", nargs="*", default=ROBOTS, metavar="ROBOT")
    parser.add_argument("--poses", type=int, default=500)
    parser.add_argument("--rounds", type=int, default=300)
    parser.add_argument("--bind", action="store_true", help="also with the parameters folded in")
    given = parser.parse_args()
    print(f"{'robot':<20}{'compiler and flags':<46}{'ik':>8}{'fk':>8}{'jac':>8}{'atan2':>7}{'ik/atan2':>9}  solutions")
    for name in given.robots:
        for bound in (False, True) if given.bind else (False,):
            for label, figures in rows(name, given.poses, given.rounds, bound):
                ik, fk, jacobian, atan2, solutions, worst = figures
                if not worst < CLOSURE:
                    raise SystemExit(f"{name}, {label}: a solution misses its pose by {worst:.1e}")
                shown = f"{name}{' bound' if bound else ''}"
                times = f"{ik:8.1f}{fk:8.1f}{jacobian:8.1f}{atan2:7.1f}{ik / atan2:9.1f}"
                print(f"{shown:<20}{label:<46}{times}  {solutions:.2f}")


def rows(name: str, poses: int, rounds: int, bound: bool) -> Iterator[tuple[str, list[float]]]:
    """The figures of a robot: ik, fk, jacobian, atan2 in nanoseconds, solutions a pose, worst closure."""
    robot = load(name)
    if bound:
        robot = bind(robot, {key: value for key, value in robot.parameters.items() if value is not None})
    schedule = build_schedule(derive(robot))
    driver = DRIVER.replace("NAME", schedule.name).replace("UPPER", schedule.name.upper())
    driver = driver.replace("POSES", str(poses)).replace("ROUNDS", str(rounds))
    with TemporaryDirectory() as folder:
        for file, text in {**TARGETS["c"](schedule), "driver.c": driver}.items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        for compiler in filter(shutil.which, COMPILERS):
            for flags in FLAGS:
                source, program = f"{schedule.name}.c", str(Path(folder) / "timed")
                # The driver is another translation unit, so that no call is optimised away.
                for command in (
                    [compiler, *flags.split(), "-c", source, "-o", "solver.o"],
                    [compiler, "-O2", "-fno-builtin", "-c", "driver.c", "-o", "driver.o"],
                    [compiler, "solver.o", "driver.o", "-o", program, "-lm"],
                ):
                    subprocess.run(command, cwd=folder, check=True)
                finished = subprocess.run([program], check=True, capture_output=True, text=True)
                yield f"{compiler} {flags}", json.loads(finished.stdout)


if __name__ == "__main__":
    main()
