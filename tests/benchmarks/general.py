"""How well general arms are solved: ``python -m tests.benchmarks.general [POSES [ARMS [CLASS ...]]]``.

For every class of arms: the share of all solutions found, where *all* is the union over the generated module, up to
three other ways round the loop and Newton's method from random joint vectors; the worst closure; microseconds a pose in
NumPy (batches) and in C (-O3, one call a pose, without ctypes' own time).
"""

from __future__ import annotations

import ctypes
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import FLAGS, compile_shared, find_compiler
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.general.arm import six_joints
from kinsym.general.ranks import usable
from kinsym.robot.model import Robot
from tests.general.arms import COBOTS, cobot, joint_vectors, random_robot, run

STARTS = 60
OTHERS = 3


def arms(name: str, count: int) -> Iterator[Robot]:
    """The arms of a class."""
    for seed in range(count):
        if name == "general":
            yield random_robot(100 + seed)
        elif name == "sliding":
            yield random_robot(200 + seed, (1 + seed % 6,))
        elif seed == 0:
            yield cobot(name)


def distinct(module: ModuleType, found: np.ndarray) -> np.ndarray:
    """Joint vectors (k, 6) of one pose without repetitions."""
    kept: list[np.ndarray] = []
    sliding = np.array([kind == "P" for kind in module.JOINT_TYPES])
    for q in found:
        gaps = [np.where(sliding, q - p, (q - p) - 2 * np.pi * np.round((q - p) / (2 * np.pi))) for p in kept]
        if all(np.abs(gap).max() > 1e-5 for gap in gaps):
            kept.append(q)
    return np.array(kept).reshape(-1, 6)


def everything(derivation: Derivation, module: ModuleType, poses: np.ndarray) -> list[np.ndarray]:
    """What the module, other ways round the loop and Newton's method find, by pose."""
    plan, arm = derivation.general, six_joints(derivation.chain)
    assert plan is not None
    assert arm is not None
    cuts = [cut for cut in usable(arm) if cut not in plan.cuts]
    cuts = cuts[:: max(1, len(cuts) // OTHERS)][:OTHERS]
    answers = [module.ik_batch(poses)]
    for cut in cuts:
        other = run(build_schedule(replace(derivation, general=replace(plan, cuts=(cut,)))))
        answers.append(other.ik_batch(poses))
    length = module._lengths(poses, {})
    starts = joint_vectors(module, STARTS * len(poses), seed=1)
    pose = np.repeat(np.arange(len(poses)), STARTS)
    with np.errstate(all="ignore"):
        q, off = module._polished(starts, poses[pose], length[pose], {})
    result = []
    for row in range(len(poses)):
        found = [q_[row][valid[row]] for q_, valid in answers]
        found.append(module._wrapped(q[(pose == row) & (off < 1e-12)]))
        result.append(distinct(module, np.concatenate(found)))
    return result


def in_c(derivation: Derivation, poses: np.ndarray) -> float:
    """Microseconds a pose of the compiled C."""
    compiler = find_compiler()
    if compiler is None:
        return float("nan")
    schedule = build_schedule(derivation)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in TARGETS["c"](schedule).items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        flags = (FLAGS[0], "-O3", *FLAGS[2:])
        library = ctypes.CDLL(
            str(compile_shared(Path(folder), schedule.name, Path(folder), compiler=compiler, flags=flags))
        )
        solver = CSolver(library, schedule, {})
        best = min(_timed(lambda: solver.inverse(poses, np.zeros((len(poses), 6)))) for _ in range(3))
        nothing = poses.copy()
        nothing[:, 0, 0] = np.nan  # refused at once: what is left is the call itself
        call = min(_timed(lambda: solver.inverse(nothing, np.zeros((len(poses), 6)))) for _ in range(3))
    return (best - call) / len(poses) * 1e6


def _timed(work: object) -> float:
    start = time.perf_counter()
    work()  # type: ignore[operator]
    return time.perf_counter() - start


def measure(robot: Robot, count: int) -> tuple[float, int, int, float, float, float]:
    """Seconds to derive, solutions found, all of them, worst closure, microseconds in NumPy and in C."""
    start = time.process_time()
    derivation = derive(robot)
    seconds = time.process_time() - start
    module = run(build_schedule(derivation))
    poses = module.fk(joint_vectors(module, count, seed=2))
    quick = min(_timed(lambda: module.ik_batch(poses)) for _ in range(2)) / count * 1e6
    q, valid = module.ik_batch(poses)
    reached = module.fk(np.where(valid[..., None], q, 0.0))
    gap = np.abs(reached - poses[:, None])
    gap[..., 3] /= module._lengths(poses, {})[:, None, None]
    union = sum(len(found) for found in everything(derivation, module, poses))
    worst = float(gap[valid].max(initial=0.0))
    return seconds, int(valid.sum()), union, worst, quick, in_c(derivation, poses)


def main() -> None:
    """Print a table, one line a class."""
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    poses, count = (*numbers, *(100, 5)[len(numbers) :])[:2]
    names = [word for word in sys.argv[1:] if not word.isdigit()] or ["general", "sliding", *COBOTS]
    print(f"{'class':<10} arms poses  solutions  found %  worst closure  derive s  NumPy us  C us")
    for name in names:
        rows = np.array([measure(robot, poses) for robot in arms(name, count)])
        found, union = rows[:, 1].sum(), rows[:, 2].sum()
        print(
            f"{name:<10} {len(rows):4} {poses * len(rows):5}  {union:9.0f} {100 * found / union:8.4f}  "
            f"{rows[:, 3].max():13.1e}  {rows[:, 0].max():8.2f}  {rows[:, 4].mean():8.0f}  {rows[:, 5].mean():4.0f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
