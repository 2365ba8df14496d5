"""A parameter that is zero at run time: the solver solves, or says by name which solver is wanted."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from types import ModuleType

import numpy as np
import pytest

from kinsym.algebra.tree import Sym
from kinsym.deriving import derive
from kinsym.emit.latex import document
from kinsym.emit.program import build_schedule
from kinsym.emit.text import equations
from kinsym.errors import NoClosedForm
from kinsym.robot import bind, from_inline
from tests.arms import KINDS, LOCKED, SHAPES, derivation, numpy_module, robot
from tests.emit.built import CLibrary, needs_compiler
from tests.general.arms import run

POSES = 20


def values(module: ModuleType, zero: str) -> dict[str, float]:
    """The table's values, made-up ones where it has none, and a zero."""
    rng = np.random.Generator(np.random.PCG64(1))
    made_up = {name: float(rng.uniform(0.2, 0.9)) for name in module.PARAMETERS}
    return {name: made_up[name] if value is None else value for name, value in module.PARAMETERS.items()} | {zero: 0.0}


def joint_vectors(module: ModuleType) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Random joint vectors, and what is given of them."""
    rng = np.random.Generator(np.random.PCG64(2))
    sliding = np.array([kind == "P" for kind in module.JOINT_TYPES])
    q = rng.uniform(-1.0, 1.0, (POSES, len(sliding))) * np.where(sliding, 1.0, np.pi)
    given = {}
    for name, value in getattr(module, "LOCKED", {}).items():
        place = module.JOINTS.index(name)
        if value is None:
            given[name] = q[:, place]
        else:
            q[:, place] = value
    return q, given


def missed(module: ModuleType, solutions: np.ndarray, q: np.ndarray) -> int:
    """How many of the joint vectors are not among the solutions of their poses."""
    sliding = np.array([kind == "P" for kind in module.JOINT_TYPES])
    gap = solutions - q[:, None]
    gap = np.where(sliding, gap, gap - 2 * np.pi * np.round(gap / (2 * np.pi)))
    near = np.where(np.isnan(gap).any(axis=-1), np.inf, np.abs(gap).max(axis=-1)).min(axis=1)
    return int((near > 1e-6).sum())


def needed(name: str) -> list[str]:
    """The parameters of which the plan needs that they, or sine or cosine of them, do not vanish."""
    plan = derivation(name).plan or derivation(name).general
    assert plan is not None
    return [parameter for item in plan.nonzero for parameter in item.parameters]


@pytest.mark.parametrize("name", [*SHAPES, *KINDS, *LOCKED])
def test_a_zero_is_solved_or_refused_by_name(name: str) -> None:
    try:
        module = numpy_module(name)
    except NoClosedForm:
        return
    q, given = joint_vectors(module)
    for zero in module.PARAMETERS:
        parameters = values(module, zero)
        poses = module.fk(q, **parameters)
        if zero in needed(name):
            with pytest.raises(ValueError, match=f"{zero} must not vanish here; kinsym derive with --bind {zero}="):
                module.ik_batch(poses, **given, **parameters)
        else:
            assert missed(module, module.ik_batch(poses, **given, **parameters)[0], q) == 0


@pytest.mark.parametrize(
    ("name", "zero"),
    [("general_pieper", "a2"), ("general_pieper", "d3"), ("meeting_234", "a4"), ("parallel_123", "a3"), ("ur5", "d4")],
)
def test_what_is_solved_is_what_the_arm_with_the_zero_has(name: str, zero: str) -> None:
    module = numpy_module(name)
    folded = run(build_schedule(derive(bind(robot(name), {zero: Fraction(0)}))))
    q, _ = joint_vectors(module)
    parameters = values(module, zero)
    poses = module.fk(q, **parameters)
    _, valid = module.ik_batch(poses, **parameters)
    del parameters[zero]
    _, others = folded.ik_batch(poses, **parameters)
    assert valid.sum(axis=1).tolist() == others.sum(axis=1).tolist()


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("general_pieper", {"a1"}),
        ("symbolic_pieper", {"a1", "salpha1"}),
        ("meeting_234", {"a5"}),
        ("puma560", {"a2"}),
        ("five_joints", {"a2"}),
        ("four_parallel", {"a4"}),
        ("planar_rr", {"l1", "l2"}),
        ("gantry_wrist", set()),
    ],
)
def test_the_plan_lists_what_it_needs_and_no_more(name: str, wanted: set[str]) -> None:
    plan = derivation(name).plan
    assert plan is not None
    assert {item.value.name for item in plan.nonzero if isinstance(item.value, Sym)} == wanted
    assert len(plan.nonzero) == len(wanted)


def test_a_point_that_turns_round_nothing_is_named() -> None:
    """Four axes meet where d3 vanishes: the triangle of a4 and a5 has its third corner on its first."""
    table = "-pi/2 0 0 theta1; pi/2 0 0 theta2; -pi/2 0 d3 theta3; 0 a4 0 theta4; -pi/2 a5 0 theta5; 0 a6 0 theta6"
    plan = derive(from_inline(table, convention="paul", name="arm")).plan
    assert plan is not None
    assert {item.value for item in plan.nonzero} == {Sym("d3"), Sym("a4")}


@pytest.mark.parametrize("tiny", [1e-16, -1e-16, 5e-324])
def test_rounding_does_not_hide_a_zero(tiny: float) -> None:
    module = numpy_module("symbolic_pieper")
    parameters = values(module, "a1") | {"a1": 0.3}
    for change in ({"a1": tiny}, {"alpha1": tiny}, {"alpha1": np.pi}):
        with pytest.raises(ValueError, match="must not vanish"):
            module.ik(np.eye(4), **(parameters | change))
        with pytest.raises(ValueError, match="must not vanish"):
            module.solve(np.eye(4), **(parameters | change))
    thousandth = {name: 1e-3 * value for name, value in parameters.items() if not name.startswith("alpha")}
    module.ik(np.eye(4), **(parameters | thousandth))
    assert np.isfinite(module.fk(np.zeros(6), **(parameters | {"a1": 0.0}))).all()


@needs_compiler
@pytest.mark.parametrize("name", ["general_pieper", "symbolic_pieper", "meeting_234", "spheres"])
def test_the_c_has_a_status_for_it(name: str) -> None:
    library, module = CLibrary(build_schedule(derivation(name))), numpy_module(name)
    locked = dict.fromkeys(getattr(module, "LOCKED", {}), 0.5)
    for zero in module.PARAMETERS:
        status = library.status(np.eye(4), values(module, zero) | locked)
        assert (status == -2) == (zero in needed(name))


@cache
def lengths() -> tuple[ModuleType, list[str]]:
    """A general six-joint arm of symbols, and what its plan needs."""
    table = (
        "pi/2 a1 d1 theta1; pi/2 a2 d2 theta2; deg(60) a3 d3 theta3; "
        "pi/2 a4 d4 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6"
    )
    found = derive(from_inline(table, convention="paul", name="lengths"))
    assert found.general is not None
    return run(build_schedule(found)), [name for item in found.general.nonzero for name in item.parameters]


def test_an_arm_without_a_closed_form_needs_its_ways_round_the_loop() -> None:
    module, wanted = lengths()
    assert 0 < len(wanted) < 6
    q, _ = joint_vectors(module)
    for zero in module.PARAMETERS:
        parameters = values(module, zero)
        poses = module.fk(q, **parameters)
        if zero in wanted:
            with pytest.raises(ValueError, match=f"{zero} must not vanish"):
                module.ik_batch(poses, **parameters)
        else:
            assert missed(module, module.ik_batch(poses, **parameters)[0], q) == 0


def test_the_derivation_says_what_it_holds_for() -> None:
    assert "for a1 != 0, salpha1 != 0" in equations(derivation("symbolic_pieper"))
    assert r"This holds for $a_{1} \neq 0$, $s\alpha_{1} \neq 0$." in document(derivation("symbolic_pieper"))
    assert "!= 0" not in equations(derivation("gantry_wrist"))
