"""The generated NumPy module: laws of the arms, shapes, and refusals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tests.emit.built import numpy_module, same_angles
from tests.emit.schedules import planar_2r, polar, puma

PUMA, PLANAR, POLAR = numpy_module(puma()), numpy_module(planar_2r()), numpy_module(polar())


def joint_vectors(count: int, joints: int, seed: int = 1) -> np.ndarray:
    """Random joint vectors over the whole range."""
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (count, joints))


def puma_poses(kind: str, count: int) -> np.ndarray:
    """Joint vectors of the Puma that are ordinary, or at a singularity, or as near to it as 10^-k."""
    q = joint_vectors(count, 6)
    offset = 10.0 ** -np.random.default_rng(2).uniform(3, 16, count)
    if kind.startswith("wrist"):
        q[:, 4] = 0.0
    if kind.startswith("elbow"):
        # a3 s3 + d4 c3 = 0: stretched, or folded.
        q[:, 2] = np.where(np.arange(count) % 2, math.atan2(0.4318, -0.0203), math.atan2(-0.4318, 0.0203))
    if kind == "wrist, nearly":
        q[:, 4] += offset
    if kind == "elbow, nearly":
        q[:, 2] += offset
    return q


@pytest.mark.parametrize("module", [PUMA, PLANAR, POLAR], ids=lambda module: module.NAME)
def test_every_solution_reaches_the_pose_and_the_known_one_is_among_them(module: Any) -> None:
    known = joint_vectors(1000, len(module.JOINTS))
    poses = module.fk(known)
    q, valid = module.ik_batch(poses)
    parts = [3] if module.TASK == "position" else [0, 1, 2, 3]
    closure = np.abs(module.fk(np.where(valid[..., None], q, 0.0)) - poses[:, None])[..., parts].max(axis=(-2, -1))
    assert (closure[valid] < 1e-12).all()
    assert np.isnan(q[~valid]).all()
    assert ((q[valid] > -np.pi) & (q[valid] <= np.pi)).all()
    found = np.where(valid, same_angles(np.nan_to_num(q), known[:, None]), np.inf).min(axis=1)
    assert (found < 1e-9).all()


def _without_noise(q: np.ndarray) -> np.ndarray:
    """What a pose near the wrist's singularity determines: the arm, theta5, and the sum of theta4 and theta6."""
    return np.concatenate([q[..., [0, 1, 2, 4]], q[..., 3:4] + q[..., 5:6]], axis=-1)


@pytest.mark.parametrize("kind", ["wrist", "elbow", "wrist, nearly", "elbow, nearly"])
def test_singular_poses_of_the_puma(kind: str) -> None:
    known = puma_poses(kind, 400)
    poses = PUMA.fk(known)
    q, valid = PUMA.ik_batch(poses, reference=known)
    closure = np.abs(PUMA.fk(np.where(valid[..., None], q, 0.0)) - poses[:, None]).max(axis=(-2, -1))
    assert (closure[valid] < 1e-12).all()
    assert valid.any(axis=1).all()
    found = np.where(valid, same_angles(_without_noise(np.nan_to_num(q)), _without_noise(known)[:, None]), np.inf)
    # Two elbows 3e-7 apart are one; folded, the wrist is next to the shoulder and theta2 feels it 800 times.
    assert (found.min(axis=1) < (1e-3 if kind == "elbow, nearly" else 1e-6)).all()
    if kind == "wrist":
        # Noise of the pose can exceed the tolerance where the arm is near another border; the wrist is then not free.
        free = valid & (same_angles(np.nan_to_num(q[..., 3:4]), known[:, None, 3:4]) < 1e-9)
        assert free.any(axis=1).mean() > 0.95
    if kind == "elbow":
        assert valid.sum(axis=1).max() <= 4


def test_stretched_planar_arm_has_one_solution_and_beyond_none() -> None:
    pose = np.eye(4)
    for reach, count in [(1.2, 1), (1.2 - 1e-9, 2), (1.2 + 1e-11, 0), (0.2, 1), (0.2 - 1e-11, 0), (5.0, 0)]:
        pose[:2, 3] = reach * math.cos(2.0), reach * math.sin(2.0)
        assert PLANAR.ik(pose).shape == (count, 2)
        q, valid = PLANAR.ik_batch(pose)
        assert np.isnan(q[~valid]).all()


def test_a_pose_known_less_well_has_a_wider_border() -> None:
    pose = np.eye(4)
    pose[0, 3] = 1.2 + 1e-9
    assert PLANAR.ik(pose).shape == (0, 2)
    pose[0, 0] += 1e-8
    assert PLANAR.ik(pose).shape == (1, 2)


def test_free_joint_follows_the_reference() -> None:
    folded = np.eye(4)
    assert PLANAR.ik(folded, a1=0.5).tolist() == [[0.0, np.pi]]
    np.testing.assert_allclose(PLANAR.ik(folded, a1=0.5, reference=[0.4, 9.0]), [[0.4, np.pi]])
    np.testing.assert_allclose(POLAR.ik(folded, reference=[-2.0, 9.0]), [[-2.0, 0.0]])


def test_gate_keeps_only_what_reaches_the_task() -> None:
    pose = np.eye(4)
    pose[:3, 3] = 0.3, 0.4, 0.0
    angle = math.atan2(0.4, 0.3)
    np.testing.assert_allclose(POLAR.ik(pose), [[angle, 0.5], [angle - np.pi, -0.5]])
    pose[2, 3] = 1e-6
    assert POLAR.ik(pose).shape == (0, 2)


@pytest.mark.parametrize("lead", [(), (3,), (2, 3), (0,), (2, 0)])
def test_shapes(lead: tuple[int, ...]) -> None:
    q = np.random.default_rng(3).uniform(-1.0, 1.0, (*lead, 6))
    poses = PUMA.fk(q)
    assert poses.shape == (*lead, 4, 4)
    assert PUMA.jacobian(q).shape == (*lead, 6, 6)
    solutions, valid = PUMA.ik_batch(poses, reference=q)
    assert solutions.shape == (*lead, 8, 6)
    assert valid.shape == (*lead, 8)
    for place in np.ndindex(lead):
        one = PUMA.ik(poses[place], reference=q[place])
        np.testing.assert_allclose(one, solutions[place][valid[place]], rtol=0, atol=1e-14)


def test_blocks_do_not_show() -> None:
    poses = PUMA.fk(joint_vectors(5000, 6))
    q, valid = PUMA.ik_batch(poses)
    tail, tail_valid = PUMA.ik_batch(poses[4090:4100])
    np.testing.assert_array_equal(q[4090:4100], tail)
    np.testing.assert_array_equal(valid[4090:4100], tail_valid)


def test_special_poses_of_several_blocks_are_settled_as_alone() -> None:
    known = joint_vectors(2 * PUMA._BLOCK + 100, 6)
    places = np.array([0, 7, PUMA._BLOCK - 1, PUMA._BLOCK, 2 * PUMA._BLOCK + 50, 2 * PUMA._BLOCK + 99])
    known[places] = np.concatenate([puma_poses("wrist", 3), puma_poses("elbow, nearly", 3)])
    poses = PUMA.fk(known)
    q, valid = PUMA.ik_batch(poses, reference=known)
    assert np.isnan(q[~valid]).all()
    for place in places:
        alone = PUMA.solve(poses[place], reference=known[place])
        np.testing.assert_array_equal(np.flatnonzero(valid[place]), alone.branch)
        np.testing.assert_allclose(q[place][valid[place]], alone.q, rtol=0, atol=1e-13)


def test_more_special_poses_than_a_block_holds() -> None:
    known = np.repeat(puma_poses("wrist", 7), PUMA._BLOCK // 7 + 2, axis=0)
    q, valid = PUMA.ik_batch(PUMA.fk(known), reference=known)
    each = len(known) // 7
    for kind in range(7):
        np.testing.assert_array_equal(valid[kind * each : (kind + 1) * each], valid[[kind * each]].repeat(each, axis=0))
    assert (np.where(valid, same_angles(np.nan_to_num(q), known[:, None]), np.inf).min(axis=1) < 1e-6).all()


@pytest.mark.parametrize("module", [PUMA, PLANAR, POLAR], ids=lambda module: module.NAME)
def test_jacobian_is_the_derivative_of_the_forward_kinematics(module: Any) -> None:
    q, h = joint_vectors(20, len(module.JOINTS)), 1e-6
    J = module.jacobian(q)
    for joint in range(q.shape[1]):
        step = np.zeros(q.shape[1])
        step[joint] = h
        rate = (module.fk(q + step) - module.fk(q - step)) / (2 * h)
        spin = rate[:, :3, :3] @ module.fk(q)[:, :3, :3].transpose(0, 2, 1)
        numeric = np.concatenate([rate[:, :3, 3], spin[:, [2, 0, 1], [1, 2, 0]]], axis=-1)
        np.testing.assert_allclose(J[:, :, joint], numeric, atol=1e-8)


def _spoiled(place: tuple[int, int], value: float) -> np.ndarray:
    pose = PUMA.fk(np.full(6, 0.3))
    pose[place] = value
    return pose


@pytest.mark.parametrize(
    "pose",
    [
        np.eye(3),
        np.zeros((4, 4)),
        np.eye(4) * 2.0,
        np.diag([1.0, 1.0, -1.0, 1.0]),  # a reflection
        _spoiled((0, 3), math.nan),
        _spoiled((1, 1), math.nan),
        _spoiled((1, 3), math.inf),
        _spoiled((2, 2), math.inf),
        _spoiled((3, 0), 1e-6),
        _spoiled((0, 0), 5.0),
        _spoiled((0, 3), 1e151),
        [["a"] * 4] * 4,
        None,
        {},
    ],
)
def test_what_is_no_pose_is_refused(pose: Any) -> None:
    with pytest.raises(ValueError, match=r"pose|could not convert"):
        PUMA.ik(pose)


def test_a_bad_pose_is_named() -> None:
    poses = PUMA.fk(joint_vectors(5000, 6))
    poses[4500, 0, 0] += 1e-3
    with pytest.raises(ValueError, match="pose 4500"):
        PUMA.ik_batch(poses)


def test_bad_arguments_are_refused() -> None:
    pose = PUMA.fk(np.zeros(6))
    with pytest.raises(ValueError, match="a2 must be a finite number"):
        PUMA.ik(pose, a2=math.nan)
    with pytest.raises(ValueError, match=r"\(\.\.\., 6\)"):
        PUMA.fk(np.zeros(5))
    with pytest.raises(ValueError, match="reference"):
        PUMA.ik(pose, reference=np.zeros(5))
    with pytest.raises(ValueError, match="reference"):
        PUMA.ik(pose, reference=np.full(6, math.inf))
    with pytest.raises(ValueError, match="ik_batch"):
        PUMA.ik(pose[None])
    with pytest.raises(TypeError, match="a2"):
        numpy_module(planar_2r(a2=None)).fk([0.0, 0.0])


def test_rotation_off_by_rounding_is_mended() -> None:
    known = joint_vectors(100, 6)
    poses = PUMA.fk(known)
    poses[:, :3, :3] += np.random.default_rng(5).uniform(-1e-9, 1e-9, (100, 3, 3))
    q, valid = PUMA.ik_batch(poses)
    found = np.where(valid, same_angles(np.nan_to_num(q), known[:, None]), np.inf).min(axis=1)
    assert np.median(found) < 1e-7
    closure = np.abs(PUMA.fk(np.where(valid[..., None], q, 0.0)) - poses[:, None]).max(axis=(-2, -1))
    assert closure[valid].max() < 1e-8


def test_the_pose_that_is_mended_is_a_copy() -> None:
    pose = PUMA.fk(np.full(6, 0.4))
    pose[0, 0] += 1e-9
    before = pose.copy()
    for solve in (PUMA.ik, PUMA.ik_batch, PUMA.solve):
        solve(pose)
        np.testing.assert_array_equal(pose, before)


def test_constants() -> None:
    assert (PUMA.NAME, PUMA.TITLE, PUMA.TASK, PUMA.MAX_SOLUTIONS) == ("puma", "Unimation Puma 560", "pose", 8)
    assert tuple(f"theta{i}" for i in range(1, 7)) == PUMA.JOINTS
    assert POLAR.JOINT_TYPES == ("R", "P")
    assert PUMA.PARAMETERS == {"a2": 0.4318, "a3": 0.0203, "d3": 0.1501, "d4": 0.4318}
    assert POLAR.PARAMETERS == {}
    assert numpy_module(planar_2r(a2=None)).PARAMETERS == {"a1": 0.7, "a2": None}


def test_huge_and_tiny_arms_do_not_warn() -> None:
    for scale in (1e-60, 1e-3, 1e3, 1e70, 1e140):
        lengths = {name: scale * value for name, value in PUMA.PARAMETERS.items()}
        poses = PUMA.fk(joint_vectors(50, 6), **lengths)
        q, valid = PUMA.ik_batch(poses, **lengths)
        assert np.isfinite(q[valid]).all()
        closure = np.abs(PUMA.fk(np.where(valid[..., None], q, 0.0), **lengths) - poses[:, None])
        assert (closure[valid] < 1e-9 * np.array([1.0, 1.0, 1.0, scale])).all()
        if scale < 1e60:
            assert valid.any(axis=1).all()
