"""Base, station, wrist, tool and goal (lecture, slide 46)."""

from __future__ import annotations

import numpy as np
import pytest
import sympy

from kinsym.emit.text.formula import TextPrinter
from kinsym.errors import RobotError
from kinsym.frames import (
    solve_tool_at_goal,
    tool_in_station,
    tool_in_station_symbolic,
    with_frames,
    wrist_at_goal,
)
from kinsym.live import live
from kinsym.methods import METHODS
from kinsym.robot import load


def pose(angle: float, axis: str, x: float, y: float, z: float) -> np.ndarray:
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    result = np.eye(4)
    result[i, i] = result[j, j] = np.cos(angle)
    result[i, j], result[j, i] = -np.sin(angle), np.sin(angle)
    result[:3, 3] = x, y, z
    return result


STATION = pose(0.3, "z", 0.5, 0.1, -0.2) @ pose(0.2, "x", 0.0, 0.0, 0.0)
TOOL = pose(-0.4, "y", 0.0, 0.02, 0.15)
Q = np.array([0.3, -0.5, 0.7, 0.2, 0.9, -0.4])


def cells(rows: list[list[object]]) -> tuple[tuple[sympy.Expr, ...], ...]:
    return tuple(tuple(sympy.Integer(cell) if isinstance(cell, int) else cell for cell in row) for row in rows)


def test_the_loop_closes() -> None:
    wrist = live(load("puma560")).fk(Q)
    seen = tool_in_station(wrist, station=STATION, tool=TOOL)
    assert np.allclose(STATION @ seen, wrist @ TOOL)
    assert np.allclose(wrist_at_goal(seen, station=STATION, tool=TOOL), wrist)


def test_without_station_and_tool_the_tool_is_the_wrist() -> None:
    assert np.allclose(tool_in_station(STATION), STATION)


@pytest.mark.parametrize("name", ["puma560", "ur5", "fanuc_crx10ial"])
def test_the_tool_is_at_the_goal(name: str) -> None:
    """The lecture's frames.goal: T_S_T = T_S_G for every joint vector that comes out, that of the goal among them."""
    arm = live(load(name))
    goal = tool_in_station(arm.fk(Q), station=STATION, tool=TOOL)
    found = solve_tool_at_goal(arm, goal, station=STATION, tool=TOOL)
    assert len(found) >= 2
    assert np.abs(tool_in_station(arm.fk(found), station=STATION, tool=TOOL) - goal).max() < 1e-9
    apart = np.angle(np.exp(1j * (found - Q)))
    assert np.abs(apart).max(axis=1).min() < 1e-7


def test_a_goal_out_of_reach_has_no_solution() -> None:
    goal = pose(0.0, "z", 9.0, 0.0, 0.0)
    assert solve_tool_at_goal(load("puma560"), goal, station=STATION, tool=TOOL).shape == (0, 6)


def test_a_station_that_is_forgotten_is_another_goal() -> None:
    arm = live(load("puma560"))
    goal = tool_in_station(arm.fk(Q), station=STATION, tool=TOOL)
    found = solve_tool_at_goal(arm, goal, tool=TOOL)
    if len(found):
        assert np.abs(tool_in_station(arm.fk(found), station=STATION, tool=TOOL) - goal).max() > 1e-3


def test_in_symbols() -> None:
    """A station at (h, 0, k), turned by a quarter about x, sees the planar arm's y axis as -z."""
    h, k = sympy.symbols("h k", real=True)
    station = cells([[1, 0, 0, h], [0, 0, -1, 0], [0, 1, 0, k], [0, 0, 0, 1]])
    rows = tool_in_station_symbolic(load("planar_rr"), station=station)
    text = [[TextPrinter()(cell) for cell in row] for row in rows]
    assert text[0] == ["c12", "-s12", "0", "l1*c1 + l2*c12 - h"]
    assert text[1] == ["0", "0", "1", "-k"]
    assert text[2] == ["-s12", "-c12", "0", "-l1*s1 - l2*s12"]


UNIT = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


@pytest.mark.parametrize(
    ("row", "column", "cell", "message"),
    [
        (0, 0, 2, "the rotation of the station"),
        (3, 3, 2, "no 4x4 transform"),
        (0, 3, sympy.Symbol("theta2", real=True), "theta2 is a joint variable"),
    ],
)
def test_cells_that_are_no_station(row: int, column: int, cell: object, message: str) -> None:
    rows = [list(line) for line in UNIT]
    rows[row][column] = cell
    with pytest.raises(RobotError, match=message):
        with_frames(load("planar_rr"), station=cells(rows))


@pytest.mark.parametrize("name", ["planar_rr", "puma560", "stanford_screw", "nao_left_leg"])
def test_symbols_and_numbers_agree(name: str) -> None:
    """The robot with its frames, run as code, against the loop in numbers; one has a base and a tool already."""
    lift, reach = sympy.Symbol("lift", real=True), sympy.Symbol("reach", real=True)
    station = cells([[0, -1, 0, lift], [1, 0, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])
    tool = cells([[0, 0, 1, 0], [0, 1, 0, reach], [-1, 0, 0, 0], [0, 0, 0, 1]])
    robot = load(name)
    missing = {n: 0.3 + 0.1 * i for i, (n, v) in enumerate(robot.parameters.items()) if v is None}
    moved = live(with_frames(robot, station=station, tool=tool), {**missing, "lift": 0.7, "reach": 0.2})
    q = np.linspace(0.2, 0.9, len(robot.variables))
    numbers = [np.array(m.subs({lift: 0.7, reach: 0.2}), dtype=float) for m in map(sympy.Matrix, (station, tool))]
    plain = live(robot, missing).fk(q)
    assert np.allclose(moved.fk(q), tool_in_station(plain, station=numbers[0], tool=numbers[1]))


BAD = [
    (np.full((4, 4), np.nan), "no rigid motion"),
    (np.eye(3), "has the shape"),
    (np.diag([1.0, 1.0, -1.0, 1.0]), "no rigid motion"),
    (2.0 * np.eye(4), "no rigid motion"),
    ([["a"]], "no matrix of numbers"),
]


@pytest.mark.parametrize(("bad", "message"), BAD)
def test_what_is_no_pose_is_refused(bad: object, message: str) -> None:
    for call in (
        lambda: tool_in_station(bad),
        lambda: tool_in_station(np.eye(4), station=bad),
        lambda: wrist_at_goal(np.eye(4), tool=bad),
        lambda: solve_tool_at_goal(load("puma560"), bad),
    ):
        with pytest.raises(RobotError, match=message):
            call()


def test_a_robot_without_numbers_says_which() -> None:
    with pytest.raises(RobotError, match="the parameters a1, a2, a3, d4, d6 have no value"):
        solve_tool_at_goal(load("fanuc_s900w"), np.eye(4))


def test_the_method_states_the_loop() -> None:
    names = [equation.name for equation in METHODS["frames"](load("puma560")).equations]
    assert names == ["T_B_W", "loop", "tool", "goal", "wrist"]
