"""Squares that add up to one, next to poses where one of them is one: the rest of the unit vector keeps the digits."""

from __future__ import annotations

from functools import cache

import numpy as np

from kinsym.algebra.tree import symbols
from kinsym.check.c_solver import CSolver
from kinsym.check.exact_solver import ExactSolver
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule, Solve
from kinsym.inverse.plan import Step
from kinsym.robot import from_inline
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import closures, run

#: A made-up arm in Paul's convention, asked for a point and the z axis: axes 1 and 4 are parallel if theta3 = 0.
ARM = "-pi/2 0.063 0.198 theta1; 0 0.591 d2 0; -pi/2 0.051 -0.267 theta3; pi/2 -0.129 0 theta4; 0 0.423 d5 0"


@cache
def schedule() -> Schedule:
    """The schedule of the arm."""
    return build_schedule(derive(from_inline(ARM, convention="paul", name="parallel")))


def quartic() -> Step:
    """The step for the angle about the tool's axis."""
    (step,) = (item.step for item in schedule().inverse if isinstance(item, Solve) and item.step.rule == "quartic")
    return step


def joint_vectors() -> np.ndarray:
    """Vectors with theta3 = 0 or pi, and ever farther beside."""
    q = np.random.Generator(np.random.PCG64(9)).uniform(-1.5, 1.5, (56, 5))
    q[:, 2] = np.repeat([0.0, np.pi], 28) + np.tile([0.0, *10.0 ** -np.arange(3.0, 16.0)], 4)
    return q


def test_it_is_stated_by_the_rest_of_the_unit_vector_too() -> None:
    step = quartic()
    assert "what is left of a unit vector" in step.why
    assert "w_z" in symbols(step.inputs["l"])
    assert sum(left == "0" for left, _ in step.solution) == 2


def test_every_pose_is_reached() -> None:
    q = joint_vectors()
    off = closures(run(schedule()), q, run(schedule()).ik_batch(run(schedule()).fk(q), reference=q)[0], spin=True)
    assert np.nanmin(off, axis=1).max() < 1e-11
    assert np.nanmax(off) < 1e-9


@needs_compiler
def test_every_pose_is_reached_in_c() -> None:
    q = joint_vectors()
    solutions, _ = CSolver(CLibrary(schedule()).library, schedule(), {}).inverse(run(schedule()).fk(q), q)
    off = closures(run(schedule()), q, solutions, spin=True)
    assert np.nanmin(off, axis=1).max() < 1e-11
    assert np.nanmax(off) < 1e-9


def test_the_roots_are_known_with_all_digits() -> None:
    q = joint_vectors()[4:12]
    solutions, count = ExactSolver(schedule(), {}).inverse(run(schedule()).fk(q), q)
    assert (count > 0).all()
    assert np.nanmax(closures(run(schedule()), q, solutions, spin=True)) < 1e-12
