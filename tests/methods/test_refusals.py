"""A method that does not fit says why, by name."""

from __future__ import annotations

import pytest

from kinsym.errors import DoesNotApply, NoClosedForm, RobotError
from kinsym.methods import METHODS
from kinsym.robot import from_inline, load, lock
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot

ONE_LINE = "0 0 0 theta1; 0 0 d2 theta2; pi/2 a2 0 theta3; pi/2 a3 d4 theta4; -pi/2 0 0 theta5; pi/2 0 0 theta6"
PARALLEL = "0 0 0 theta1; 0 a1 d2 theta2; 0 a2 d3 theta3; pi/2 0 d4 theta4; -pi/2 0 0 theta5; pi/2 0 0 theta6"
FIRST = "0 0 0 theta1; pi/2 0 0 theta2; -pi/2 0 d3 theta3; pi/2 a3 d4 theta4; pi/2 a4 d5 theta5; pi/2 a5 0 theta6"
SKEW = "0 0 0 theta1; pi/2 0 d2 theta2; 0 a2 0 theta3; pi/2 0 d4 theta4; -deg(60) 0 0 theta5; deg(60) 0 0 theta6"
TABLES = {"one_line": ONE_LINE, "parallel": PARALLEL, "first": FIRST, "skew": SKEW}

REASONS = [
    ("pieper", "ur5", "no three axes meet, so Pieper's solution does not apply to ur5: axes 4 and 6 miss by d5"),
    ("pieper", "fanuc_crx10ial", "axes 4 and 6 miss by d5"),
    ("pieper", "elbow_6r_screw", "axes 4 and 5 miss by a4"),
    ("pieper", "scara", "it needs six joints, this arm has 4 joints"),
    ("pieper", "abb_irb6620lx", "joint 1 slides"),
    ("pieper", "one_line", "axes 1 and 2 are one line"),
    ("pieper", "parallel", "z does not depend on theta3; axes 1, 2 and 3 are parallel"),
    ("decoupled", "first", "axes 1, 2, 3 do, but the lecture states it for the last three"),
    ("zyz", "skew", "axes 4 and 5 and axes 5 and 6 are not at right angles"),
    ("zyz", "planar_rrr_paul", "axes 1 and 2 miss by a1"),
    ("loop_closure", "puma560", "axes 1 and 2 are not parallel"),
    ("loop_closure", "gudel_fp1", "not"),
    ("geometric", "stanford_paul", "it has no elbow"),
    ("half_angle", "cylindrical_rpp", "no step of its closed form is one equation a c + b s = e, or squares added"),
    ("screws_inverse", "kuka_iiwa", "leave theta1, theta2"),
    ("workspace", "planar_rrr_paul", "its joints are R R R"),
]


def robot_of(name: str) -> Robot:
    return from_inline(TABLES[name], convention="craig", name=name) if name in TABLES else load(name)


@pytest.mark.parametrize(("method", "name", "reason"), REASONS)
def test_why_a_method_does_not_apply(method: str, name: str, reason: str) -> None:
    with pytest.raises(DoesNotApply) as refusal:
        METHODS[method](robot_of(name))
    assert reason in str(refusal.value)
    assert refusal.value.exit_status == 1


def test_an_arm_without_a_closed_form_keeps_its_verdict() -> None:
    with pytest.raises(NoClosedForm, match="no closed form"):
        METHODS["algebraic"](load("fanuc_crx10ial"))


def test_a_locked_joint_is_a_constant_row() -> None:
    held = lock(load("kuka_iiwa"), {"theta3": "0"}, where="test")
    unknowns = {solution.unknown for solution in METHODS["pieper"](held).solutions}
    assert unknowns == {"theta1", "theta2", "theta4", "theta5", "theta6", "theta7"}


def test_a_name_of_the_table_is_not_taken_for_another() -> None:
    """A table may call a length f1 or r; the method's own quantities then get another name."""
    table = "0 0 0 theta1; pi/2 r 0 theta2; 0 f1 0 theta3; pi/2 k3 z theta4; -pi/2 0 0 theta5; pi/2 0 u_3 theta6"
    derivation = METHODS["pieper"](from_inline(table, convention="craig", name="clash"))
    defined = [equation.left.name for equation in derivation.equations if hasattr(equation.left, "name")]
    assert {"f1_", "r_", "k3_", "z_", "u_3_"} <= set(defined)
    assert not {"f1", "r", "k3", "z", "u_3"} & set(defined)


def test_a_system_without_dimensions_says_what_is_missing() -> None:
    """The elbow arm of slide 5, as the lecture leaves it."""
    joints = [{"i": i, "type": "R", "variable": f"theta{i}"} for i in (1, 2, 3)]
    draft = {"name": "Elbow manipulator, 3-DoF spatial RRR", "convention": "none", "slides": [5], "joints": joints}
    with pytest.raises(RobotError) as refusal:
        from_draft(draft, where="elbow_rrr.toml")
    for word in ("no dimensions", "theta1, theta2, theta3", "rows 1 to 3 lack alpha, a, d, theta", "[home]"):
        assert word in str(refusal.value)


def test_one_cell_is_a_table_whose_other_cells_are_missing() -> None:
    joints = [{"type": "R", "variable": "theta1", "a": "l1"}, {"type": "R", "variable": "theta2"}]
    with pytest.raises(RobotError, match="alpha: the cell is missing"):
        from_draft({"name": "arm", "convention": "paul", "joints": joints}, where="arm.toml")
