"""The batch functions of the generated C give what the functions for one pose give, at poses of every kind."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline
from tests.arms import derivation
from tests.emit.built import CLibrary, needs_compiler, same_angles
from tests.emit.schedules import planar_2r, polar, puma

pytestmark = needs_compiler

BY_HAND = {"planar_2r": planar_2r, "polar": polar, "puma": puma}
#: By what they bring: a pole, a discriminant, lengths as quotients, no branch, two statements of one angle and a gate,
#: a triangle after the wrist, inputs and a quotient, an input that is a length, a length in the last branch.
LANES = (
    *BY_HAND,
    "skew_wrist",
    "planar_rpr",
    "slides_between",
    "three_slides",
    "scorbot_5r",
    "ur5",
    "spheres",
    "rail",
    "stanford_screw",
)
#: Arms whose solvers search for roots: a polynomial of degree four, one of degree 16 with an input.
LOOPED = ("general_3r", "rethink_sawyer")
POSES = 400
ROUNDING = 1e-14


@cache
def library(name: str) -> CLibrary:
    """The compiled C of an arm."""
    return CLibrary(BY_HAND[name]() if name in BY_HAND else build_schedule(derivation(name)))


def lengths_of(name: str) -> dict[str, float]:
    """A length for every parameter that the table leaves to the caller."""
    parameters = library(name).schedule.parameters
    return {item.name: 0.3 + 0.07 * place for place, item in enumerate(parameters) if item.value is None}


def joint_vectors(schedule: Schedule, seed: int = 3) -> np.ndarray:
    """Random ones, ones at multiples of a right angle in some joints or in all, and ones next to these."""
    random = np.random.default_rng(seed)
    shape = POSES, len(schedule.joints)
    q = random.uniform(-np.pi, np.pi, shape)
    share = random.choice([0.0, 0.0, 0.4, 1.0], POSES)[:, None]
    q = np.where(random.random(shape) < share, random.integers(-2, 3, shape) * (np.pi / 2), q)
    beside = 10.0 ** random.uniform(-16.0, -1.0, POSES) * random.integers(0, 2, POSES)
    return q + random.normal(size=shape) * beside[:, None]


def poses_of(name: str, seed: int = 3) -> np.ndarray:
    """Poses that are reached, out of reach, at the base, off by rounding and more, and none at all."""
    built, random = library(name), np.random.default_rng(seed)
    poses = np.array([built.fk(q, lengths_of(name)) for q in joint_vectors(built.schedule, seed)])
    poses[100:150, :3, 3] *= random.uniform(0.0, 3.0, (50, 1))
    poses[150:200, :3, :3] += random.uniform(-1.0, 1.0, (50, 3, 3)) * 10.0 ** random.uniform(-15.0, -4.0, (50, 1, 1))
    poses[200:210, :3, 3] *= 10.0 ** random.uniform(-16.0, -3.0, (10, 1))
    poses[210:230].reshape(20, 16)[range(20), random.integers(0, 16, 20)] = random.choice([np.nan, np.inf], 20)
    poses[230:240, :3, 3] = 0.0
    poses[240] = np.zeros((4, 4))
    poses[241:245, 0, :3] *= -1.0
    poses[245:250, 3, 3] = 1.5
    poses[250:252, 0, 3] = 1e149, 1e151
    return poses


def test_solutions_and_their_numbers_are_those_of_one_pose_after_the_other() -> None:
    """For each arm, also with a reference that free joints take."""
    for name in (*LANES, *LOOPED):
        built, poses = library(name), poses_of(name)
        if name in LOOPED:
            poses = poses[::10]
        parameters = lengths_of(name) | dict.fromkeys(built.schedule.inputs, 0.4)
        reference = np.linspace(-1.0, 1.0, built.joints)
        reached, counts, q = built.ik_batch(poses, reference, parameters)
        one_by_one(built, poses, [parameters] * len(poses), (counts, q), reference)
        assert reached == (counts > 0).sum()
        assert reached > 0


def one_by_one(
    built: CLibrary,
    poses: np.ndarray,
    parameters: list[dict[str, float]],
    found: tuple[Any, Any],
    reference: Any = None,
) -> None:
    """Every row of the numbers of solutions and of the solutions against ik_near."""
    counts, q = found
    revolute = np.array([joint.kind == "R" for joint in built.schedule.joints])
    for row, pose in enumerate(poses):
        count, solutions = built.ik(pose, reference, parameters[row])
        assert counts[row] == count, (built.schedule.name, row)
        ours = q[row, : max(count, 0)]
        if count > 0 and revolute.any():
            assert same_angles(ours[:, revolute], solutions[:, revolute]).max() <= ROUNDING
        np.testing.assert_allclose(ours[:, ~revolute], solutions[:, ~revolute], rtol=ROUNDING, atol=ROUNDING)
        assert ((ours[:, revolute] > -np.pi) & (ours[:, revolute] <= np.pi)).all() or built.schedule.inputs


@pytest.mark.parametrize("name", ["spheres", "rail"])
def test_locked_joints_have_a_value_for_each_pose(name: str) -> None:
    """One that is no number spoils its own pose alone."""
    built, poses = library(name), poses_of(name)
    (joint,), lengths = built.schedule.inputs, lengths_of(name)
    values = joint_vectors(built.schedule)[:, [item.name for item in built.schedule.joints].index(joint)].copy()
    values[7] = np.nan
    reached, counts, q = built.ik_batch(poses, None, lengths, (values,))
    one_by_one(built, poses, [lengths | {joint: value} for value in values], (counts, q))
    assert counts[7] == -2
    assert counts[6] > 0
    assert reached == (counts > 0).sum()


@pytest.mark.parametrize("number", [0, 1, 63, 64, 65, 129])
def test_any_number_of_poses(number: int) -> None:
    built, poses = library("puma"), poses_of("puma")[:number]
    reached, counts, q = built.ik_batch(poses)
    assert reached == (counts > 0).sum()
    one_by_one(built, poses, [{}] * number, (counts, q))
    vectors = joint_vectors(built.schedule)[:number]
    one = np.array([built.fk(each) for each in vectors]).reshape(-1, 4, 4)
    np.testing.assert_allclose(built.fk_batch(vectors), one, atol=1e-14)


@pytest.mark.parametrize("name", ["puma", "polar", "three_slides", "rethink_sawyer"])
def test_forward_kinematics(name: str) -> None:
    """Angles of many turns, infinite ones and what is no number come out as those of fk."""
    built = library(name)
    q = joint_vectors(built.schedule)
    q[1:5] *= np.array([1e3, 1e5, 1e9, 1e300])[:, None]
    q[5, 0], q[6, -1] = np.nan, np.inf
    one = np.array([built.fk(each, lengths_of(name)) for each in q])
    size = np.fmax(1.0, np.nanmax(np.abs(np.where(np.isinf(one), 0.0, one)), axis=(1, 2), keepdims=True))
    np.testing.assert_allclose(built.fk_batch(q, lengths_of(name)) / size, one / size, atol=1e-14)


def test_an_arm_whose_numbers_are_constants_alone() -> None:
    """Twists that are no special angles, and no length: there is nothing to read of the parameters."""
    rows = "1 0 0 theta1; 1.2 0 0 theta2; 0 0 0 theta3"
    schedule = build_schedule(derive(from_inline(rows, convention="paul", name="twisted")))
    assert schedule.constants
    assert not schedule.parameters
    built, q = CLibrary(schedule), joint_vectors(schedule)
    np.testing.assert_allclose(built.fk_batch(q), [built.fk(each) for each in q], atol=1e-14)


def test_other_parameters_and_what_they_must_be() -> None:
    built, poses = library("puma"), poses_of("puma")
    lengths = {"a2": 0.5, "d3": 0.0}
    _, counts, q = built.ik_batch(poses, None, lengths)
    one_by_one(built, poses, [lengths] * len(poses), (counts, q))
    vectors = joint_vectors(built.schedule)
    one = [built.fk(each, lengths) for each in vectors]
    np.testing.assert_allclose(built.fk_batch(vectors, lengths), one, atol=1e-14)
    reached, counts, q = built.ik_batch(poses, None, {"a2": np.nan})
    assert reached == -2
    assert (counts == 99).all()
    assert (q == 99.0).all()
    built = library("spheres")
    given = lengths_of("spheres") | {"theta3": 0.5}
    for name in given:
        assert built.ik_batch(poses_of("spheres"), None, given | {name: np.nan})[0] == -2


def test_a_length_that_the_caller_must_give() -> None:
    built = CLibrary(planar_2r(a2=None))
    q = np.array([[0.3, 0.4], [1.0, -2.0]])
    assert np.isnan(built.fk_batch(q)).all()
    poses = built.fk_batch(q, {"a2": 0.6})
    assert built.ik_batch(poses)[0] == -2
    reached, counts, found = built.ik_batch(poses, None, {"a2": 0.6})
    assert reached == 2
    one_by_one(built, poses, [{"a2": 0.6}] * 2, (counts, found))


def test_the_header_tells_which_arms_are_solved_in_a_loop() -> None:
    for name in (*LANES, *LOOPED):
        header = TARGETS["c"](library(name).schedule)[f"{library(name).schedule.name}.h"]
        assert ("this is a loop over ik_near" in header) == (name in LOOPED)
        assert ("-mavx2 -mfma" in header) == (name not in LOOPED)
