"""Locked joints in the generated code: inputs of NumPy and C, sweeps, and what is refused."""

from __future__ import annotations

import ctypes
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.emit import TARGETS
from kinsym.emit.latex import document
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from tests.arms import derivation, numpy_module
from tests.emit.built import CLibrary, needs_compiler

IIWA = "kuka_iiwa"
Q = np.array([0.4, -0.7, 0.5, 1.1, -0.3, 0.8, 2.0])
VALUES = np.linspace(-1.5, 2.5, 9)


def schedule(name: str) -> Schedule:
    """The schedule of an arm."""
    return build_schedule(derivation(name))


@cache
def library(name: str) -> CLibrary:
    """The compiled C of an arm."""
    return CLibrary(schedule(name))


def pose(name: str = IIWA) -> Any:
    """The pose of Q."""
    return numpy_module(name).fk(Q)


def test_the_locked_joint_stands_in_every_solution_as_it_is_given() -> None:
    """Also beyond a turn: it is not wrapped. The forward kinematics takes all seven values."""
    module = numpy_module(IIWA)
    for value in (0.5, 0.5 + 2 * np.pi):
        q = module.ik(pose(), theta3=value)
        assert q.shape == (8, 7)
        assert (q[:, 2] == value).all()
        assert np.abs(module.fk(q) - pose()).max() < 1e-12
        assert np.abs(q[:, [0, 1, 3, 4, 5, 6]] - Q[[0, 1, 3, 4, 5, 6]]).max(axis=1).min() < 1e-12


def test_a_joint_held_at_a_value_takes_no_argument() -> None:
    module = numpy_module("panda_held")
    assert module.LOCKED["theta7"] == math.pi / 4
    q = module.ik(module.fk([0.4, -0.7, 0.5, -1.1, -0.3, 0.8, math.pi / 4]))
    assert (q[:, 6] == math.pi / 4).all()
    assert len(q) >= 2
    with pytest.raises(TypeError, match="theta7"):
        module.ik(np.eye(4), theta7=0.5)


def test_a_sweep_is_as_many_single_calls() -> None:
    """Where the wrist is near axis 1 not every value of theta3 can be."""
    module = numpy_module(IIWA)
    near = module.fk([0.4, 0.5, 0.1, 1.1, -0.3, 0.8, 2.0])
    q, valid = module.ik_sweep(near, theta3=VALUES, reference=Q)
    assert q.shape == (len(VALUES), 8, 7)
    assert valid.shape == (len(VALUES), 8)
    assert 0 < valid.sum() < valid.size
    for k, value in enumerate(VALUES):
        alone = module.ik(near, theta3=value, reference=Q)
        np.testing.assert_allclose(q[k][valid[k]], alone, rtol=0, atol=1e-14)


def test_values_and_poses_are_broadcast() -> None:
    module = numpy_module(IIWA)
    poses = module.fk(np.random.default_rng(4).uniform(-2.0, 2.0, (5, 7)))
    q, valid = module.ik_batch(poses[:, None], theta3=VALUES)
    assert q.shape == (5, 9, 8, 7)
    single, _ = module.ik_batch(poses[3], theta3=VALUES[2])
    np.testing.assert_array_equal(q[3, 2], single)
    assert valid.any()
    with pytest.raises(ValueError, match="broadcast"):
        module.ik_batch(poses, theta3=VALUES)


def test_more_values_than_a_block_holds() -> None:
    module = numpy_module(IIWA)
    values = np.linspace(-3.0, 3.0, module._BLOCK + 3)
    q, valid = module.ik_sweep(pose(), theta3=values)
    alone = module.ik(pose(), theta3=values[-1])
    np.testing.assert_allclose(q[-1][valid[-1]], alone, rtol=0, atol=1e-14)


@pytest.mark.parametrize("value", [math.nan, math.inf, None, "x", [0.1, math.nan]])
def test_numpy_refuses_what_is_no_value(value: object) -> None:
    module = numpy_module(IIWA)
    with pytest.raises(ValueError, match=r"theta3|convert string"):
        module.ik_batch(pose(), theta3=value)


def test_numpy_refuses_a_missing_value_and_many_at_once() -> None:
    module = numpy_module(IIWA)
    for function in (module.ik, module.ik_batch, module.ik_sweep):
        with pytest.raises(TypeError, match="theta3"):
            function(pose())
    with pytest.raises(ValueError, match="one value of theta3"):
        module.ik(pose(), theta3=VALUES)
    with pytest.raises(ValueError, match=r"shape \(4, 4\)"):
        module.ik_sweep(pose()[None], theta3=VALUES)


def parameters(arm: CLibrary, *inputs: float) -> Any:
    """A filled struct of parameters."""
    values = [float(item.value) for item in arm.schedule.parameters if item.value is not None]
    return (ctypes.c_double * (len(values) + len(inputs)))(*values, *inputs)


def address(array: np.ndarray) -> Any:
    """An array as an argument of a C function."""
    return array.ctypes.data_as(ctypes.c_void_p)


@needs_compiler
def test_c_agrees_and_needs_the_value() -> None:
    arm, module = library(IIWA), numpy_module(IIWA)
    q, T = np.empty((8, 7)), np.ascontiguousarray(pose())
    for value in VALUES:
        count = arm.library.kuka_iiwa_ik(address(T), parameters(arm, value), address(q))
        np.testing.assert_allclose(q[:count], module.ik(T, theta3=value), atol=1e-12)
    assert arm.status(T) == -2  # no struct, no value
    assert arm.library.kuka_iiwa_ik(address(T), parameters(arm, math.nan), address(q)) == -2
    np.testing.assert_allclose(arm.fk(Q), T, atol=1e-15)  # forward kinematics takes the table's values without a struct
    np.testing.assert_allclose(arm.jacobian(Q), module.jacobian(Q), atol=1e-15)


@needs_compiler
def test_c_sweeps() -> None:
    arm, module, T = library(IIWA), numpy_module(IIWA), np.ascontiguousarray(pose())
    q, counts = np.full((len(VALUES) * 8 + 1, 7), 99.0), np.zeros(len(VALUES), dtype=np.intc)
    sweep = arm.library.kuka_iiwa_ik_sweep_theta3

    def swept(matrix: np.ndarray, given: Any, values: np.ndarray) -> int:
        return int(sweep(address(matrix), given, address(Q), address(values), len(values), address(q), address(counts)))

    assert swept(T, None, VALUES) == counts.sum()
    assert (q[-1] == 99.0).all()
    wanted, valid = module.ik_sweep(T, theta3=VALUES, reference=Q)
    assert (counts == valid.sum(axis=1)).all()
    for k, count in enumerate(counts):
        np.testing.assert_allclose(q[8 * k : 8 * k + count], wanted[k][valid[k]], atol=1e-12)
    assert swept(T, None, np.array([0.1, math.nan])) == -2
    assert swept(2 * T, None, VALUES) == -1
    assert swept(T, parameters(arm, math.nan), VALUES) == counts.sum()  # the value in the struct is not read


@needs_compiler
@pytest.mark.parametrize("flags", [FLAGS, ("-x", "c++", "-std=c++17", *FLAGS[1:])], ids=["c99", "c++17"])
@pytest.mark.parametrize("name", [IIWA, "rail_and_elbow", "spheres", "four_parallel_held", "five_left"])
def test_compiles_without_a_warning(name: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    for file, text in TARGETS["c"](schedule(name)).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    assert compile_shared(tmp_path, name, tmp_path, flags=flags).is_file()


def test_two_inputs_are_swept_one_by_one_in_c_and_together_in_numpy() -> None:
    from kinsym.deriving import derive
    from kinsym.robot import from_inline, lock
    from tests.arms import IIWA_ON_A_RAIL
    from tests.emit.built import numpy_module as module_of

    found = derive(lock(from_inline(IIWA_ON_A_RAIL, convention="paul", name="both"), {"d1": None, "theta4": None}))
    header = TARGETS["c"](build_schedule(found))["both.h"]
    assert "both_ik_sweep_d1(" in header
    assert "both_ik_sweep_theta4(" in header
    module = module_of(build_schedule(found))
    lengths = {"l1": 0.36, "l3": 0.42, "l5": 0.4, "l7": 0.126}
    q = np.array([0.2, 0.4, -0.7, 0.5, 1.1, -0.3, 0.8, 2.0])
    T = module.fk(q, **lengths)
    swept, valid = module.ik_sweep(T, d1=np.array([0.2, 0.3]), theta4=0.5, **lengths)
    assert swept.shape == (2, 8, 8)
    assert (swept[valid][:, 3] == 0.5).all()
    assert np.abs(swept[0][valid[0]] - q).max(axis=1).min() < 1e-12


def test_what_an_unlocked_arm_does_not_need_is_not_there() -> None:
    """Not a byte of sweeps, locks or inputs in other robots."""
    for source_of in TARGETS.values():
        for text in source_of(schedule("puma560")).values():
            assert not any(word in text for word in ("sweep", "LOCKED", "locked", "_given", "NAN, /*"))


def test_the_document_says_what_is_given() -> None:
    text = document(derivation("panda_held"))
    assert text.count(r"$\theta_{7} = \pi/4$ is given.") == 2
    assert r"c_{7} &= \cos" in text
    assert r"$\theta_{3}$ is given, an input of the inverse kinematics." in document(derivation(IIWA))
