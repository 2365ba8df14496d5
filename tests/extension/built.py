"""Generated packages ready to run, beside the NumPy modules whose place they take."""

from __future__ import annotations

import atexit
import shutil
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from kinsym.check.compiler import find_compiler
from kinsym.check.extension import build, headers, load_package
from kinsym.check.numpy_solver import NumpySolver
from kinsym.command.rendering import rendered
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import load
from kinsym.robot.locking import lock
from kinsym.write import write_set

#: An arm of every kind: all parameters known, an input, two inputs and more equations than joints, lengths without
#: values and a task that is a position, slides, no parameters, no closed form.
ARMS = ("puma560", "kuka_iiwa", "two_inputs", "planar_rr", "cylindrical_rpp", "spherical_wrist", "ufactory_xarm6")


class Pair(NamedTuple):
    """The same arm twice; ``given`` are the keywords that fk needs, ``asked`` those that ik needs."""

    package: Any
    module: Any
    given: dict[str, float]
    asked: dict[str, float]

    def poses(self, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Joint vectors (count, n) and their poses (count, 4, 4); an input has the value that ``asked`` gives it."""
        q = np.random.default_rng(5).uniform(-2.5, 2.5, (count, len(self.module.JOINTS)))
        for place, name in enumerate(self.module.JOINTS):
            q[:, place] = self.asked.get(name, q[:, place])
        return q, self.module.fk(q, **self.given)


@cache
def derivation(name: str) -> Derivation:
    """What is known of an arm of :data:`ARMS`."""
    if name == "two_inputs":
        return derive(lock(load("kuka_iiwa"), {"theta3": None, "theta7": None}))
    return derive(load(name))


@cache
def pair(name: str) -> Pair:
    """The package, built in a folder that goes with this process, and the module of an arm."""
    folder = Path(tempfile.mkdtemp(prefix="kinsym-test-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    found = derivation(name)
    schedule = build_schedule(found)
    write_set(folder, rendered(found, schedule, ("numpy", "extension")))
    compiler, include = find_compiler(), headers()
    assert compiler is not None, "the tests of packages need a C compiler"
    assert include is not None, "the tests of packages need Python.h"
    package: ModuleType = load_package(build(folder / f"{schedule.name}-solver", schedule.name, compiler, include))
    module = NumpySolver.load(folder / f"{schedule.name}.py")
    given = {parameter.name: 0.4 for parameter in schedule.parameters if parameter.value is None}
    return Pair(package, module, given, {**given, **dict.fromkeys(schedule.inputs, 0.3)})


def outcome(call: Callable[[], Any]) -> Any:
    """What a call returns, or the type and the words of its exception."""
    try:
        return call()
    except Exception as error:
        return type(error), str(error)


def same(one: Any, other: Any, tolerance: float = 1e-9, *, turns: bool = False) -> bool:
    """Whether two outcomes are equal but for rounding: arrays in shape, type and value, the rest exactly.

    With ``turns`` numbers may differ by whole turns: rounding decides on which side of pi an angle of pi comes out.
    """
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        if one.shape != other.shape or one.dtype != other.dtype:
            return False
        if turns and one.dtype == np.float64:
            one = one - 2.0 * np.pi * np.round((one - other) / (2.0 * np.pi))
        return np.allclose(one, other, rtol=0, atol=tolerance, equal_nan=True)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(
            same(a, b, tolerance, turns=turns) for a, b in zip(one, other, strict=True)
        )
    return type(one) is type(other) and one == other


def references(*objects: object) -> list[int]:
    """The reference counts of objects."""
    return [sys.getrefcount(item) for item in objects]
