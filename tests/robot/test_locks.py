"""Locks as their user writes them: in a file, by the API, and what is refused."""

from __future__ import annotations

import math
import tomllib
from fractions import Fraction

import pytest

from kinsym.errors import RobotError
from kinsym.robot import bind, digest, from_inline, load, lock, parse, table_lines, to_toml
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from tests.arms import IIWA, ON_A_RAIL


def seven() -> Robot:
    """An arm with seven revolute joints; the last one has limits."""
    draft = tomllib.loads(to_toml(from_inline(IIWA, convention="paul", name="seven")))
    draft["joints"][6]["limits"] = ["deg(-175)", "deg(175)"]
    return from_draft(draft, where="seven.toml")


def test_a_lock_is_an_input_or_an_exact_value() -> None:
    robot = lock(seven(), {"theta5": "pi/4", "theta3": None, "theta7": "-30deg", "theta1": 0.1})
    assert list(robot.locks.items()) == [
        ("theta1", parse("1/10")),
        ("theta3", None),
        ("theta5", parse("pi/4")),
        ("theta7", parse("-pi/6")),
    ]
    assert robot.unlocked == (2, 4, 6)
    assert robot.variables == seven().variables
    assert lock(robot, {"theta2": None}).locks == {"theta2": None}


def test_written_and_read_again_it_is_the_same() -> None:
    robot = lock(seven(), {"theta3": None, "theta5": "pi/4 + 0.5"})
    text = to_toml(robot)
    assert '[locks]\ntheta3 = "input"\ntheta5 = "0.5 + pi/4"\n' in text
    assert from_draft(tomllib.loads(text), where="again.toml") == robot
    assert "locked: theta3, theta5 = 0.5 + pi/4" in table_lines(robot)


def test_the_lock_is_part_of_the_digest() -> None:
    robots = [seven(), *(lock(seven(), locks) for locks in ({"theta3": None}, {"theta3": "0.5"}, {"theta5": None}))]
    assert len({digest(robot) for robot in robots}) == len(robots)


def test_binding_keeps_the_lock() -> None:
    assert bind(load("kuka_iiwa"), {"d7": Fraction(1, 5)}).locks == {"theta3": None}


@pytest.mark.parametrize(
    ("locks", "where", "what", "remedy"),
    [
        ({"theat3": None}, "lock", "seven has no joint 'theat3'", "Did you mean theta3?"),
        ({"d1": None}, "lock", "seven has no joint 'd1'", "Its joints: theta1, theta2"),
        ({"x" * 900: None}, "lock", "...'", "Its joints"),
        (dict.fromkeys(f"theta{i}" for i in range(1, 8)), "lock", "every joint is locked", "at least one"),
        ({"theta3": math.nan}, "lock theta3", "NaN and infinity", "finite"),
        ({"theta3": "inf"}, "lock theta3", "NaN and infinity", "finite"),
        ({"theta3": "1e999"}, "lock theta3", "too large", "units"),
        ({"theta3": True}, "lock theta3", "true or false", "number"),
        ({"theta3": [1]}, "lock theta3", "a list", "number"),
        ({"theta3": ""}, "lock theta3", "the cell is empty", "0"),
        ({"theta3": "a2"}, "lock theta3", "depends on a2", "lock theta3 without a value"),
        ({"theta3": "30mm"}, "lock theta3", "has the unit mm", "deg(30)"),
        ({"theta3": "30 rad"}, "lock theta3", "has the unit rad", "in radians"),
        ({"theta3": "30"}, "lock theta3", "30 radians are more than a turn", "deg(30)"),
        ({"theta3": "__import__('os')"}, "lock theta3", "does not belong into a cell", "A cell is"),
        ({"theta7": "pi"}, "lock theta7", "pi is outside the limits of theta7", "from -3.05433 to 3.05433"),
    ],
)
def test_what_is_refused(locks: dict[str, object], where: str, what: str, remedy: str) -> None:
    with pytest.raises(RobotError) as caught:
        lock(seven(), locks)
    assert caught.value.where == where
    assert what in caught.value.what
    assert remedy in caught.value.remedy


@pytest.mark.parametrize(("value", "what"), [("30deg", "an angle"), ("pi/4", "an angle"), ("5 cm", "the unit cm")])
def test_a_length_is_no_angle(value: str, what: str) -> None:
    robot = from_inline(ON_A_RAIL, convention="paul", name="rail")
    assert lock(robot, {"d1": "12.5"}).locks == {"d1": parse("12.5")}
    with pytest.raises(RobotError, match=what):
        lock(robot, {"d1": value})


@pytest.mark.parametrize(
    ("locks", "what"),
    [
        ({"theta9": "input"}, r"\[locks\]: seven has no joint 'theta9'"),
        ({"theta3": "inputs"}, r"\[locks\] theta3: the value of a lock depends on inputs"),
        ("theta3", "locks is not a table"),
    ],
)
def test_locks_of_a_file(locks: object, what: str) -> None:
    draft = tomllib.loads(to_toml(seven()))
    with pytest.raises(RobotError, match=what):
        from_draft({**draft, "locks": locks}, where="seven.toml")
