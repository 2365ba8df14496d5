"""Plans solve: every solution reaches its pose and the joints that made the pose are among them.

The poses come from the generated forward kinematics, which other tests hold against the exact product of the table.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from kinsym.robot.model import Task
from tests.arms import NAMES, derivation, numpy_module

POSES = 500
ENTRIES = {
    Task.POSE: "uvwp",
    Task.POSITION: "p",
    Task.ORIENTATION: "uvw",
    Task.PLANAR: "uvwp",
    Task.SCARA: "uvwp",
    Task.POSITION_AXIS: "wp",
}


def close(found: np.ndarray, wanted: np.ndarray, revolute: np.ndarray) -> np.ndarray:
    """The distance of joint vectors, angles taken modulo a turn."""
    difference = found - wanted
    turned = (difference + np.pi) % (2 * np.pi) - np.pi
    return np.abs(np.where(revolute, turned, difference)).max(axis=-1)


def locked(module: Any, q: np.ndarray) -> dict[str, np.ndarray]:
    """The locked joints put where they are held, in ``q``; the values of those that are inputs, by name."""
    given = {}
    for name, value in getattr(module, "LOCKED", {}).items():
        column = module.JOINTS.index(name)
        if value is None:
            given[name] = q[:, column]
        else:
            q[:, column] = value
    return given


@pytest.mark.parametrize("name", NAMES)
def test_solutions_reach_their_poses_and_none_is_lost(name: str) -> None:
    module = numpy_module(name)
    generator = np.random.default_rng(7)
    parameters = {
        key: generator.uniform(0.2, 1.0) if value is None else value for key, value in module.PARAMETERS.items()
    }
    count = len(module.JOINTS)
    q = generator.uniform(-3.0, 3.0, (POSES, count))
    given = locked(module, q)
    T = module.fk(q, **parameters)
    found, valid = module.ik_batch(T, reference=q, **given, **parameters)
    columns = ["uvwp".index(column) for column in ENTRIES[derivation(name).plan.task]]
    reached = module.fk(np.where(valid[..., None], found, 0.0), **parameters)
    closure = np.abs(reached - T[:, None])[..., :3, columns].max(axis=(-1, -2))
    assert closure[valid].max() < 1e-9
    revolute = np.array([kind == "R" for kind in module.JOINT_TYPES])
    distance = np.where(valid, close(found, q[:, None], revolute), np.inf)
    assert distance.min(axis=1).max() < 1e-6
    assert valid.sum(axis=1).min() >= 1
    assert not np.isnan(found[valid]).any()


@pytest.mark.parametrize("name", NAMES)
def test_no_solution_comes_twice(name: str) -> None:
    module = numpy_module(name)
    generator = np.random.default_rng(8)
    parameters = {
        key: generator.uniform(0.2, 1.0) if value is None else value for key, value in module.PARAMETERS.items()
    }
    revolute = np.array([kind == "R" for kind in module.JOINT_TYPES])
    q = generator.uniform(-3.0, 3.0, (50, len(module.JOINTS)))
    given = locked(module, q)
    for k, pose in enumerate(module.fk(q, **parameters)):
        solutions = module.ik(pose, **{name: values[k] for name, values in given.items()}, **parameters)
        for i, first in enumerate(solutions):
            for second in solutions[i + 1 :]:
                assert close(first, second, revolute) > 1e-7
