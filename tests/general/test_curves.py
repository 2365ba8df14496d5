"""Poses that a whole curve of joint vectors reaches, where the determinant vanishes at every angle; others beside."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot import from_inline
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import closures, joint_vectors, run

#: Made-up arms in Paul's convention; those of five joints are asked for a point and the z axis. With theta4 = 0, or
#: theta3 + theta4 = 0 ("straight"), joints with parallel axes move and leave the tool where it is.
TABLES = {
    "bent": "pi/2 0.185 0.338 theta1; pi/2 -0.074 d2 pi/2; -pi/2 0.556 0.067 theta3; "
    "-pi/2 0.234 0.265 theta4; 0 -0.074 0.311 theta5",
    "straight": "pi/2 0.429 d1 0; pi/2 0.205 0 theta2; 0 0.364 -0.339 theta3; "
    "pi/2 -0.44 0.356 theta4; 0 0.065 0 theta5",
    "plane": "pi/2 0 0.113 theta1; 0 0.301 0.539 theta2; pi/2 0 0 theta3; "
    "-pi/2 0.584 0.446 theta4; -pi/2 0 0 theta5; 0 -0.405 d6 pi/2",
}


@cache
def schedule(name: str) -> Schedule:
    """The schedule of an arm, which has no closed form."""
    derivation = derive(from_inline(TABLES[name], convention="paul", name=name))
    assert derivation.plan is None
    return build_schedule(derivation)


def vectors(name: str, count: int) -> np.ndarray:
    """Joint vectors on such curves, and 1e-5 to 1e-15 beside."""
    q = joint_vectors(run(schedule(name)), count, seed=6)
    beside = np.resize([0.0, *10.0 ** -np.arange(5.0, 16.0)], count)
    q[:, 3] = beside - q[:, 2] if name == "straight" else beside
    return q


@pytest.mark.parametrize("name", TABLES)
def test_every_pose_has_an_exact_solution(name: str) -> None:
    arm, q = run(schedule(name)), vectors(name, 36)
    off = closures(arm, q, arm.ik_batch(arm.fk(q))[0], spin=name != "plane")
    assert np.nanmin(off, axis=1).max() < 1e-11
    assert np.nanmax(off) < 1e-10


@needs_compiler
@pytest.mark.parametrize("name", TABLES)
def test_every_pose_has_one_in_c(name: str) -> None:
    arm, q = run(schedule(name)), vectors(name, 120)
    found, _ = CSolver(CLibrary(schedule(name)).library, schedule(name), {}).inverse(arm.fk(q), q)
    off = closures(arm, q, found, spin=name != "plane")
    assert np.nanmin(off, axis=1).max() < 1e-11
    assert np.nanmax(off) < 1e-10


@pytest.mark.parametrize("name", TABLES)
def test_every_pose_has_one_with_fifty_digits(name: str) -> None:
    arm, q = run(schedule(name)), vectors(name, 6)
    found, _ = ExactSolver(schedule(name), {}).inverse(arm.fk(q), q)
    assert np.nanmin(closures(run(schedule(name)), q, found, spin=name != "plane"), axis=1).max() < 1e-12
