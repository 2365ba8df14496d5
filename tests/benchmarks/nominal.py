"""How well calibrated arms are solved through their nominal ones: ``python -m tests.benchmarks.nominal
[POSES [ARMS]]``.

Arms are a UR5 and a Puma 560 whose lengths are off by up to 0.1 to 2 mm and whose angles by up to 0.01 to 0.5 degrees.
The yardstick is the general solver without a nominal arm. Poses are random, then next to the nominal arm's singular
ones: the wrist's, at 0 and 1e-15 to 1e-3 from it.
"""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np

from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import from_inline
from kinsym.robot.model import Robot
from kinsym.robot.snapping import EXACT
from tests.general.arms import run

#: d, a, alpha in quarter turns: Universal Robots, DH parameters; Craig, Introduction to Robotics (Puma 560).
TABLES = {
    "ur5": ((0.0892, 0, 1), (0, -0.425, 0), (0, -0.39243, 0), (0.109, 0, 1), (0.093, 0, -1), (0.082, 0, 0)),
    "puma": ((0.4, 0, 1), (0, 0.4318, 0), (0.15, 0.0203, -1), (0.4318, 0, 1), (0, 0, -1), (0.1, 0, 0)),
}
MILLIMETRES, DEGREES = (0.1, 0.5, 2.0), (0.01, 0.1, 0.5)
DISTANCES = (0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3)


def calibrated(name: str, seed: int) -> Robot:
    """A table whose numbers are off; the seed says by how much at most, too."""
    size = np.array([MILLIMETRES[seed % 3]] * 2 + [DEGREES[seed % 3]] * 2) * [1e-3, 1e-3, np.pi / 180, np.pi / 180]
    rng = np.random.Generator(np.random.PCG64(seed))
    rows = []
    for number, (d, a, alpha) in enumerate(TABLES[name], start=1):
        dd, da, dalpha, dtheta = (f"{x:.9f}" for x in rng.uniform(-size, size))
        rows.append(f"{alpha}*pi/2+{dalpha} {a}+{da} {d}+{dd} theta{number}+{dtheta}".replace("+-", "-"))
    return replace(from_inline(";".join(rows), convention="paul", name=f"{name}_{seed}", snapping=EXACT), nominal=True)


def lacking(q: np.ndarray, valid: np.ndarray, others: np.ndarray, there: np.ndarray) -> int:
    """How many solutions q (N, S, n) are not among the others."""
    gap = np.abs((q[:, :, None] - others[:, None] + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)
    return int((valid & (np.where(there[:, None], gap, np.inf).min(axis=2) > 1e-5)).sum())


def main(poses: int = 2000, arms: int = 3) -> None:
    """Print a line for each arm."""
    print("arm     deviation   in doubt  missed at random poses   beside singular ones   closure")
    total = np.zeros(4, dtype=int)
    for name in TABLES:
        for seed in range(arms):
            derivation = derive(calibrated(name, seed))
            assert derivation.nominal is not None
            schedule = build_schedule(derivation)
            module, general = run(schedule), run(replace(schedule, nominal=None))
            rng = np.random.Generator(np.random.PCG64(1000 + seed))
            counts = []
            worst = 0.0
            q = rng.uniform(-np.pi, np.pi, (poses, 6))
            beside = rng.uniform(-np.pi, np.pi, (poses // 4, 6))
            distance = rng.choice(DISTANCES, len(beside))
            beside[:, 4] = rng.choice((0.0, np.pi), len(beside)) + distance
            for vectors in (q, beside):
                wanted = module.fk(vectors)
                found, valid = module.ik_batch(wanted)
                all_, there = general.ik_batch(wanted)
                missed = lacking(all_, there, found, valid)
                missed += lacking(vectors[:, None], np.ones((len(vectors), 1), bool), found, valid)
                counts += [missed, int(there.sum())]
                if vectors is q:
                    off = np.abs(module.fk(found) - wanted[:, None]).max(axis=(2, 3))
                    worst = float(off[valid].max())
            total += counts
            block = module.fk(q)
            _, doubt = module._corrected(block[:, :3].transpose(1, 2, 0), block, {})
            moved = derivation.nominal.stand_in.deviation
            print(
                f"{name:<7} {moved.position:.0e} m {moved.rotation:.0e}  {doubt.mean():5.1%}   "
                f"{counts[0]:6} of {counts[1]:<9}      {counts[2]:6} of {counts[3]:<9}    {worst:.0e}",
                flush=True,
            )
    print(f"all: {total[0]} of {total[1]} and {total[2]} of {total[3]} missed")


if __name__ == "__main__":
    main(*(int(text) for text in sys.argv[1:3]))
