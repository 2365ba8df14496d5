"""Redundant arms: what to lock is said, and a locked arm keeps its names and its numbers."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from kinsym.algebra.tree import Call, Definition
from kinsym.deriving import derive
from kinsym.emit.text import equations
from kinsym.errors import NoClosedForm
from kinsym.inverse.locks import _listed
from kinsym.inverse.plan import Window
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import chain_to_solve
from kinsym.robot import from_inline, lock
from kinsym.robot.model import Task
from tests.arms import IIWA, IIWA_ON_A_RAIL, derivation


def refusal(table: str, **locks: str | None) -> str:
    """What is said of an arm that has joints to spare."""
    robot = from_inline(table, convention="paul", name="arm")
    with pytest.raises(NoClosedForm) as caught:
        derive(lock(robot, locks) if locks else robot)
    return str(caught.value)


def test_the_locks_that_help_are_named_with_the_option_to_type() -> None:
    """Locking the elbow theta4 fixes the distance of the spheres, so that one joint is left over: it does not help."""
    text = refusal(IIWA)
    assert text.startswith("7 joints are more than the 6 that the task pose fixes, so 1 must be locked")
    assert re.findall(r"(theta\d) \(8 solutions\)", text) == [f"theta{i}" for i in (1, 2, 3, 5, 6, 7)]
    assert text.endswith("Add for example --lock theta3")
    derive(lock(from_inline(IIWA, convention="paul", name="arm"), {"theta3": None}))


def test_two_joints_to_spare() -> None:
    """Pairs are tried, the rail first; with one of them locked already the other is asked for, and both are said."""
    assert refusal(IIWA_ON_A_RAIL).endswith("Add for example --lock d1 --lock theta4")
    text = refusal(IIWA_ON_A_RAIL, d1="0.5")
    assert text.startswith("7 joints that are not locked are more than the 6")
    assert text.endswith('Add for example --lock "d1=0.5" --lock theta4')


def test_a_lock_that_leaves_a_joint_over() -> None:
    text = refusal(IIWA, theta4=None)
    assert text.startswith("the 6 joints that are not locked move the end effector in only 5 independent ways")


def test_no_lock_helps() -> None:
    table = "; ".join(f"pi/2 a{i} d{i} theta{i}" for i in range(1, 8))
    assert "No closed form was found with theta1, theta2, theta3, theta4, theta5, theta6 or theta7 locked" in refusal(
        table
    )


@pytest.mark.parametrize(("items", "text"), [(["a"], "a"), (["a", "b"], "a or b"), (["a", "b", "c"], "a, b or c")])
def test_choices_are_listed_as_a_sentence_lists_them(items: list[str], text: str) -> None:
    assert _listed(items) == text


def test_axes_that_miss_have_their_numbers_in_the_whole_arm() -> None:
    """A cobot on a column: its axes 4, 5 and 6 are those of joints 5, 6 and 7."""
    table = (
        "0 0 d1 0; pi/2 0 l1 theta2; 0 a2 0 theta3; pi/2 0 0 theta4; -pi/2 0 l4 theta5; pi/2 0 l5 theta6; 0 0 l6 theta7"
    )
    chain = chain_to_solve(lock(from_inline(table, convention="paul"), {"d1": None}))
    with pytest.raises(NoClosedForm, match=r"axes 5 and 7 miss by l5. With l5 = 0 axes 5, 6, 7 would meet"):
        derive_plan(chain, Task.POSE)


def test_the_task_of_a_locked_arm() -> None:
    """Six joints of which one is locked are still asked for poses; a planar arm of four for its plane."""
    assert derivation("five_left").plan.task is Task.POSE
    assert derivation("five_left").plan.gate
    assert derivation("plane_of_four").plan.task is Task.PLANAR
    last = lock(derivation("five_left").robot, {"theta6": None})
    assert derive(replace(last, task=None)).plan.task is Task.POSE


def test_full_joint_vectors() -> None:
    """Forward kinematics and Jacobian are those of the whole arm, the plan is of six joints."""
    found = derivation("spheres")
    assert len(found.chain.joints) == len(found.jacobian.entries[0]) == 7
    assert [joint.variable for joint in found.solved.joints] == [f"theta{i}" for i in (1, 2, 4, 5, 6, 7)]
    assert found.solved.numbers == (1, 2, 4, 5, 6, 7)
    assert [value.variable for value in found.plan.values] == [f"theta{i}" for i in (1, 2, 4, 5, 6, 7)]
    assert [item.name for item in found.held] == ["c3", "s3"]
    assert found.plan.size == derive(lock(found.robot, {"theta5": "1"})).plan.size


def test_links_keep_their_numbers() -> None:
    """A locked joint moves over with the joint before it; at the ends it is a constant."""
    windows = [(w.left, w.right) for w in derivation("spheres").plan.items if isinstance(w, Window)]
    assert windows == [(0, 7), (1, 7), (3, 7), (4, 7), (5, 7), (6, 7)]
    text = equations(derivation("spheres"))
    assert "A1^-1 T_0_7 = A2 A3 A4 A5 A6 A7" in text
    assert "T_3_7 = A3^-1 A2^-1 T_1_7" in text
    first = next(w for w in derivation("spheres_first").plan.items if isinstance(w, Window))
    assert (first.left, first.right) == (1, 7)
    last = next(w for w in derivation("panda").plan.items if isinstance(w, Window))
    assert (last.left, last.right) == (0, 6)


def test_a_lock_at_zero_joins_the_groups_beside_it() -> None:
    """theta2 and theta4 turn about parallel axes while theta3 stands still."""
    found = derivation("spheres_held_plane")
    assert found.held == (Definition(name="theta3", value=found.held[0].value),)
    assert "2m4" in {angle.label for angle in found.angles}
    assert "theta2m4 = theta2 - theta4" in equations(found)


@pytest.mark.parametrize("value", ["-0.5", "3*pi/4", "-pi/3", "2"])
def test_c3_is_the_cosine_of_theta3(value: str) -> None:
    """Whatever its sign and quarter; the forward kinematics means the same by it."""
    found = derive(lock(from_inline(IIWA, convention="paul", name="arm"), {"theta3": value}))
    angle, cosine, sine = found.held
    assert (angle.name, cosine.name, sine.name) == ("theta3", "c3", "s3")
    assert cosine.value == Call("cos", (angle.value,))
    assert sine.value == Call("sin", (angle.value,))


def test_what_is_given_is_said() -> None:
    text = equations(derive(lock(from_inline(IIWA, convention="paul", name="arm"), {"theta3": None, "theta5": "pi/4"})))
    table, derived = text.partition("Parameters")[0], text.partition("Inverse kinematics")[2]
    for part in (table, derived):
        assert "  theta3 is given, an input of the inverse kinematics\n  theta5 = pi/4 is given\n" in part
    assert "  c3 = cos(theta3)\n" in derived
    assert "  s5 = sin(pi/4)\n" in derived
