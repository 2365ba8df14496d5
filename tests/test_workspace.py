"""Workspaces against geometry that can be worked out by hand, and against the forward kinematics."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from kinsym.emit.text.formula import TextPrinter
from kinsym.errors import DoesNotApply, RobotError
from kinsym.live import live
from kinsym.methods import METHODS
from kinsym.robot import from_inline, load, lock
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from kinsym.workspace import closed, constant_orientation, dexterous, grid, reachable, reached
from kinsym.workspace.orientations import orientations, spread

RADII = np.array([0.0, 0.05, 0.0999, 0.1001, 0.3, 0.6999, 0.7001, 0.9])


def points_at(radii: np.ndarray, angle: float = 0.7) -> np.ndarray:
    return np.stack([radii * np.cos(angle), radii * np.sin(angle), 0.0 * radii], axis=-1)


def arm(l1: str, l2: str) -> Robot:
    return from_inline(f"0 {l1} 0 theta1; 0 {l2} 0 theta2", convention="paul", name="two_links")


def written(robot: Robot) -> list[tuple[str, ...]]:
    text = TextPrinter()
    return [
        (" ".join(map(str, (text(c.relation[0]), c.relation[1], text(c.relation[2])))), c.shape, text(c.inner),
         text(c.outer), c.dexterous)
        for c in closed(robot)
    ]  # fmt: skip


def test_the_closed_result_of_the_lecture() -> None:
    """Slide 50: a disc and the origin for links of one length, a ring and nothing otherwise; border errata 19."""
    disc = ("l1 = l2", "disc", "0", "l1 + l2", "origin")
    ring = ("l1 != l2", "ring", "abs(l1 - l2)", "l1 + l2", "empty")
    assert written(load("planar_rr")) == [disc, ring]
    of_disc, of_ring = closed(load("planar_rr"))
    assert [solutions for _, solutions in of_disc.border] == [1]
    assert [solutions for _, solutions in of_ring.border] == [1, 1]


@pytest.mark.parametrize(
    ("l1", "l2", "shape"),
    [("2/5", "3/10", "ring"), ("3/10", "2/5", "ring"), ("2/5", "2/5", "disc"), ("l", "l", "disc")],
)
def test_lengths_that_are_known_leave_one_case(l1: str, l2: str, shape: str) -> None:
    assert [case.shape for case in closed(arm(l1, l2))] == [shape]


def test_values_of_parameters_decide_as_well() -> None:
    joints = [{"type": "R", "alpha": "0", "a": a, "d": "0", "theta": f"theta{i}"} for i, a in ((1, "l1"), (2, "l2"))]
    draft = {"name": "arm", "convention": "paul", "joints": joints, "parameters": {"l1": 2, "l2": 1}}
    assert [case.shape for case in closed(from_draft(draft, where="arm"))] == ["ring"]


def test_the_derivation_says_both_cases() -> None:
    derivation = METHODS["workspace"](load("planar_rr"))
    names = {equation.name for equation in derivation.equations}
    assert {"distance", "folded", "stretched", "border", "reachable.near", "reachable.far"} <= names


@pytest.mark.parametrize("robot", ["planar_rrr_paul", "puma560", "scara"])
def test_no_closed_result_for_other_arms(robot: str) -> None:
    with pytest.raises(DoesNotApply):
        closed(load(robot))


def test_a_negative_length_is_no_length() -> None:
    with pytest.raises(DoesNotApply, match="link 2 has the length -1/2"):
        closed(arm("1", "-1/2"))


def test_the_ring_point_by_point() -> None:
    found = reachable(load("planar_rr"), points_at(RADII), values={"l1": 0.4, "l2": 0.3})
    assert found.tolist() == [bool(0.1 <= radius <= 0.7) for radius in RADII]
    assert not dexterous(load("planar_rr"), points_at(RADII), values={"l1": 0.4, "l2": 0.3}).any()


def test_the_disc_and_its_origin() -> None:
    found = dexterous(load("planar_rr"), points_at(RADII), values={"l1": 0.35, "l2": 0.35})
    assert found.tolist() == [True] + [False] * (len(RADII) - 1)
    assert reachable(load("planar_rr"), points_at(RADII), values={"l1": 0.35, "l2": 0.35}).sum() == 6


def test_the_dexterous_ring_of_three_links() -> None:
    """The circle of radius l3 about the goal must lie in the ring of the first two links."""
    l1, l2, l3 = 0.4, 0.3, 0.05
    live_arm = live(load("planar_rrr_craig"), {"l1": l1, "l2": l2, "l3": l3})
    radii = np.array([0.0, 0.049, 0.051, 0.1, 0.149, 0.151, 0.4, 0.649, 0.651, 0.749, 0.751])
    points = points_at(radii)
    assert dexterous(live_arm, points, count=360).tolist() == [bool(0.15 <= r <= 0.65) for r in radii]
    assert reachable(live_arm, points, count=360).tolist() == [bool(0.05 <= r <= 0.75) for r in radii]


def test_one_orientation_of_three_links() -> None:
    """With the last link along x the ring of the first two is moved by l3."""
    live_arm = live(load("planar_rrr_craig"), {"l1": 0.4, "l2": 0.3, "l3": 0.2})
    points = grid(x=np.linspace(-1.0, 1.0, 41), y=np.linspace(-1.0, 1.0, 41))
    radius = np.hypot(points[..., 0] - 0.2, points[..., 1])
    clear = (abs(radius - 0.1) > 1e-6) & (abs(radius - 0.7) > 1e-6)
    found = constant_orientation(live_arm, points, np.eye(3))
    assert (found == ((radius >= 0.1) & (radius <= 0.7)))[clear].all()


@pytest.mark.parametrize("name", ["puma560", "scara", "stanford_arm"])
def test_what_the_arm_reaches_is_found(name: str) -> None:
    """Any posture's own pose is in the workspace of its orientation; a point beyond the arm's length is in none."""
    robot = load(name)
    live_arm = live(robot, {n: 0.3 + 0.1 * i for i, (n, v) in enumerate(robot.parameters.items()) if v is None})
    rng = np.random.default_rng(5)
    kinds = np.array([kind == "R" for kind in live_arm.module.JOINT_TYPES])
    for _ in range(5):
        q = np.where(kinds, rng.uniform(-2.0, 2.0, len(kinds)), rng.uniform(0.1, 0.3, len(kinds)))
        pose = live_arm.fk(q)
        assert constant_orientation(live_arm, pose[:3, 3], pose[:3, :3], limits=False)
        assert not constant_orientation(live_arm, [0.0, 50.0, 0.0], pose[:3, :3]) or not kinds.all()


def test_dexterous_is_within_constant_is_within_reachable() -> None:
    """The lecture's ik.dw_subset, for an arm whose tool is away from its wrist."""
    live_arm = live(load("fanuc_lrmate200id"))
    points = grid(x=np.linspace(-1.0, 1.0, 9), z=np.linspace(-0.5, 1.2, 8))
    turns = spread(40)
    every = reached(live_arm, points, turns)
    all_of, one, any_of = every.all(axis=-1), every[..., 7], every.any(axis=-1)
    assert (all_of <= one).all()
    assert (one <= any_of).all()
    assert 0 < all_of.sum() < one.sum() < any_of.sum() < any_of.size


def test_limits_count_if_they_are_asked_for() -> None:
    joints = [
        {"type": "R", "alpha": "0", "a": "1", "d": "0", "theta": "theta1", "limits": ["deg(200)", "deg(340)"]},
        {"type": "R", "alpha": "0", "a": "1", "d": "0", "theta": "theta2", "limits": ["deg(-30)", "deg(30)"]},
    ]
    robot = from_draft({"name": "arm", "convention": "paul", "joints": joints}, where="arm")
    below, above = [0.0, -1.97, 0.0], [0.0, 1.97, 0.0]
    assert reachable(robot, [below, above]).tolist() == [True, False]
    assert reachable(robot, [below, above], limits=False).tolist() == [True, True]


def test_a_locked_input_is_a_value() -> None:
    robot = lock(load("kuka_iiwa"), {"theta3": None}, where="test")
    with pytest.raises(RobotError, match="theta3 has no value"):
        live(robot)
    pose = live(robot, {"theta3": 0.4}).fk(np.array([0.3, 0.5, 0.4, -1.0, 0.2, 0.7, 0.1]))
    assert constant_orientation(live(robot, {"theta3": 0.4}), pose[:3, 3], pose[:3, :3])


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({}, "the parameters l1, l2 have no value"),
        ({"l1": 0.4}, "the parameter l2 has no value"),
        ({"l1": 0.4, "l2": 0.3, "l3": 1.0}, "no parameter l3"),
        ({"l1": 0.4, "l2": float("nan")}, "l2 = nan is no number"),
        ({"l1": 0.4, "l2": "0.3"}, "l2 = '0.3' is no number"),
    ],
)
def test_numbers_that_lack_or_are_none(values: dict[str, float], message: str) -> None:
    with pytest.raises(RobotError, match=message):
        reachable(load("planar_rr"), [[0.1, 0.0, 0.0]], values=values)


@pytest.mark.parametrize(
    ("points", "message"),
    [([0.1, 0.2], "shape"), ([[np.nan, 0.0, 0.0]], "not finite"), ([[np.inf, 0.0, 0.0]], "not finite")],
)
def test_points_that_are_none(points: list[float], message: str) -> None:
    with pytest.raises(RobotError, match=message):
        reachable(load("puma560"), points)


def test_orientations_that_are_none() -> None:
    puma = live(load("puma560"))
    for bad, message in (
        (np.diag([1.0, 1.0, -1.0]), "orientation 0 is no rotation"),
        (np.full((3, 3), np.nan), "orientation 0 is no rotation"),
        (np.eye(4), "shape"),
    ):
        with pytest.raises(RobotError, match=message):
            constant_orientation(puma, [0.3, 0.0, 0.0], bad)
    with pytest.raises(RobotError, match="0 orientations"):
        reachable(puma, [0.3, 0.0, 0.0], count=0)
    with pytest.raises(RobotError, match="given to live"):
        reachable(puma, [0.3, 0.0, 0.0], values={"a2": 1.0})


def test_a_wrist_alone_has_no_workspace() -> None:
    with pytest.raises(RobotError, match="turns its end effector about one point"):
        reachable(load("spherical_wrist"), [0.0, 0.0, 0.0], values={"d6": 0.1})


def test_orientations_are_spread_evenly() -> None:
    """The mean of evenly spread rotations is nearly zero, and they do not repeat themselves."""
    turns = spread(500)
    assert np.abs(turns.mean(axis=0)).max() < 0.02
    nearest = np.sort(np.einsum("aij,bij->ab", turns, turns), axis=1)[:, -2]
    assert nearest.max() < 3.0 - 1e-3
    about = orientations(live(load("scara"), dict.fromkeys(("a1", "a2", "d1", "d4"), 0.3)), 4)
    assert np.allclose(about[:, :, 2], about[0, :, 2])


def test_a_slice() -> None:
    points = grid(x=[0.0, 1.0], y=0.5, z=[2.0, 3.0, 4.0])
    assert points.shape == (2, 3, 3)
    assert points[1, 2].tolist() == [1.0, 0.5, 4.0]
    assert grid(x=1.0).tolist() == [1.0, 0.0, 0.0]


def test_the_parameter_of_a_table_keeps_its_value() -> None:
    robot = from_draft(
        {
            "name": "arm",
            "convention": "paul",
            "joints": [{"type": "R", "alpha": "0", "a": f"l{i}", "d": "0", "theta": f"theta{i}"} for i in (1, 2)],
            "parameters": {"l1": 1},
        },
        where="arm",
    )
    assert robot.parameters["l1"] == Fraction(1)
    assert reachable(robot, [[1.4, 0.0, 0.0]], values={"l2": 0.5}).all()
    assert not reachable(robot, [[1.4, 0.0, 0.0]], values={"l2": 0.3}).any()
