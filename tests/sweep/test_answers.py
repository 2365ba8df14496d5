"""The answer of a sweep: at every point what the point alone says, and as the closed form has it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kinsym.errors import KinsymError, RobotError
from kinsym.live import live
from kinsym.robot import load, lock
from kinsym.robot.files import from_draft
from kinsym.skeleton import linkage
from kinsym.workspace import ask, dexterous, reachable
from kinsym.workspace.grids import endless, slice_grid, volume_grid, window
from kinsym.workspace.sweeping import Question, found, sweep
from tests.sweep.questions import LENGTHS, LINKS, planar, three_links


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
