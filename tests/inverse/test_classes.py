"""Every class of arms with a closed form: random arms are derived, solved, and counted against a blind search.

The arms are those of :mod:`tests.classes`; an arm whose joints repeat each other for its task is passed over, and
each class must yield enough that are not.
"""

from __future__ import annotations

import tomllib
import types
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest

from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.errors import NoClosedForm, RobotError
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.tasks import fitting_task, rank, told
from kinsym.robot.files import from_draft
from kinsym.robot.model import Convention, Robot, Task
from tests.classes import CLASSES, arms

WANTED, DRAWN = 2, 12
POSES, COUNTED, STARTS, ITERATIONS = 200, 2, 80, 50
COLUMNS = {
    Task.POSE: "uvwp",
    Task.POSITION: "p",
    Task.ORIENTATION: "uvw",
    Task.PLANAR: "uvwp",
    Task.SCARA: "uvwp",
    Task.POSITION_AXIS: "wp",
}


def usable(robot: Robot) -> bool:
    """Whether no joint repeats others for the robot's task."""
    chain = build_chain(robot)
    return rank(told(chain, robot.task or fitting_task(chain, chain))) == len(chain.joints)


def robots(name: str) -> Iterator[Robot]:
    """The first usable arms of a class."""
    left = WANTED
    for text in arms(name, DRAWN):
        robot = from_draft(tomllib.loads(text), where=name, bindings={})
        if left and usable(robot):
            left -= 1
            yield robot
    assert not left, f"{name} draws too few arms that its task needs whole"


@cache
def solved(name: str) -> tuple[tuple[Derivation, Any], ...]:
    """The derivations of some arms of a class and their NumPy modules."""
    return tuple((found, module_of(found)) for found in map(derive, robots(name)))


def module_of(found: Derivation) -> Any:
    """The NumPy module of a derivation."""
    module = types.ModuleType(found.robot.name)
    (source,) = TARGETS["numpy"](build_schedule(found)).values()
    exec(compile(source, "arm.py", "exec"), module.__dict__)
    return module


class Poses:
    """Random joint vectors of one arm, their poses and all solutions."""

    def __init__(self, found: Derivation, module: Any) -> None:
        self.module, self.random = module, np.random.default_rng(3)
        self.parameters = {
            key: self.random.uniform(0.2, 1.0) if value is None else value for key, value in module.PARAMETERS.items()
        }
        self.revolute = np.array([kind == "R" for kind in module.JOINT_TYPES])
        self.columns = ["uvwp".index(column) for column in COLUMNS[found.plan.task]]
        self.q = self.random.uniform(-1.0, 1.0, (POSES, len(module.JOINTS))) * np.where(self.revolute, 3.0, 1.0)
        self.T = module.fk(self.q, **self.parameters)
        self.found, self.valid = module.ik_batch(self.T, reference=self.q, **self.parameters)

    def away(self, q: np.ndarray, T: np.ndarray) -> np.ndarray:
        """What is missing to poses T, one row each, in the entries of the task."""
        difference = (self.module.fk(q, **self.parameters) - T)[..., :3, self.columns]
        return difference.reshape(*difference.shape[:-2], -1)

    def distance(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """The largest difference of joint vectors, angles taken modulo a turn."""
        difference = first - second
        turned = (difference + np.pi) % (2.0 * np.pi) - np.pi
        return np.asarray(np.abs(np.where(self.revolute, turned, difference)).max(axis=-1))

    def blind(self, T: np.ndarray) -> np.ndarray:
        """Joint vectors that reach a pose: damped least squares with numeric derivatives from random starts."""
        joints = len(self.revolute)
        q = self.random.uniform(-np.pi, np.pi, (STARTS, joints)) * np.where(self.revolute, 1.0, 0.5)
        damping = np.full(STARTS, 1e-2)
        away = self.away(q, T)
        steps = 1e-6 * np.eye(joints)
        for _ in range(ITERATIONS):
            J = np.stack([self.away(q + h, T) - self.away(q - h, T) for h in steps], axis=-1) / 2e-6
            normal = np.einsum("nij,nik->njk", J, J) + damping[:, None, None] * np.eye(joints)
            step = np.linalg.solve(normal, np.einsum("nij,ni->nj", J, away)[..., None])[..., 0]
            trial = self.away(q - step, T)
            better = np.square(trial).sum(axis=1) < np.square(away).sum(axis=1)
            q, away = np.where(better[:, None], q - step, q), np.where(better[:, None], trial, away)
            damping = np.clip(np.where(better, 0.2 * damping, 4.0 * damping), 1e-14, 1e6)
        return np.asarray(q[np.abs(away).max(axis=1) < 1e-9])


@pytest.mark.parametrize("name", CLASSES)
def test_random_arms_are_solved(name: str) -> None:
    """Solutions reach the pose, the known joint vector is there, none comes twice, a blind search finds no other."""
    for found, module in solved(name):
        poses = Poses(found, module)
        missing = np.abs(poses.away(np.where(poses.valid[..., None], poses.found, 0.0), poses.T[:, None])).max(axis=-1)
        size = np.where(poses.revolute, 1.0, np.abs(np.where(poses.valid[..., None], poses.found, 0.0))).max(axis=-1)
        assert (missing / np.maximum(size, 1.0))[poses.valid].max() < 1e-9, found.robot
        known = np.where(poses.valid, poses.distance(poses.found, poses.q[:, None]), np.inf)
        assert known.min(axis=1).max() < 1e-6, found.robot
        for row in range(POSES):
            own = poses.found[row][poses.valid[row]]
            apart = poses.distance(own[:, None], own[None]) + np.eye(len(own))
            assert apart.min() > 1e-7, found.robot
        for row in range(COUNTED):
            own = poses.found[row][poses.valid[row]]
            for q in poses.blind(poses.T[row]):
                assert poses.distance(own, q).min() < 1e-4, found.robot


@pytest.mark.parametrize("name", ["meeting_tip", "meeting_middle", "meeting_tip_sliding", "elbow_wrist"])
def test_the_same_arms_as_screws(name: str) -> None:
    """Axes that meet, given by points anywhere on them, as in the table of rows."""
    tried = 0
    for found, module in solved(name):
        try:
            robot = convert(found.robot, Convention.SCREW)
            build_chain(robot)
        except RobotError:
            continue
        tried += 1
        screws = derive(robot)
        assert screws.plan.maximum == found.plan.maximum
        poses = Poses(screws, module_of(screws))
        known = np.where(poses.valid, poses.distance(poses.found, poses.q[:, None]), np.inf)
        assert known.min(axis=1).max() < 1e-6, robot
        assert (
            np.abs(poses.module.fk(poses.q, **poses.parameters) - module.fk(poses.q, **poses.parameters)).max() < 1e-9
        )
    assert tried


def test_the_blind_search_sees_a_missing_solution() -> None:
    found, module = solved("elbow_wrist")[0]
    poses = Poses(found, module)
    reached = poses.blind(poses.T[0])
    own = poses.found[0][poses.valid[0]]
    assert len(own) > 1
    lost = [
        i for i in range(len(own)) if any(poses.distance(np.delete(own, i, axis=0), q).min() > 1e-4 for q in reached)
    ]
    assert lost


@pytest.mark.parametrize("name", ["meeting_tip_sliding", "three_slides", "planar"])
def test_the_joints_stay_what_the_table_says(name: str) -> None:
    """A prismatic joint moves its arm along a line and a revolute one does not, in the solved robot as in the given."""
    for robot, (found, module) in zip(robots(name), solved(name), strict=True):
        kinds = [joint.kind for joint in robot.joints if joint.variable is not None]
        assert list(module.JOINT_TYPES) == kinds == [joint.kind for joint in found.chain.joints]
        poses = Poses(found, module)
        for number, kind in enumerate(kinds):
            ends = [module.fk(poses.q[0] + t * np.eye(len(kinds))[number], **poses.parameters) for t in (0.0, 0.5, 1.0)]
            turned = np.abs(ends[1][:3, :3] - ends[0][:3, :3]).max() > 1e-9
            assert turned == (kind == "R")
            if kind == "P":
                assert np.abs(ends[0] + ends[2] - 2.0 * ends[1]).max() < 1e-12


def test_nothing_is_claimed_for_an_arm_that_would_need_another_joint() -> None:
    """A prismatic joint in an offset wrist: the same table with a revolute joint there has a closed form."""
    rows = [
        'type = "R", alpha = "pi/2", a = "a1", d = "l1", theta = "theta1"',
        'type = "R", alpha = "deg(30)", a = "a2", d = "l2", theta = "theta2"',
        'type = "R", alpha = "pi/2", a = "a3", d = "l3", theta = "theta3"',
        'type = "R", alpha = "deg(45)", a = "0", d = "l4", theta = "theta4"',
        'type = "P", alpha = "pi/2", a = "0", d = "d5", theta = "0"',
        'type = "R", alpha = "pi/2", a = "a6", d = "l6", theta = "theta6"',
    ]

    def arm(joints: list[str]) -> Robot:
        table = ", ".join(f"{{ {row} }}" for row in joints)
        text = f'name = "arm"\nconvention = "paul"\njoints = [ {table} ]'
        return from_draft(tomllib.loads(text), where="tests", bindings={})

    with pytest.raises(NoClosedForm):
        derive_plan(build_chain(arm(rows)), Task.POSE)
    rows[4] = 'type = "R", alpha = "pi/2", a = "0", d = "0", theta = "theta5"'
    assert derive(arm(rows)).plan.maximum == 8
