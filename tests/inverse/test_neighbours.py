"""Which cells of a table would have to be zero: read off rows by hand, and tables of other conventions made Paul's."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Integer, Rational, pi

from kinsym.errors import RobotError
from kinsym.inverse.neighbours import Change, Miss, changes, paul_table
from kinsym.inverse.verdict import Verdict
from kinsym.kinematics.chain import build_chain, chain_to_solve
from kinsym.robot import from_inline, load, lock
from kinsym.robot.model import Robot, Task

#: Axes 1 to 6 turn; a5 = 0 and d5 = 0, and alpha2 and alpha3 are multiples of pi.
MIXED = "pi/2 a1 0 theta1; pi a2 0.5 theta2; 0 0.3 d3 theta3; deg(30) 0.25 d4 theta4; pi/2 0 0 theta5; 0 0 0 theta6"


def table(text: str, convention: str = "paul") -> Robot:
    return from_inline(text, convention=convention, name="arm")


def told(text: str, numbers: tuple[int, ...]) -> list[str]:
    return list(map(str, changes(table(text), numbers)))


def test_the_least_change_comes_first_and_meeting_before_being_parallel() -> None:
    assert told(MIXED, (1, 2, 3, 4, 5, 6)) == [
        "with a4 = 0 axes 4, 5, 6 would meet",
        "with alpha4 = 0 axes 3, 4, 5 would be parallel",
        "with alpha1 = 0 axes 1, 2, 3 would be parallel",
        "with alpha4 = alpha5 = 0 axes 4, 5, 6 would be parallel",
        "with a3 = a4 = d4 = 0 axes 3, 4, 5 would meet",
        "with a2 = a3 = d3 = 0 axes 2, 3, 4 would meet",
        "with a1 = a2 = d2 = 0 axes 1, 2, 3 would meet",
    ]


def general(kinds: str) -> str:
    """Rows of turns and slides in which no cell is zero."""
    return "; ".join(
        f"deg({20 + i}) a{i} l{i} theta{i}" if kind == "R" else f"deg({20 + i}) a{i} d{i} 0.3"
        for i, kind in enumerate(kinds, start=1)
    )


@pytest.mark.parametrize(
    ("kinds", "numbers", "axes"),
    [
        ("RRR", (1, 2, 3), [(1, 2, 3)]),
        ("PRRR", (1, 2, 4, 5), [(2, 4, 5)]),
        ("RRRP", (1, 2, 3, 4), [(1, 2, 3)]),
        ("RPRR", (1, 2, 3, 4), []),
        ("RRPRRR", (1, 2, 3, 4, 5, 6), [(4, 5, 6)]),
        ("RRRR", (1, 2, 3, 4), [(2, 3, 4), (1, 2, 3)]),
    ],
)
def test_three_turns_in_a_row_may_meet_or_be_parallel(
    kinds: str, numbers: tuple[int, ...], axes: list[tuple[int, ...]]
) -> None:
    found = changes(table(general(kinds)), numbers)
    assert [(change.axes, change.effect) for change in found] == [
        *((triple, "be parallel") for triple in axes),
        *((triple, "meet") for triple in axes),
    ]


def test_a_cell_is_called_by_its_symbol_or_by_its_place() -> None:
    miss = Miss(4, 5, "a", 4, Rational(1, 4))
    assert (miss.name, str(miss)) == ("a4", "axes 4 and 5 miss by a4 = 1/4")
    twist = Miss(2, 3, "alpha", 2, pi / 6)
    assert str(twist) == "axes 2 and 3 are turned by alpha2 = pi/6"
    named = changes(table("pi/2 b d1 theta1; pi/2 b d2 theta2; 0 0 0 theta3"), (1, 2, 3))[1]
    assert str(named) == "with b = d2 = 0 axes 1, 2, 3 would meet"
    assert str(named.misses[0]) == "axes 1 and 2 miss by b"


def test_a_change_sets_its_cells_to_zero_and_no_other() -> None:
    arm = table(MIXED)
    change = Change((4, 5, 6), "meet", (Miss(4, 5, "a", 4, Rational(1, 4)), Miss(4, 6, "d", 4, Integer(1))))
    made = change.made(arm)
    assert [joint.a for joint in made.joints] == [
        *(joint.a for joint in arm.joints[:3]),
        0,
        *(joint.a for joint in arm.joints[4:]),
    ]
    assert made.joints[3].d == 0
    assert made.joints[:3] == arm.joints[:3]
    assert made.joints[4:] == arm.joints[4:]


def test_a_craig_table_is_moved_by_a_row() -> None:
    craig = "0 0 d1 theta1; pi/2 a1 d2 theta2; 0 a2 d3 theta3"
    found = paul_table(build_chain(table(craig, "craig")))
    assert found is not None
    assert found.joints == table("pi/2 a1 d1 theta1; 0 a2 d2 theta2; 0 0 d3 theta3").joints
    assert paul_table(build_chain(table(MIXED))) == table(MIXED)


def test_locked_joints_are_constant_and_those_of_screws_unknown() -> None:
    robot = lock(table("pi/2 a1 d1 theta1; 0 a2 0 theta2+pi/2; 0 0 d3 0.2"), {"theta2": None, "d3": "0.7"})
    found = paul_table(chain_to_solve(robot))
    assert found is not None
    assert found.locks == {}
    assert found.parameters == {**robot.parameters, "theta2": None}
    assert [joint.variable for joint in found.joints] == ["theta1"]
    screws = load("elbow_6r_screw")
    assert paul_table(build_chain(screws)) is not None
    assert paul_table(chain_to_solve(lock(screws, {"theta3": None}))) is None


def verdict(text: str, task: Task, left: tuple[str, ...] = ("theta1",), *, helps: bool = True) -> Verdict:
    return Verdict(build_chain(table(text)), task, left, (), lambda chain, task: helps)


@pytest.mark.parametrize(
    ("kinds", "task", "degree"),
    [
        ("RRRRRR", Task.POSE, 16),
        ("RRPRRR", Task.POSE, 16),
        ("RPRPRR", Task.POSE, 8),
        ("PPPRRR", Task.POSE, 2),
        ("RRRRR", Task.POSITION_AXIS, 16),
        ("RRRRR", Task.POSE, None),
        ("RRRRRR", Task.POSITION, None),
        ("PPPPRR", Task.POSE, None),
    ],
)
def test_the_degree_by_the_kinds_of_the_joints(kinds: str, task: Task, degree: int | None) -> None:
    """Raghavan and Roth 1993: 6R and 5R1P 16, 4R2P 8, 3R3P 2; an axis and a point are a pose without its last turn."""
    found = verdict(general(kinds), task, helps=False)
    assert found.degree == degree
    assert ("In general such an arm has up to" in str(found)) == (degree is not None)


def test_two_changes_of_each_kind_are_tried_the_least_first() -> None:
    tried = []

    def solves(chain: object, task: object) -> bool:
        tried.append(chain)
        return len(tried) == 2

    found = replace(verdict(general("RRRRRR"), Task.POSE), solves=solves)
    assert found.remedies is not None
    assert [str(change) for change in found.remedies] == ["with a3 = a4 = l4 = 0 axes 3, 4, 5 would meet"]
    assert len(tried) == 4
    assert str(found).startswith("no closed form for theta1: no three consecutive axes meet or are parallel")


def test_a_change_that_costs_a_motion_is_no_help() -> None:
    """Axes 2, 3 and 4 are parallel: a fourth of them, or 3 and 4 in one, leave the arm five ways to move."""
    tried: list[object] = []
    found = replace(verdict(MIXED, Task.POSE), solves=lambda chain, task: bool(tried.append(chain)))
    assert found.remedies == ()
    assert len(tried) == 1


def test_a_change_that_makes_a_table_of_no_robot_is_no_help() -> None:
    def refuses(chain: object, task: object) -> bool:
        raise RobotError("no robot", where="arm")

    assert replace(verdict(general("RRRRRR"), Task.POSE), solves=refuses).remedies == ()
