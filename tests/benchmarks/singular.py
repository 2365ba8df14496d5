"""What the generated C answers next to singular poses: ``python -m tests.benchmarks.singular [--poses N] [NAME ...]``.

Joint vectors are put where the task's Jacobian loses rank and at 10^-3 .. 10^-16 beside it, and where that happens
twice at once. For each class the table shows, per 100,000 poses: *lost*, no answer though one is known; *missed*,
the known joint vector is neither among the answers nor joined to one by a way on which the pose stays; *copies*, two
answers within 10^-7; *wrong*, a closure above 10^-9 of the arm's size; and the worst closure.
"""

from __future__ import annotations

import argparse
import ctypes
import tempfile
from pathlib import Path

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import compile_shared
from kinsym.check.laws import CLOSURE, PATH, Judge
from kinsym.check.poses import KINDS, UNIFORM, Counts, generator, samples
from kinsym.check.singular import volume_of
from kinsym.check.task import sifted, task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import gallery
from tests import arms

NUMBER = 7
HEAD = f"{'arm':<18}{'class':<16}{'poses':>8}{'lost':>8}{'missed':>8}{'copies':>8}{'wrong':>8}  worst closure"


def rows(name: str, poses: int) -> list[str]:
    """The lines of one arm; parameters without a value are set to 0.3."""
    schedule = build_schedule(arms.derivation(name))
    parameters = {p.name: p.value if p.value is not None else 3 * schedule.tau**0 / 10 for p in schedule.parameters}
    kinematics = TreeKinematics(schedule, parameters)

    def volume(q):
        slope = task_jacobian(kinematics.jacobian(q), kinematics.forward(q), schedule.task, kinematics.size)
        return volume_of(slope)

    counts = Counts(uniform=poses // 4, quarter=poses // 2, singular=poses, pair=poses // 2)
    drawn = samples(schedule.joints, volume, kinematics.size, counts, generator(schedule.digest, NUMBER))
    revolute = np.array([joint.kind == "R" for joint in schedule.joints])
    path = CLOSURE if sifted(schedule) else PATH
    judge = Judge(kinematics, schedule.task, revolute, float(schedule.tau), path)
    targets = kinematics.forward(drawn.q)
    solver = CSolver(_compiled(schedule), schedule, parameters)
    lines = []
    for kind in KINDS:
        mask = drawn.of(kind)
        if not mask.any():
            continue
        q, known, wanted = None, drawn.q[mask], targets[mask]
        q, count = solver.inverse(wanted, np.zeros_like(known) if kind == UNIFORM else known)
        closures = judge.closures(q, wanted)
        valid = np.arange(q.shape[1]) < count[:, None]
        bad = valid & ~(closures <= CLOSURE)
        found = np.concatenate(
            [judge.found(q[i : i + 500], known[i : i + 500], wanted[i : i + 500]) for i in range(0, len(q), 500)]
        )
        lost, missed = int((count == 0).sum()), int((~found).sum())
        share = [f"{100000 * n / len(q):8.0f}" for n in (lost, missed, judge.copies(q), int(bad.any(axis=1).sum()))]
        worst = float(np.where(valid & ~np.isnan(closures), closures, 0.0).max(initial=0.0))
        lines.append(f"{name:<18}{kind:<16}{len(q):>8}{''.join(share)}  {worst:.0e}")
    return lines


def _compiled(schedule: Schedule) -> ctypes.CDLL:
    with tempfile.TemporaryDirectory() as folder:
        for file, text in TARGETS["c"](schedule).items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        return ctypes.CDLL(str(compile_shared(folder, schedule.name, folder)))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="arms; all of the gallery if none is named")
    parser.add_argument("--poses", type=int, default=4000, help="poses next to one singularity (default 4000)")
    options = parser.parse_args()
    print(HEAD)
    for name in options.names or gallery():
        print("\n".join(rows(name, options.poses)), flush=True)


if __name__ == "__main__":
    main()
