"""Plans: the right task, the right number of solutions, and determinants that vanish only where they must."""

from __future__ import annotations

import pytest

from kinsym.algebra.tree import symbols
from kinsym.deriving import derive
from kinsym.errors import NoClosedForm
from kinsym.inverse.plan import Definition, Plan, Step, Window
from kinsym.inverse.search import derive_plan
from kinsym.inverse.spin import spin_name
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline, load
from kinsym.robot.model import Task
from tests.arms import NAMES, derivation, robot

# Solutions of the lecture's arms (slides 50 to 75) and of the arms in their sources.
EXPECTED = {
    "planar_rr": (Task.POSITION, 2),
    "planar_rrr_paul": (Task.PLANAR, 2),
    "planar_rrr_craig": (Task.PLANAR, 2),
    "planar_rrr_screw": (Task.PLANAR, 2),
    "elbow_rrr": (Task.POSITION, 4),
    "scara": (Task.SCARA, 2),
    "cylindrical_rpp": (Task.POSITION, 2),
    "spherical_wrist": (Task.ORIENTATION, 2),
    "scorbot_5r": (Task.POSE, 4),
    "stanford_paul": (Task.POSE, 8),
    "stanford_screw": (Task.POSE, 8),
    "elbow_6r_screw": (Task.POSE, 8),
    "fanuc_s900w": (Task.POSE, 8),
    "puma560": (Task.POSE, 8),
    "ur5": (Task.POSE, 8),
}


@pytest.mark.parametrize("name", EXPECTED)
def test_task_and_number_of_solutions(name: str) -> None:
    plan = derivation(name).plan
    assert (plan.task, plan.maximum) == EXPECTED[name]


@pytest.mark.parametrize("name", EXPECTED)
def test_the_task_that_fits_is_found_without_being_named(name: str) -> None:
    from dataclasses import replace

    assert derive(replace(robot(name), task=None)).plan.task is EXPECTED[name][0]


@pytest.mark.parametrize("name", NAMES)
def test_every_quantity_is_defined_before_it_is_used(name: str) -> None:
    found = derivation(name)
    defined = set(found.robot.parameters) | {f"{c}_{r}" for c in "uvwp" for r in "xyz"} | {"tau", "size"}
    defined |= {definition.name for definition in (*found.constants, *found.held)} | set(found.robot.locks)
    for item in found.plan.items:
        if isinstance(item, Step):
            for definition in item.coefficients:
                assert set(symbols(definition.value)) <= defined
                defined.add(definition.name)
            for tree in item.inputs.values():
                assert set(symbols(tree)) <= defined
            defined |= set(item.outputs)
        else:
            for definition in item.definitions if isinstance(item, Window) else (item,):
                assert set(symbols(definition.value)) <= defined
                defined.add(definition.name)
    for value in found.plan.values:
        assert set(symbols(value.value)) <= defined


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_defined_that_nobody_reads(name: str) -> None:
    plan = derivation(name).plan
    read = {n for value in plan.values for n in symbols(value.value)}
    for item in plan.items:
        trees = [*item.inputs.values(), *(d.value for d in item.coefficients)] if isinstance(item, Step) else []
        if isinstance(item, Definition):
            trees = [item.value]
        if isinstance(item, Window):
            trees = [d.value for d in item.definitions]
        read |= {n for tree in trees for n in symbols(tree)}
    for item in plan.items:
        if isinstance(item, Definition):
            assert item.name in read
        if isinstance(item, Window):
            assert all(definition.name in read for definition in item.definitions)


@pytest.mark.parametrize(
    "name", ["puma560", "fanuc_s900w", "ur5", "elbow_6r_screw", "stanford_paul", "stanford_screw", "spherical_wrist"]
)
def test_wrist_angles_divide_by_nothing(name: str) -> None:
    """One wrist joint from a homogeneous equation; the others follow with determinant 1, also where s5 = 0."""
    rules = {step.unknown: step.rule for step in derivation(name).plan.steps}
    assert "quotient" not in rules.values()
    assert rules["theta5"] == rules["theta6"] == "direct"


def test_scorbot_states_its_first_angle_twice() -> None:
    """The position fails on axis 1, the approach direction does not (5 joints, 6 equations)."""
    step = derivation("scorbot_5r").plan.steps[0]
    assert (step.unknown, step.rule) == ("theta1", "homogeneous2")


def test_derivations_are_deterministic() -> None:
    assert derive(load("ur5")).plan == derive(load("ur5")).plan


def plan_of(table: str) -> Plan:
    """The plan of an inline table in Paul's convention."""
    return derive(from_inline(table, convention="paul", name="arm")).plan


def closed_form_of(table: str) -> Plan:
    """The closed form of an inline table, which is refused where only the general solver is left."""
    return derive_plan(build_chain(from_inline(table, convention="paul", name="arm")), Task.POSE)


def test_numbers_in_the_table_give_the_same_steps_as_symbols() -> None:
    symbolic = derivation("puma560").plan
    numeric = plan_of(
        "pi/2 0 0 theta1; 0 0.4318 0 theta2; -pi/2 0.0203 0.15005 theta3; "
        "pi/2 0 0.4318 theta4; -pi/2 0 0 theta5; 0 0 0 theta6"
    )
    assert [(s.unknown, s.rule) for s in numeric.steps] == [(s.unknown, s.rule) for s in symbolic.steps]


def test_no_closed_form_says_which_joints_and_which_lengths() -> None:
    with pytest.raises(
        NoClosedForm, match=r"theta1.*theta6.*axes 4 and 5 miss by a4, axes 5 and 6 miss by a5"
    ) as caught:
        closed_form_of(
            "pi/2 a1 d1 theta1; pi/2 a2 d2 theta2; pi/2 a3 d3 theta3; "
            "pi/2 a4 d4 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6"
        )
    assert caught.value.exit_status == 1


def test_an_offset_wrist_is_named() -> None:
    """A cobot whose axes 4 and 6 pass each other at d5, and whose axes 2 and 3 are parallel (FANUC CRX geometry)."""
    with pytest.raises(NoClosedForm, match=r"axes 4 and 6 miss by d5. With d5 = 0 axes 4, 5, 6 would meet"):
        closed_form_of(
            "pi/2 0 d1 theta1; 0 a2 0 theta2; pi/2 0 0 theta3; -pi/2 0 d4 theta4; pi/2 0 d5 theta5; 0 0 d6 theta6"
        )


def test_joints_that_repeat_each_other_are_counted() -> None:
    with pytest.raises(NoClosedForm, match=r"the 3 joints move the end effector in only 2 independent ways"):
        plan_of("pi/2 0 d1 theta1; 0 0 d2 theta2; 0 a3 0 theta3")


def test_too_many_joints_are_said_to_be_too_many() -> None:
    with pytest.raises(NoClosedForm, match=r"7 joints are more than the 6"):
        plan_of(
            "-pi/2 0 d1 theta1; pi/2 0 0 theta2; -pi/2 0 d3 theta3; pi/2 0 0 theta4; "
            "-pi/2 0 d5 theta5; pi/2 0 0 theta6; 0 0 d7 theta7"
        )


def test_the_joint_that_turns_the_tool_takes_no_name_of_the_table() -> None:
    """Five joints that place a point and an axis, counted from two, so that the next name is one of theirs."""
    rows = "; ".join(f"pi/2 a{k} d{k} theta{k}" for k in range(2, 7))
    assert spin_name(build_chain(from_inline(rows, convention="paul"))) == "theta6_"
    assert spin_name(build_chain(load("scorbot_5r"))) == "theta6"
