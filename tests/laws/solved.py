"""A table solved by kinsym, with numbers: its functions in one of the languages, and its oracle."""

from __future__ import annotations

import ctypes
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import compile_shared
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Solver
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.live import live_module
from kinsym.emit.program import build_schedule
from kinsym.robot.model import Robot
from tests.laws.oracle import Oracle
from tests.laws.tables import Table

#: Values of the parameters; none is a simple multiple of another.
VALUES = {
    "alpha": Fraction("0.9"),
    "b": Fraction("0.47"),
    **{f"a{i}": Fraction(31 + 7 * i, 100) for i in range(1, 7)},
    **{f"l{i}": Fraction(29 + 11 * i, 100) for i in range(1, 7)},
}
#: Not optimised, so that the compiler takes a quarter of the time.
FLAGS = ("-std=c99", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Werror")
#: The least ratio of singular values at which a posture counts as regular.
REGULAR = 3e-3


class Arm:
    """A robot with its derivation, one of its generated solvers, and the oracle of its table.

    ``lengths`` scales those parameters that are lengths.
    """

    def __init__(
        self, table: Table, *, target: str = "numpy", lengths: Fraction = Fraction(1), robot: Robot | None = None
    ) -> None:
        self.table, self.target = table, target
        self.robot = robot or table.robot()
        self.derivation = derived(self.robot)
        values = {name: VALUES[name] * (1 if name == "alpha" else lengths) for name in self.robot.parameters}
        self.oracle = Oracle(table, {name: float(value) for name, value in values.items()})
        self.solver = solver(self.derivation, target, values)
        self.task = self.derivation.robot.task.value  # type: ignore[union-attr]
        self.maximum = build_schedule(self.derivation).maximum

    def inverse(self, pose: np.ndarray, reference: np.ndarray) -> np.ndarray:
        """All solutions (m, n) of one pose; ``reference`` holds the values of locked joints."""
        q, count = self.solver.inverse(pose[None], reference[None])
        return np.asarray(q[0, : count[0]])

    def postures(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """Random joint vectors (count, n) away from singular ones."""
        chosen: list[np.ndarray] = []
        while len(chosen) < count:
            q = rng.uniform(-1.0, 1.0, (64, len(self.table.rows))) * np.where(self.oracle.revolute, 3.1, 1.5)
            chosen += list(q[self.regularity(q) > REGULAR])
        return np.array(chosen[:count])

    def regularity(self, q: np.ndarray) -> np.ndarray:
        """The ratio of the smallest to the largest singular value of the task's Jacobian."""
        n = len(self.table.rows)
        pose = self.oracle.fk(q)
        slopes = [self.oracle.away(q + 1e-30j * unit, pose, self.task).imag / 1e-30 for unit in np.eye(n)]
        values = np.linalg.svd(np.stack(slopes, axis=-1), compute_uv=False)
        return np.asarray(values[..., -1] / values[..., 0])


def derived(robot: Robot) -> Derivation:
    """The derivation of a robot, made once for all laws that ask for it."""
    key = repr(vars(robot))
    if key not in _DERIVED:
        if len(_DERIVED) >= _MOST:
            _DERIVED.clear()
        _DERIVED[key] = derive(robot)
    return _DERIVED[key]


_DERIVED: dict[str, Derivation] = {}
_MOST = 500


def solver(derivation: Derivation, target: str, values: dict[str, Fraction]) -> Solver:
    """The generated code of a language, run in memory or compiled into a folder that does not stay."""
    schedule = build_schedule(derivation)
    if target == "numpy":
        return NumpySolver(live_module(schedule), schedule, values)
    with TemporaryDirectory() as folder:
        for name, text in TARGETS["c"](schedule).items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        library = ctypes.CDLL(str(compile_shared(folder, schedule.name, folder, flags=FLAGS)))
    return CSolver(library, schedule, values)
