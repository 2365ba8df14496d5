"""Pieper's solution: the arms that need square and add, counted against a search that knows nothing of it."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from kinsym.algebra.ring import Poly
from kinsym.inverse.plan import Plan
from kinsym.inverse.rules import TITLES
from kinsym.inverse.rules.square_and_add_slide import _leading
from kinsym.kinematics.chain import build_chain
from kinsym.robot import load
from tests.arms import NAMES, derivation, numpy_module

STARTS, STEPS = 300, 60


def rules(plan: Plan) -> list[tuple[str, str, int]]:
    """What each step finds, how, and how often."""
    return [(step.unknown, step.rule, step.branches) for step in plan.steps]


@pytest.mark.parametrize("name", ["general_pieper", "symbolic_pieper"])
def test_pieper_eliminates_theta2_first(name: str) -> None:
    """The lecture's order: theta3 by the squares of r and z, theta2 by r and z, theta1 by the wrist, the wrist."""
    plan = derivation(name).plan
    assert rules(plan)[:3] == [("theta3", "quartic", 4), ("theta2", "quotient", 1), ("theta1", "quotient", 1)]
    assert [step.unknown for step in plan.steps[3:]] == ["theta4", "theta5", "theta6"]
    assert plan.maximum == 8
    r, z, *again = plan.steps[0].equations
    assert (r.source, z.source) == (
        "square of column p of T_0_6 = A1 A2 A3 A4 A5 A6",
        "row z, column p of T_0_6 = A1 A2 A3 A4 A5 A6",
    )
    assert {equation.source.rpartition(" of ")[2] for equation in again} == {"A1^-1 T_0_6 = A2 A3 A4 A5 A6"}


def test_the_same_from_the_other_end() -> None:
    plan = derivation("pieper_first").plan
    assert [rule for _, rule, _ in rules(plan)][:3] == ["quartic", "quotient", "quotient"]
    assert {step.unknown for step in plan.steps[:3]} == {"theta4", "theta5", "theta6"}
    assert plan.maximum == 8


def test_only_arms_without_a_shorter_way_need_it() -> None:
    """It is the dearest rule: the gallery's plans, and those of all other shapes, do without."""
    need = {name for name in NAMES if any(step.rule == "quartic" for step in derivation(name).plan.steps)}
    pieper = {"general_3r", "general_pieper", "symbolic_pieper", "pieper_first"}
    assert need == pieper | {"parallel_123", "meeting_234", "meeting_345", "sliding_rpr", "sliding_rrp"}
    assert "quartic" in TITLES


def wrapped(angles: np.ndarray) -> np.ndarray:
    """Angles in [-pi, pi)."""
    return np.asarray((angles + np.pi) % (2.0 * np.pi) - np.pi)


def by_newton(module: object, point: np.ndarray, parameters: dict[str, float], random: np.random.Generator) -> int:
    """How many joint vectors reach a point: Newton's method with damping from many random starts."""
    q = random.uniform(-np.pi, np.pi, (STARTS, 3))
    for _ in range(STEPS):
        error = point - module.fk(q, **parameters)[:, :3, 3]  # type: ignore[attr-defined]
        J = module.jacobian(q, **parameters)[:, :3]  # type: ignore[attr-defined]
        damping = 1e-2 * np.square(error).sum(axis=1)[:, None, None] * np.eye(3)
        gradient = np.einsum("nij,ni->nj", J, error)
        step = np.linalg.solve(np.einsum("nij,nik->njk", J, J) + damping + 1e-30 * np.eye(3), gradient[..., None])
        q = q + np.clip(step[..., 0], -0.5, 0.5)
    reached = np.abs(module.fk(q, **parameters)[:, :3, 3] - point).max(axis=1) < 1e-10  # type: ignore[attr-defined]
    different: list[np.ndarray] = []
    for found in q[reached]:
        if all(np.abs(wrapped(found - other)).max() > 1e-4 for other in different):
            different.append(found)
    return len(different)


def test_all_solutions_of_the_general_3r_arm_are_found() -> None:
    """As many as Newton's method finds from 300 random starts, at random points of random arms."""
    module = numpy_module("general_3r")
    random = np.random.default_rng(11)
    counts = []
    for _ in range(12):
        parameters = {name: random.uniform(0.2, 1.0) for name in module.PARAMETERS}
        for q in random.uniform(-3.0, 3.0, (3, 3)):
            T = module.fk(q, **parameters)
            counts.append((len(module.ik(T, **parameters)), by_newton(module, T[:3, 3], parameters, random)))
    assert all(ours == theirs for ours, theirs in counts), counts
    assert {ours for ours, _ in counts} == {2, 4}


@pytest.mark.parametrize("distance", [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3])
@pytest.mark.parametrize("axis", [1, 2])
def test_solutions_are_exact_next_to_the_axes(distance: float, axis: int) -> None:
    """Where the point lies on axis 1 theta1 is free, on axis 2 theta2; next to them two roots are close."""
    module = numpy_module("general_3r")
    random = np.random.default_rng(2)
    tried = 0
    while tried < 20:
        parameters = {name: random.uniform(0.2, 1.0) for name in module.PARAMETERS}
        q = random.uniform(-3.0, 3.0, 3)
        if axis == 2:
            # a3 c3 + a2 = 0: the point lies on axis 2, as d3 = 0.
            parameters["a3"] = parameters["a2"] + random.uniform(0.1, 0.5)
            q[2] = np.arccos(-parameters["a2"] / parameters["a3"])
        else:
            for _ in range(30):
                away, J = module.fk(q, **parameters)[:2, 3], module.jacobian(q, **parameters)[:2, 1:]
                q[1:] -= np.clip(np.linalg.lstsq(J, away, rcond=None)[0], -0.5, 0.5)
            if np.abs(module.fk(q, **parameters)[:2, 3]).max() > 1e-14:
                continue
        tried += 1
        q += distance * random.uniform(-1.0, 1.0, 3)
        T = module.fk(q, **parameters)
        found = module.ik(T, reference=q, **parameters)
        assert len(found) > 0
        assert np.abs(module.fk(found, **parameters)[:, :3, 3] - T[:3, 3]).max() < 1e-11


@pytest.mark.parametrize("place", [0, 1])
@pytest.mark.parametrize("taken", [0, 1])
def test_the_degree_that_is_left_of_squares_and_its_coefficient(place: int, taken: int) -> None:
    """(5 + 2 d + d^2)^2 - (7 + 2 d + d^2)^2 = -24 - 8 d - 4 d^2: half of it by terms that are not squares."""
    ring = build_chain(load("planar_rr")).ring

    def line(*numbers: int) -> tuple[Poly, ...]:
        return tuple(ring.number(Fraction(number)) for number in numbers)

    state = SimpleNamespace(chain=SimpleNamespace(ring=ring), values=lambda poly: [int(bool(poly))])
    lines = [line(0, 0, 0), line(0, 0, 0)]
    lines.insert(place, line(5, 2, 1))
    less = [line(0, 0, 0)]
    less.insert(taken, line(7, 2, 1))
    sides = [SimpleNamespace(rest=numbers, scale=ring.one) for numbers in lines[:2]]
    pair = SimpleNamespace(sides=sides, k1=less[0], k2=less[1])
    assert _leading(state, pair) == (2, ring.number(Fraction(-4)))


def test_the_scale_of_one_side_multiplies_the_others() -> None:
    """X = d^2/2 and Y = d/3, less k1 = d and k2 = 1: times 36 it is 9 d^4 + 4 d^2 - 36 d^2 - 36."""
    ring = build_chain(load("planar_rr")).ring
    one, zero = ring.one, ring.zero
    state = SimpleNamespace(chain=SimpleNamespace(ring=ring), values=lambda poly: [int(bool(poly))])
    sides = [
        SimpleNamespace(rest=(zero, zero, one), scale=ring.number(2)),
        SimpleNamespace(rest=(zero, one, zero), scale=ring.number(3)),
    ]
    pair = SimpleNamespace(sides=sides, k1=(zero, one, zero), k2=(one, zero, zero))
    assert _leading(state, pair) == (4, ring.number(9))
    sides[0].rest = (zero, zero, zero)
    assert _leading(state, pair) == (2, ring.number(4 - 36))
    pair.k1 = sides[1].rest = (zero, zero, zero)
    assert _leading(state, pair) == (0, zero)
