"""Who does the tasks of a sweep: this process, several of them, or a Dask cluster.

A task is a question and a range of points. The generated module cannot be sent to another process, so each derives the
arm once and keeps it; the numbers are the same wherever they are found.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
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

_AGAIN = "What was found is kept: the same command goes on from there."

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
    from concurrent.futures.process import BrokenProcessPool

    # A process that is forked would share locks with the threads of this one.
    context = multiprocessing.get_context("spawn")
    left = list(reversed(parts))
    with ProcessPoolExecutor(min(jobs, len(parts)), mp_context=context) as pool:
        running: set[Any] = set()
        try:
            while left or running:
                with _deaf_to_interrupts() if not running else nullcontext():
                    while left and len(running) < jobs * _MOST_WAITING:
                        running.add(pool.submit(task, question, *left.pop()))
                finished, running = wait(running, return_when=FIRST_COMPLETED)
                for future in finished:
                    yield future.result()
        except BrokenProcessPool as error:
            raise KinsymError(f"a process ended before its task, for lack of memory perhaps. {_AGAIN}") from error
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """While processes start, so that they never hear of Ctrl-C, which is for this one alone."""
    import signal

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _on_cluster(question: Question, parts: Sequence[Part], address: str) -> Iterator[Found]:
    from concurrent.futures import CancelledError

    try:
        from distributed import Client, KilledWorker, as_completed
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
            for future, found in as_completed(futures, with_results=True, loop=client.loop):
                if future.status != "finished":
                    raise CancelledError(f"a task is {future.status}")
                yield found
        except (CancelledError, KilledWorker, OSError) as error:
            raise KinsymError(
                f"the cluster at {address} gave up: {str(error) or type(error).__name__}. {_AGAIN}"
            ) from error
        finally:
            client.cancel(futures)
