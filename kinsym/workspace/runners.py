"""Who does the tasks of a sweep: this process, several of them, or a Dask cluster.

A task is a question and a range of points. The generated module cannot be sent to another process, so each derives the
arm once and keeps it; the numbers are the same wherever they are found.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from kinsym.errors import KinsymError
from kinsym.live import LiveArm, live
from kinsym.workspace.sweeping import Question, evaluate

if TYPE_CHECKING:
    from kinsym.workspace.sweeping import Counts

Part = tuple[int, int]
Found = tuple[int, int, "Counts"]
_MOST_WAITING = 4
"""Tasks that wait for each process, so that what is found comes back soon and none is idle."""
_PATIENCE = "15s"

_arms: dict[str, LiveArm] = {}
_deriving = threading.Lock()


def run(question: Question, parts: Sequence[Part], *, jobs: int, scheduler: str | None) -> Iterator[Found]:
    """The answers, in any order; :class:`KinsymError` for what cannot be reached or done."""
    if not parts:
        return iter(())
    if scheduler is not None:
        return _on_cluster(question, parts, scheduler)
    if jobs < 1:
        raise KinsymError(f"{jobs} processes are none. Ask for one or more.")
    return _here(question, parts) if jobs == 1 else _in_processes(question, parts, jobs)


def task(question: Question, start: int, stop: int) -> Found:
    """One task, in whatever process it runs."""
    return start, stop, evaluate(question, _arm(question), start, stop)


def _arm(question: Question) -> LiveArm:
    """The arm of a question, derived once in each process."""
    said = question.said()
    key = said["robot"] + said["values"]
    with _deriving:
        if key not in _arms:
            _arms.clear()
            _arms[key] = live(question.robot, question.values)
        return _arms[key]


def _here(question: Question, parts: Sequence[Part]) -> Iterator[Found]:
    for start, stop in parts:
        yield task(question, start, stop)


def _in_processes(question: Question, parts: Sequence[Part], jobs: int) -> Iterator[Found]:
    import multiprocessing
    from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait

    # A process that is forked would share locks with the threads of this one.
    context = multiprocessing.get_context("spawn")
    left = list(reversed(parts))
    with ProcessPoolExecutor(min(jobs, len(parts)), mp_context=context) as pool:
        running: set[Any] = set()
        try:
            while left or running:
                while left and len(running) < jobs * _MOST_WAITING:
                    running.add(pool.submit(task, question, *left.pop()))
                finished, running = wait(running, return_when=FIRST_COMPLETED)
                for future in finished:
                    yield future.result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def _on_cluster(question: Question, parts: Sequence[Part], address: str) -> Iterator[Found]:
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise KinsymError("a cluster needs Dask. Install it with: pip install 'kinsym[dask]'") from None
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise KinsymError(
            f"no Dask scheduler answers at {address}: {error}. Start one, or mend --scheduler."
        ) from error
    with client:
        shared = client.scatter(question, broadcast=True)
        futures = [client.submit(task, shared, *part, pure=False) for part in parts]
        try:
            for _, found in as_completed(futures, with_results=True, loop=client.loop):
                yield found
        finally:
            client.cancel(futures)
