"""Sweeps: the same answer whoever works it out, however often it is stopped, and as the closed form has it."""

from __future__ import annotations

import io
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.errors import KinsymError, OutputError, RobotError
from kinsym.live import live
from kinsym.plot import workspace as drawn
from kinsym.robot import load, lock
from kinsym.robot.files import from_draft
from kinsym.skeleton import linkage
from kinsym.workspace import ask, dexterous, reachable, sweeping
from kinsym.workspace.files import data
from kinsym.workspace.grids import endless, slice_grid, volume_grid, window
from kinsym.workspace.partial import forget
from kinsym.workspace.sweeping import Question, Workspace, found, sweep

LENGTHS = {"l1": 0.4, "l2": 0.25}
LINKS = {"l1": 0.4, "l2": 0.3, "l3": 0.1}


def planar(points: int = 21, **changes: Any) -> Question:
    robot = load("planar_rr")
    x, y, z = slice_grid(linkage(robot, LENGTHS), points, "z", 0.0)
    return Question(**{"robot": robot, "kind": "reachable", "x": x, "y": y, "z": z, "values": LENGTHS, **changes})


def three_links(points: int = 21, **changes: Any) -> Question:
    robot = load("planar_rrr_craig")
    x, y, z = slice_grid(linkage(robot, LINKS), points, "z", 0.0)
    asked = {"robot": robot, "kind": "reachable", "x": x, "y": y, "z": z, "values": LINKS, "count": 24}
    return Question(**{**asked, **changes})


@pytest.fixture
def small_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many tasks instead of one."""
    monkeypatch.setattr("kinsym.workspace.sweeping._POSES", 1000)


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is found is written at once."""
    monkeypatch.setattr("kinsym.workspace.partial._PAUSE", 0.0)
    monkeypatch.setattr("kinsym.workspace.partial._COST", 0.0)


def test_the_window_is_the_reach_of_the_arm() -> None:
    """Two links reach l1 + l2 everywhere; the Puma's wrist the stretched arm beside its offset d3."""
    low, high = window(linkage(load("planar_rr"), LENGTHS))
    assert np.allclose(low, [-0.65, -0.65, 0.0], atol=1e-3)
    assert np.allclose(high, [0.65, 0.65, 0.0], atol=1e-3)
    a2, a3, d3, d4 = 0.4318, 0.0203, 0.15005, 0.4318
    reach = np.hypot(a2 + np.hypot(a3, d4), d3)
    low, high = window(linkage(load("puma560")))
    assert np.allclose([-low[0], high[0], high[1]], reach, rtol=3e-3)
    assert np.allclose(high[2], a2 + np.hypot(a3, d4), rtol=3e-3)


def test_grids() -> None:
    arm = linkage(load("puma560"))
    x, y, z = slice_grid(arm, 11, "y", 0.25)
    assert (max(len(x), len(z)), y) == (11, (0.25,))
    steps = [axis[1] - axis[0] for axis in volume_grid(arm, 9)]
    assert np.allclose(steps, steps[0])
    assert endless(linkage(load("stanford_arm"))) == ("d3",)
    assert endless(arm) == ()
    for points, message in ((1, "is none"), (10**6, "are too many")):
        with pytest.raises(RobotError, match=message):
            volume_grid(arm, points)


def test_what_is_asked_without_saying_much() -> None:
    """The plane of an arm that has one, else y = 0; the values of an arm that is live."""
    arm = live(load("planar_rr"), LENGTHS)
    question = ask(arm, points=5)
    assert (question.z, len(question.x), dict(question.values)) == ((0.0,), 5, LENGTHS)
    assert ask(load("puma560")).y == (0.0,)
    assert ask(load("puma560"), volume=True, points=5).shape == (5, 5, 5)
    turned = lock(load("kuka_iiwa"), {"theta3": None}, where="test")
    assert ask(turned, points=3, values={"theta3": 0.5}).values == {"theta3": 0.5}
    for wrong in ({"plane": ("x", 0.0)}, {"volume": True}):
        with pytest.raises(RobotError, match="the arm moves in the plane of x and y"):
            ask(arm, **wrong)
    with pytest.raises(RobotError, match="'w' is no coordinate"):
        ask(load("puma560"), plane=("w", 0.0))


def test_a_sweep_is_what_its_points_are(small_parts: None) -> None:
    """Part by part as all at once, every point at its place."""
    question = three_links()
    assert len(question.parts()) > 5
    points = question.points(0, int(np.prod(question.shape))).reshape(*question.shape, 3)
    arm = live(question.robot, LINKS)
    result = sweep(question)
    assert (result.inside == reachable(arm, points, count=24)).all()
    assert (sweep(replace(question, kind="dexterous")).inside == dexterous(arm, points, count=24)).all()
    turned = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    one = sweep(replace(question, kind="constant", rotation=turned))
    assert one.tried == 1
    # The last link stands along y: the ring of the first two is moved by l3.
    radius = np.hypot(points[..., 0], points[..., 1] - 0.1)
    assert (one.inside == ((radius >= 0.1) & (radius <= 0.7))).all()


def test_the_closed_border() -> None:
    """Slide 50: from |l1 - l2| to l1 + l2; the points agree with it."""
    result = sweep(planar(41))
    assert np.allclose(result.border, [0.15, 0.65])
    x, y = np.meshgrid(result.question.x, result.question.y, indexing="ij")
    radius = np.hypot(x, y)
    assert (result.inside[..., 0] == ((radius >= 0.15) & (radius <= 0.65))).all()
    equal = replace(planar(), values={"l1": 0.3, "l2": 0.3})
    assert np.allclose(found(equal, np.zeros(equal.shape, dtype=int)).border, [0.6])
    assert sweep(three_links(5)).border == ()


def test_limits_take_the_closed_border_away() -> None:
    rows = [
        {"type": "R", "alpha": "0", "a": "1", "d": "0", "theta": f"theta{k}", "limits": ["-1", "1"]} for k in (1, 2)
    ]
    robot = from_draft({"name": "arm", "convention": "paul", "joints": rows}, where="arm")
    x, y, z = slice_grid(linkage(robot), 9, "z", 0.0)
    question = Question(robot=robot, kind="reachable", x=x, y=y, z=z)
    assert sweep(question).border == ()
    free = sweep(replace(question, limits=False))
    assert np.allclose(free.border, [2.0])
    assert free.inside.sum() > sweep(question).inside.sum() > 0


def test_the_dexterous_workspace_of_two_equal_links_is_the_origin() -> None:
    question = replace(
        planar(), kind="dexterous", values={"l1": 0.3, "l2": 0.3}, x=(-0.1, 0.0, 0.1), y=(-0.1, 0.0, 0.1)
    )
    assert np.argwhere(sweep(question).inside).tolist() == [[1, 1, 0]]


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


def test_two_processes_find_the_same(small_parts: None) -> None:
    question = three_links(15)
    assert (sweep(question, jobs=2).hits == sweep(question).hits).all()


@pytest.mark.usefixtures("small_parts")
def test_a_dask_cluster_finds_the_same() -> None:
    import distributed

    question = three_links(15)
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0")
    with cluster:
        result = sweep(question, scheduler=cluster.scheduler_address)
    assert (result.hits == sweep(question).hits).all()


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


def test_what_cannot_be_asked() -> None:
    with pytest.raises(RobotError, match="l1, l2 have no value"):
        sweep(planar(values={}))
    with pytest.raises(RobotError, match="'dextrous' is no kind"):
        planar(kind="dextrous")
    with pytest.raises(RobotError, match="an orientation belongs to"):
        planar(kind="constant")
    with pytest.raises(KinsymError, match="0 processes"):
        sweep(planar(), jobs=0)
    arm = lock(load("kuka_iiwa"), {"theta3": None}, where="test")
    with pytest.raises(RobotError, match=r"theta3 has no value.*--lock theta3=VALUE"):
        sweep(Question(robot=arm, kind="reachable", x=(0.0,), y=(0.0,), z=(0.0,)))


def some(kind: str = "reachable", shape: tuple[int, int, int] = (3, 2, 1)) -> Workspace:
    axes = [tuple(0.5 * k for k in range(n)) for n in shape]
    question = Question(robot=load("puma560"), kind=kind, x=axes[0], y=axes[1], z=axes[2], count=4)
    return found(question, np.arange(np.prod(shape)) % 5)


def test_the_table() -> None:
    lines = data(some(), "csv").decode().splitlines()
    assert lines[0] == "x,y,z,orientations_reached,orientations_tried,inside"
    assert lines[1:3] == ["0.0,0.0,0.0,0,4,0", "0.0,0.5,0.0,1,4,1"]
    assert len(lines) == 7
    assert [line[-1] for line in data(some("dexterous"), "csv").decode().splitlines()[1:]] == list("000010")


def test_the_arrays() -> None:
    content = data(some(), "npz")
    assert content == data(some(), "npz")
    arrays = np.load(io.BytesIO(content))
    assert arrays["hits"].shape == arrays["inside"].shape == (3, 2, 1)
    assert arrays["x"].tolist() == [0.0, 0.5, 1.0]
    assert int(arrays["tried"]) == 4


def test_a_slice_is_a_map() -> None:
    """Each point at its place, with white where nothing is reached, and circles on the closed border."""
    result = sweep(planar(21))
    ax = drawn(result, unit="m")
    (image,) = ax.images
    assert (result.inside[..., 0] == ~np.ma.getmaskarray(image.get_array()).T).all()
    step = result.question.x[1] - result.question.x[0]
    left, right, *_ = image.get_extent()
    assert (left, right) == pytest.approx((result.question.x[0] - step / 2, result.question.x[-1] + step / 2))
    assert [patch.radius for patch in ax.patches] == pytest.approx([0.15, 0.65])
    assert [text.get_text() for text in ax.figure.legends[0].get_texts()] == [
        "reached",
        "border in closed form",
        "base",
    ]
    assert ax.get_xlabel() == "x [m]"
    (image,) = drawn(some()).images
    assert (some().inside[..., 0] == ~np.ma.getmaskarray(image.get_array()).T).all()


def test_a_volume_is_cut_open() -> None:
    result = found(some(shape=(4, 4, 4)).question, np.full(64, 4))
    ax = drawn(result)
    ax.figure.draw_without_rendering()
    assert ax.name == "3d"
    assert len(ax.collections[0].get_facecolor()) == 16 + 16 + 16
    with pytest.raises(RobotError, match='projection="3d"'):
        drawn(result, drawn(some()))
    with pytest.raises(RobotError, match="in the plane"):
        drawn(some(), ax)


@pytest.mark.parametrize("kind", ["reachable", "dexterous"])
def test_an_empty_workspace_is_said(kind: str) -> None:
    for shape in ((3, 2, 1), (3, 3, 3)):
        nothing = found(some(kind, shape).question, np.zeros(np.prod(shape), dtype=int))
        ax = drawn(nothing)
        ax.figure.draw_without_rendering()
        assert "no point of the grid is inside" in ax.figure.texts[1].get_text()
