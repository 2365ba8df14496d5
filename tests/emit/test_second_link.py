"""A triangle whose second link loses its length where the step before it is at a border."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule, Solve
from kinsym.robot import from_inline
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import run

#: Made-up arms in Paul's convention: axes 1 and 2 are parallel, axis 3 crosses axis 2.
ARMS = {
    "crossed": "0 -0.378 0.274 theta1; -pi/2 0 0 theta2; pi/2 -0.139 0 theta3; "
    "-pi/2 0 0.125 theta4; pi/2 0 0 theta5; 0 0 -0.52 theta6",
    "offset": "0 0.284 0 theta1; pi/2 0 0.214 theta2; 0 0.09 0 theta3; "
    "-pi/2 0 0 theta4; pi/2 0 0 theta5; 0 0.48 -0.467 theta6",
}
#: Where the wrist is on axis 2.
FOLDED = {"crossed": np.arctan2(0.139, 0.125), "offset": np.pi / 2}


@cache
def schedule(name: str) -> Schedule:
    """The schedule of an arm."""
    return build_schedule(derive(from_inline(ARMS[name], convention="paul", name=name)))


def joint_vectors(name: str) -> np.ndarray:
    """Vectors with the wrist on axis 2, and ever farther beside it."""
    q = np.random.Generator(np.random.PCG64(8)).uniform(-3.0, 3.0, (28, 6))
    q[:, 2] = FOLDED[name] + np.tile([0.0, *10.0 ** -np.arange(3.0, 16.0)], 2)
    return q


@pytest.mark.parametrize("name", ARMS)
def test_a_wrist_on_axis_2_is_reached(name: str) -> None:
    arm, q = run(schedule(name)), joint_vectors(name)
    poses = arm.fk(q)
    solutions, valid = arm.ik_batch(poses)
    assert valid.any(axis=1).all()
    reached = arm.fk(np.where(valid[..., None], solutions, 0.0))
    assert np.abs(reached - poses[:, None])[valid].max() < 1e-9
    _, count = ExactSolver(schedule(name), {}).inverse(poses[:3], q[:3])
    assert (count > 0).all()


@needs_compiler
@pytest.mark.parametrize("name", ARMS)
def test_it_is_reached_in_c(name: str) -> None:
    arm, q = run(schedule(name)), joint_vectors(name)
    _, count = CSolver(CLibrary(schedule(name)).library, schedule(name), {}).inverse(arm.fk(q), q)
    assert (count > 0).all()


def test_links_of_constant_length_stay_as_they_are() -> None:
    numbers = (
        "0 0.317 0.588 theta1; 0 -0.451 0.52 theta2; 0 0.513 d3 pi/2; "
        "-pi/4 0 0.152 theta4; -pi/4 0 0 theta5; 0 0.426 0.122 theta6"
    )
    arm = build_schedule(derive(from_inline(numbers, convention="paul", name="bent")))
    assert any(isinstance(item, Solve) and item.step.rule == "triangle" for item in arm.inverse)
    assert "1e-30" not in "".join(TARGETS["c"](arm).values())
    assert "1e-30" in "".join(TARGETS["c"](schedule("crossed")).values())
