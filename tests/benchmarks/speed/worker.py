"""The clock: runs in the environment of the peers, pinned to one core, where kinsym is not installed.

``python -m tests.benchmarks.speed.worker JOB`` reads a list of groups (:mod:`tests.benchmarks.speed.groups`), times the
entries of each group by turns, so that what disturbs one disturbs all, and writes answers and times beside the job.
Processor time counts: other programs on the core take none of it.
"""

from __future__ import annotations

import ctypes
import importlib
import os
import pickle
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tests.benchmarks.speed.arms import ARMS, Floats
from tests.benchmarks.speed.entries import Answer, Entry, Group, Library, Python, Refusal
from tests.benchmarks.speed.peers import Refused

#: A turn of one entry lasts about this long, in seconds.
SLICE = 0.004
#: One that takes longer for all its inputs gets fewer of them; one that takes longer for a single one has one turn.
PATIENCE = 2.0


def pin() -> None:
    """Keep this process on one core, and libraries from starting threads."""
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[variable] = "1"
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def answered(entry: Entry, inputs: Floats) -> tuple[Callable[[], None], Answer]:
    """What is timed, and the answers to all inputs. Raises what a library raises."""
    if isinstance(entry.program, Refusal):
        raise Refused(entry.program.why)
    if isinstance(entry.program, Library):
        return _native(entry.program, inputs)
    return _python(entry.program, ARMS[entry.arm], inputs)


def _native(program: Library, inputs: Floats) -> tuple[Callable[[], None], Answer]:
    run = ctypes.CDLL(str(program.path)).run
    run.argtypes = [ctypes.c_void_p, ctypes.c_long, ctypes.c_void_p, ctypes.c_long, ctypes.c_void_p]
    run.restype = None
    number = len(inputs)
    out, counts = np.zeros((number, program.rows, program.width)), np.zeros(number, dtype=np.intc)
    stride = program.rows * program.width
    run(inputs.ctypes.data, number, out.ctypes.data, stride, counts.ctypes.data)
    answer = [rows[: max(count, 0)].copy() for rows, count in zip(out, counts, strict=True)]
    # The arrays are handed on, not their addresses, so that they live as long as the call.
    return lambda: run(inputs.ctypes.data, number, out.ctypes.data, 0, counts.ctypes.data), answer


def _python(program: Python, arm: Any, inputs: Floats) -> tuple[Callable[[], None], Answer]:
    peer = importlib.import_module(f"tests.benchmarks.speed.peers.{program.peer}")
    subject = peer.load(program.folder, arm.name) if program.folder else arm
    call, read = (peer.batch if program.many else peer.solve)(subject)
    if program.many:
        return lambda: call(inputs), read(call(inputs))
    start = time.process_time()
    call(inputs[0])
    each = list(inputs[: max(1, int(PATIENCE / max(time.process_time() - start, 1e-9)))])

    def run() -> None:
        for one in each:
            call(one)

    return run, [read(call(one)) for one in each]


def timed(group: Group, turns: int) -> dict[str, dict[str, Any]]:
    """Seconds an input for each entry and turn, and the answers; or why there are none."""
    results: dict[str, dict[str, Any]] = {}
    runs: dict[str, tuple[Callable[[], None], int]] = {}
    for entry in group.entries:
        inputs = np.ascontiguousarray(group.inputs[: entry.number])
        try:
            run, answer = answered(entry, inputs)
        except Refused as why:
            results[entry.name] = {"refused": str(why)}
            continue
        except Exception as error:  # a library may raise anything
            results[entry.name] = {"refused": f"{type(error).__name__}: {error}"}
            continue
        start = time.process_time()
        run()
        taken = time.process_time() - start
        runs[entry.name] = (run, 0 if taken > PATIENCE else max(1, round(SLICE / taken)))
        results[entry.name] = {"answer": answer, "seconds": [taken / len(answer)] if taken > PATIENCE else []}
    for _ in range(turns):
        for name, (run, passes) in runs.items():
            if not passes:
                continue
            start = time.process_time()
            for _ in range(passes):
                run()
            taken = time.process_time() - start
            results[name]["seconds"].append(taken / passes / len(results[name]["answer"]))
    return results


def main() -> None:
    """Time every group of the job."""
    pin()
    path = Path(sys.argv[1])
    groups, turns = pickle.loads(path.read_bytes())
    results = {}
    for group in groups:
        print(f"timing: {group.title}, {group.arm} ...", file=sys.stderr, flush=True)
        results[group.title, group.arm] = timed(group, turns)
    path.with_suffix(".results").write_bytes(pickle.dumps(results))


if __name__ == "__main__":
    main()
