"""Sweeps that are stopped, go on, or are worked out by others: the same answer."""

from __future__ import annotations

import json
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.errors import KinsymError, OutputError
from kinsym.robot import load
from kinsym.workspace import sweeping
from kinsym.workspace.partial import forget
from kinsym.workspace.sweeping import Question, sweep
from tests.sweep.questions import LINKS, planar, three_links


class Stopped(Exception):
    """Ctrl-C, or whatever ends a process."""


@pytest.mark.usefixtures("small_parts", "eager")
def test_a_sweep_that_was_stopped_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    question, keep = three_links(), tmp_path / "x.partial.npz"
    whole = sweep(question).hits
    seen: list[tuple[int, int]] = []

    def stop(done: int, total: int) -> None:
        seen.append((done, total))
        if len(seen) == 4:
            raise Stopped

    with pytest.raises(Stopped):
        sweep(question, keep=keep, progress=stop)
    assert keep.exists()
    evaluated: list[int] = []
    real = sweeping.evaluate

    def counted(question: Question, arm: Any, start: int, stop: int) -> Any:
        evaluated.append(stop - start)
        return real(question, arm, start, stop)

    monkeypatch.setattr("kinsym.workspace.runners.evaluate", counted)
    assert (sweep(question, keep=keep).hits == whole).all()
    assert 0 < sum(evaluated) == whole.size - seen[-1][0]
    forget(keep)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"robot": load("planar_rrr_paul"), "values": {"a1": 1.0, "a2": 1.0, "a3": 1.0}}, "robot and values differ"),
        ({"values": {**LINKS, "l1": 0.5}}, "values differs"),
        ({"kind": "dexterous"}, "workspace differs"),
        ({"x": (0.0, 0.1)}, "grid differs"),
        ({"count": 25}, "orientations differs"),
        ({"limits": False}, "limits differs"),
    ],
)
def test_a_part_of_another_sweep_is_refused(tmp_path: Path, changes: dict[str, Any], words: str) -> None:
    keep = tmp_path / "x.partial.npz"
    sweep(three_links(5), keep=keep)
    before = keep.read_bytes()
    with pytest.raises(OutputError, match=f"holds a part of another sweep: {words}. Remove the file"):
        sweep(three_links(5, **changes), keep=keep)
    assert keep.read_bytes() == before


@pytest.mark.parametrize("content", [b"", b"mine", b"PK\x03\x04broken"])
def test_a_file_that_is_no_part_is_refused(tmp_path: Path, content: bytes) -> None:
    keep = tmp_path / "x.partial.npz"
    keep.write_bytes(content)
    with pytest.raises(OutputError, match="is no part of a workspace"):
        sweep(three_links(5), keep=keep)
    assert keep.read_bytes() == content


def test_a_part_with_other_points_is_refused(tmp_path: Path) -> None:
    """The same question, but not as many answers; then a format that a later kinsym may have."""
    keep = tmp_path / "x.partial.npz"
    sweep(three_links(5), keep=keep)
    with np.load(keep) as content:
        said, hits = str(content["said"]), content["hits"]
    np.savez(keep, said=np.array(said), hits=hits[:-1])
    with pytest.raises(OutputError, match=rf"is no part of a workspace: it has \({hits.size - 1},\) points. Remove"):
        sweep(three_links(5), keep=keep)
    np.savez(keep, said=np.array(json.dumps({**json.loads(said), "format": 99})), hits=hits)
    with pytest.raises(OutputError, match="is no part of a workspace: it is of another format"):
        sweep(three_links(5), keep=keep)


@pytest.mark.usefixtures("small_parts", "eager")
def test_a_part_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(OutputError, match=r"x.npz could not be written: .*Name another output\."):
        sweep(three_links(5), keep=tmp_path / "file" / "x.npz")
    assert (tmp_path / "file").read_text() == "mine"


def test_two_processes_find_the_same(small_parts: None) -> None:
    question = three_links(15)
    assert (sweep(question, jobs=2).hits == sweep(question).hits).all()


@pytest.mark.filterwarnings("ignore:Creating scratch directories")  # Dask on a machine that is busy
@pytest.mark.usefixtures("small_parts")
def test_a_dask_cluster_finds_the_same() -> None:
    import distributed

    question = three_links(15)
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0")
    with cluster:
        result = sweep(question, scheduler=cluster.scheduler_address)
    assert (result.hits == sweep(question).hits).all()


@pytest.mark.filterwarnings("ignore:Creating scratch directories")  # Dask on a machine that is busy
@pytest.mark.usefixtures("small_parts")
def test_a_cluster_that_goes_away(tmp_path: Path) -> None:
    """What it had found is kept, and the message says so."""
    import distributed

    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0")
    calls: list[int] = []

    def close(done: int, total: int) -> None:
        calls.append(done)
        if len(calls) == 2:
            cluster.close(timeout=5)

    keep = tmp_path / "x.partial.npz"
    with cluster, pytest.raises(KinsymError, match=r"gave up: .*What was found is kept"):
        sweep(three_links(31), scheduler=cluster.scheduler_address, keep=keep, progress=close)
    assert keep.exists()


def test_a_process_that_is_killed(monkeypatch: pytest.MonkeyPatch) -> None:
    class Pool:
        """Processes that the system ends, as it does when memory runs out."""

        def __init__(self, *_: object, **__: object) -> None: ...

        def __enter__(self) -> Pool:
            return self

        def __exit__(self, *_: object) -> None: ...

        def submit(self, *_: object) -> Future[object]:
            future: Future[object] = Future()
            future.set_exception(BrokenProcessPool("a process was terminated abruptly"))
            return future

        def shutdown(self, **_: object) -> None: ...

    monkeypatch.setattr("concurrent.futures.ProcessPoolExecutor", Pool)
    with pytest.raises(KinsymError, match="a process ended before its task"):
        sweep(three_links(5), jobs=2)


def test_no_scheduler_and_no_dask(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kinsym.workspace.runners._PATIENCE", "0.2s")
    with pytest.raises(KinsymError, match="no Dask scheduler answers at tcp://127"):
        sweep(planar(), scheduler="tcp://127.0.0.1:9")
    with pytest.raises(KinsymError, match="no Dask scheduler answers at nowhere at all"):
        sweep(planar(), scheduler="nowhere at all")
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(KinsymError, match=r"pip install 'kinsym\[dask\]'"):
        sweep(planar(), scheduler="tcp://127.0.0.1:9")
