"""Families: the free joint, what is constant and what follows; by hand from the geometry of the arms."""

from __future__ import annotations

import numpy as np
import pytest

from kinsym.algebra.tree import symbols
from kinsym.deriving import derive
from kinsym.emit.prose.singular import family_conditions
from kinsym.emit.text.formula import TextPrinter
from kinsym.inverse.families import Family
from kinsym.robot import from_inline, load, lock
from kinsym.robot.model import Task
from tests.arms import NAMES, derivation, numpy_module

WRITE = TextPrinter()


def told(name: str) -> dict[str, tuple[str, list[str], tuple[str, ...]]]:
    """Where each family is: free, constant, follows."""
    return {family_conditions(f, WRITE): (f.free, list(map(WRITE, f.constant)), f.follows) for f in families(name)}


def families(name: str) -> tuple[Family, ...]:
    """The families that are certain to exist."""
    return tuple(family for family in derivation(name).families if not family.folded)


WRIST = ("theta1", "theta2", "theta3")
KNOWN = {
    "puma560": {
        "theta5 = 0": ("theta4", ["theta4 + theta6", *WRIST], ("theta6",)),
        "theta5 = pi": ("theta4", ["theta4 - theta6", *WRIST], ("theta6",)),
    },
    "fanuc_s900w": {
        "theta5 = 0": ("theta4", ["theta4 + theta6", *WRIST], ("theta6",)),
        "theta5 = pi": ("theta4", ["theta4 - theta6", *WRIST], ("theta6",)),
        "a2*c2 + a3*c23 + d4*s23 + a1 = 0": ("theta1", ["theta2", "theta3"], ("theta4", "theta5", "theta6")),
    },
    "ur5": {
        "theta5 = 0": ("theta234", ["theta234 + theta6", "theta1"], ("theta2", "theta3", "theta4", "theta6")),
        "theta5 = pi": ("theta234", ["theta234 - theta6", "theta1"], ("theta2", "theta3", "theta4", "theta6")),
    },
    "stanford_paul": {
        "d3 = 0": ("theta2", ["theta1"], ("theta4", "theta5", "theta6")),
        "theta5 = 0": ("theta4", ["theta4 + theta6", "theta1", "theta2", "d3"], ("theta6",)),
        "theta5 = pi": ("theta4", ["theta4 - theta6", "theta1", "theta2", "d3"], ("theta6",)),
    },
    "scorbot_5r": {
        "theta234 = 0, a2*c2 + a3*c23 + a1 = 0": (
            "theta1",
            ["theta1 - theta5", "theta2", "theta3", "theta4"],
            ("theta5",),
        ),
        "theta234 = pi, a2*c2 + a3*c23 + a1 = 0": (
            "theta1",
            ["theta1 + theta5", "theta2", "theta3", "theta4"],
            ("theta5",),
        ),
    },
    "cylindrical_rpp": {"d3 = 0": ("theta1", ["d2"], ())},
}


@pytest.mark.parametrize("name", KNOWN)
def test_known_families(name: str) -> None:
    assert told(name) == KNOWN[name]


@pytest.mark.parametrize("name", NAMES)
def test_every_step_that_can_be_degenerate_has_its_family(name: str) -> None:
    arm = derivation(name)
    constant = {n for n, _ in arm.solved.constants.formulas()} | set(arm.robot.parameters)
    free = {family.free for family in arm.families}
    for step in arm.plan.steps:
        if step.degenerate is not None and step.rule in ("homogeneous", "homogeneous2", "direction"):
            assert step.unknown in free or set(symbols(step.degenerate[0])) <= constant


def test_equal_links_folded_leave_the_first_joint_free() -> None:
    robot = from_inline("0 l 0 theta1; 0 l 0 theta2; 0 b 0 theta3", convention="paul", name="folded")
    (family,) = derive(robot).families
    assert not family.folded
    assert family_conditions(family, WRITE) == "theta2 = pi"
    assert (family.free, list(map(WRITE, family.constant))) == ("theta1", ["theta1 + theta3"])


def test_unequal_links_say_what_the_family_would_need() -> None:
    (family,) = derivation("planar_rr").families
    assert family.folded
    assert (family.free, family.constant, family.follows) == ("theta1", (), ())


@pytest.mark.parametrize(("name", "sign"), [("puma560", 1), ("fanuc_s900w", 1)])
def test_the_generated_solver_moves_along_the_family(name: str, sign: int) -> None:
    module = numpy_module(name)
    given = {parameter: 0.3 for parameter, value in module.PARAMETERS.items() if value is None}
    start = np.array([0.3, -0.5, 0.4, 0.7, 0.0, -0.2])
    pose = module.fk(start, **given)
    for free in (-1.0, 0.2, 1.5):
        found = module.ik(pose, reference=[0, 0, 0, free, 0, 0], **given)
        on_it = found[np.abs(found[:, 4]) < 1e-9]
        assert len(on_it)
        assert np.allclose(on_it[:, 3], free)
        total = on_it[:, 3] + sign * on_it[:, 5]
        same_arm = np.all(np.abs(on_it[:, :3] - start[:3]) < 1e-9, axis=1)
        assert same_arm.any()
        assert np.allclose(np.cos(total[same_arm] - 0.5), 1.0)


def test_the_task_of_the_plan_decides() -> None:
    assert derivation("scara").plan.task is Task.SCARA
    assert told("scara") == {}


@pytest.mark.parametrize(
    ("joint", "where"),
    [
        ("theta3", {"s4*s3 = 0, p07_x = 0, p07_y = 0": "theta1", "s4*c3 = 0, d5*c4 + d3 = 0": "theta2"}),
        ("theta2", {"d5*c3*s4*c2 - d5*c4*s2 - s2*d3 = 0, s3*s4 = 0": "theta1"}),
    ],
)
def test_what_has_to_vanish_is_told_and_a_length_never_does(joint: str, where: dict[str, str]) -> None:
    # theta4 is free where kappa1 = -2*d3*d5 and kappa2 are zero, which two lengths never are
    found = derive(lock(load("kuka_iiwa"), {joint: None})).families
    assert {family_conditions(f, WRITE): f.free for f in found if not f.constant} == where


def test_what_is_too_long_to_read_keeps_its_name() -> None:
    assert "mu5^2 + nu6^2 = 0" in told("symbolic_pieper")
