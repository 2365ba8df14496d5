"""One face for the three answers that must agree: the exact walk, the generated NumPy module, the compiled C.

All three take batches. ``inverse`` returns the solutions packed to the left, (m, S, n) with NaN behind them, and
how many there are, (m,). A locked joint that is an input stands where the reference joint vector has it.
"""

from __future__ import annotations

import ctypes
import importlib.util
import sys
from collections.abc import Callable, Mapping
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from kinsym.check.evaluate import Program, floating
from kinsym.check.walk import AT_THE_ORIGIN, ExactWalk
from kinsym.emit.schedule import Schedule

Floats = NDArray[np.float64]
Solutions = tuple[Floats, NDArray[np.intp]]


class Solver(Protocol):
    """Forward kinematics, Jacobian and inverse kinematics for one choice of parameters."""

    name: str

    def forward(self, q: Floats) -> Floats:
        """(m, n) joint vectors to (m, 4, 4) poses."""

    def jacobian(self, q: Floats) -> Floats:
        """(m, n) joint vectors to (m, 6, n)."""

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        """(m, 4, 4) poses and (m, n) references, which hold locked inputs, to packed solutions and their numbers."""

    def refuses(self, pose: Floats) -> bool:
        """Whether a single (4, 4) array is told to be no pose."""


def as_float(value: Fraction) -> float:
    """The nearest double."""
    return value.numerator / value.denominator


class ExactSolver:
    """The exact walk, its answers rounded to float64."""

    name = "exact walk"

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.walk = ExactWalk(schedule, parameters)
        self._shape = (schedule.maximum, len(schedule.joints))
        self._revolute = np.array([joint.kind == "R" for joint in schedule.joints])

    def forward(self, q: Floats) -> Floats:
        poses = np.zeros((len(q), 4, 4))
        poses[:, 3, 3] = 1.0
        for row, joints in enumerate(q):
            poses[row, :3] = self.walk.forward(joints.tolist())
        return poses

    def jacobian(self, q: Floats) -> Floats:
        return np.array([self.walk.jacobian(joints.tolist()) for joints in q], dtype=np.float64)

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        q = np.full((len(poses), *self._shape), np.nan)
        count = np.zeros(len(poses), dtype=np.intp)
        for row, pose in enumerate(poses):
            found = self.walk.inverse(pose.tolist(), reference[row].tolist()) or []
            count[row] = len(found)
            if found:
                q[row, : len(found)] = found
        # the nearest double of an angle just above -pi is -pi itself
        return np.where(self._revolute & (q == -np.pi), np.pi, q), count

    def refuses(self, pose: Floats) -> bool:
        return self.walk.inverse(pose.tolist()) is None


class NumpySolver:
    """A generated NumPy module, imported from its file under a private name."""

    name = "NumPy"

    def __init__(self, module: ModuleType, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.module = module
        self._inputs = _inputs(schedule)
        self.parameters = {name: as_float(value) for name, value in parameters.items()}

    @staticmethod
    def load(path: Path) -> ModuleType:
        """Import ``path`` without leaving bytecode or a name behind."""
        name = f"_kinsym_checked_{path.stem}"
        spec = importlib.util.spec_from_file_location(name, path)
        if spec is None or spec.loader is None:
            raise ImportError(f"{path.name} is no Python module")
        module = importlib.util.module_from_spec(spec)
        before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
        try:
            spec.loader.exec_module(module)
        finally:
            sys.dont_write_bytecode = before
        return module

    def forward(self, q: Floats) -> Floats:
        return np.asarray(self.module.fk(q, **self.parameters), dtype=np.float64)

    def jacobian(self, q: Floats) -> Floats:
        return np.asarray(self.module.jacobian(q, **self.parameters), dtype=np.float64)

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        q, valid = self.module.ik_batch(poses, reference=reference, **self.given(reference))
        return _packed(q, valid)

    def single(self, pose: Floats, reference: Floats) -> Floats:
        """``ik`` of one pose: (k, n)."""
        return np.asarray(self.module.ik(pose, reference=reference, **self.given(reference)), dtype=np.float64)

    def plain(self, pose: Floats) -> Floats:
        """``ik`` of one pose without a reference: (k, n)."""
        return np.asarray(self.module.ik(pose, **self.parameters), dtype=np.float64)

    def defaults(self, q: Floats) -> tuple[Floats, Floats] | None:
        """``fk`` and ``jacobian`` of (m, n) with the table's parameters; None if the table leaves one open."""
        try:
            return np.asarray(self.module.fk(q)), np.asarray(self.module.jacobian(q))
        except TypeError:
            return None

    def sweep(self, pose: Floats, reference: Floats) -> Solutions:
        """``ik_sweep`` of one pose (4, 4) over the locked inputs of (k, n) joint vectors, packed."""
        return _packed(*self.module.ik_sweep(pose, reference=reference, **self.given(reference)))

    def given(self, reference: Floats) -> dict[str, Any]:
        """The keywords of parameters and locked inputs, the latter from references (..., n)."""
        return {**self.parameters, **{name: reference[..., column] for column, name in self._inputs}}

    def status(self, pose: Floats, reference: Floats) -> str:
        """What ``solve`` says of one pose (4, 4)."""
        return str(self.module.solve(pose, reference=reference, **self.given(reference)).status)

    def nearest(self, pose: Floats, reference: Floats, weights: Floats) -> Floats | None:
        """``nearest`` of one pose, without limits."""
        unlimited = np.array([[-np.inf, np.inf]] * len(reference))
        found = self.module.nearest(pose, reference, weights=weights, limits=unlimited, **self.given(reference))
        return None if found is None else np.asarray(found, dtype=np.float64)

    def refuses(self, pose: Floats) -> bool:
        given = {**self.parameters, **{name: 0.0 for _, name in self._inputs}}
        for function in (self.module.ik, self.module.ik_batch):
            try:
                function(pose, **given)
            except ValueError:
                continue
            return False
        return True

    def refusal(self, poses: Floats) -> str:
        """Why ``ik_batch`` refuses poses (m, 4, 4); empty if it does not."""
        try:
            self.module.ik_batch(poses, **self.parameters, **{name: 0.0 for _, name in self._inputs})
        except ValueError as error:
            return str(error)
        return ""


class ExtensionSolver(NumpySolver):
    """A generated Python package, built and imported; its interface is that of the NumPy module."""

    name = "extension"


def _packed(q: Floats, valid: NDArray[np.bool_]) -> Solutions:
    order = np.argsort(~valid, axis=-1, kind="stable")
    packed = np.take_along_axis(np.where(valid[..., None], q, np.nan), order[..., None], axis=-2)
    # a NaN in a solution told to be valid must not pass for padding
    broken = np.isnan(q) & valid[..., None]
    packed[np.take_along_axis(broken, order[..., None], axis=-2)] = np.inf
    return packed, valid.sum(axis=-1)


def _inputs(schedule: Schedule) -> list[tuple[int, str]]:
    """Column and name of every locked joint that is an input."""
    return [(column, joint.name) for column, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]


#: The statuses of the C by their number, in the words of the NumPy module.
STATUS = {0: "unreachable", 1: "solved", 2: "singular", -1: "not a pose"}


class CSolver:
    """The compiled C, called through ctypes; its answers are handed on in double precision."""

    name = "C"
    #: The type of its numbers.
    real: type[np.floating[Any]] = np.float64

    def __init__(self, library: ctypes.CDLL, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.library, self.schedule = library, schedule
        self._n, self._most = len(schedule.joints), schedule.maximum
        values = [as_float(parameters[parameter.name]) for parameter in schedule.parameters]
        self._places = [(len(values) + k, column) for k, (column, _) in enumerate(_inputs(schedule))]
        number = np.ctypeslib.as_ctypes_type(self.real)
        self.given: Any = (number * max(1, len(values) + len(self._places)))(*values)
        self._fk = getattr(library, f"{schedule.name}_fk")
        self._jacobian = getattr(library, f"{schedule.name}_jacobian")
        self._ik = getattr(library, f"{schedule.name}_ik_near")
        self._fk.restype = self._jacobian.restype = None
        self._ik.restype = ctypes.c_int
        self._solve = getattr(library, f"{schedule.name}_solve")
        self._nearest = getattr(library, f"{schedule.name}_nearest")
        self._solve.restype = self._nearest.restype = ctypes.c_int
        pointer = ctypes.c_void_p
        self._solve.argtypes, self._nearest.argtypes = [pointer] * 4, [pointer] * 7
        self._fk.argtypes = self._jacobian.argtypes = [pointer, pointer, pointer]
        self._ik.argtypes = [pointer] * 4
        self._fk_batch = getattr(library, f"{schedule.name}_fk_batch")
        self._ik_batch = getattr(library, f"{schedule.name}_ik_batch")
        self._fk_batch.restype, self._ik_batch.restype = None, ctypes.c_int
        self._fk_batch.argtypes = [pointer, ctypes.c_int, pointer, pointer]
        self._ik_batch.argtypes = [pointer, ctypes.c_int, *[pointer] * (4 + len(self._places))]

    def forward(self, q: Floats) -> Floats:
        return self._each(self._fk, q, (4, 4))

    def jacobian(self, q: Floats) -> Floats:
        return self._each(self._jacobian, q, (6, self._n))

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        poses, reference = self._array(poses), self._array(reference)
        q = np.full((len(poses), self._most, self._n), np.nan)
        buffer = self._empty(self._most, self._n)
        count = np.zeros(len(poses), dtype=np.intp)
        for row in range(len(poses)):
            self.give(reference[row])
            found = self._ik(poses[row].ctypes.data, self.given, reference[row].ctypes.data, buffer.ctypes.data)
            count[row] = max(0, found)
            q[row, : count[row]] = np.where(np.isnan(buffer[: count[row]]), np.inf, buffer[: count[row]])
        return q, count

    def plain(self, pose: Floats) -> Floats:
        """``NAME_ik`` of one pose, which takes no reference: (k, n)."""
        q, pose = self._empty(self._most, self._n), self._array(pose)
        function = getattr(self.library, f"{self.schedule.name}_ik")
        function.restype, function.argtypes = ctypes.c_int, [ctypes.c_void_p] * 3
        return np.asarray(q[: max(0, function(pose.ctypes.data, self.given, q.ctypes.data))], dtype=np.float64)

    def defaults(self, q: Floats) -> tuple[Floats, Floats] | None:
        """``fk`` and ``jacobian`` of (m, n) with the table's parameters; None if the table leaves one open.

        A Jacobian in which no parameter stands needs none.
        """
        given, self.given = self.given, None
        poses, slopes = self.forward(q), self.jacobian(q)
        batch, self.given = self.forward_batch(q), given
        if not np.allclose(batch[:, :3], poses[:, :3], equal_nan=True):
            return poses, np.full_like(slopes, np.nan)
        refused = np.isnan(slopes).all() or np.array_equal(slopes, self.jacobian(q))
        return None if np.isnan(poses[:, :3]).all() and refused else (poses, slopes)

    def forward_batch(self, q: Floats) -> Floats:
        """``NAME_fk_batch`` of joint vectors (m, n)."""
        q, poses = self._array(q), self._empty(len(q), 4, 4)
        self._fk_batch(q.ctypes.data, len(q), self.given, poses.ctypes.data)
        return np.asarray(poses, dtype=np.float64)

    def inverse_batch(self, poses: Floats, reference: Floats) -> tuple[Floats, NDArray[np.intp], int]:
        """``NAME_ik_batch``: inputs come from each row of the reference (m, n), free joints from its first.

        The numbers of solutions are negative where a pose was refused; behind them the number of poses that are said to
        have a solution.
        """
        poses, first = self._array(poses), self._array(reference[0])
        values = [self._array(reference[:, column]) for _, column in self._places]
        q, counts = self._empty(len(poses), self._most, self._n), np.zeros(len(poses), dtype=np.intc)
        arrays = [first, *values, q, counts]
        reached = self._ik_batch(poses.ctypes.data, len(poses), self.given, *(array.ctypes.data for array in arrays))
        q = np.where((np.arange(self._most) < counts[:, None])[..., None], q, np.nan)
        return q, counts.astype(np.intp), int(reached)

    def status(self, pose: Floats, reference: Floats) -> str:
        """What ``NAME_solve`` says of one pose (4, 4)."""
        self.give(reference)
        pose, reference = self._array(pose), self._array(reference)
        # two ints, then for every solution its numbers, doubles at most, and the three of its mark
        out = np.empty(1 + self._most * (self._n + 2))
        status = self._solve(pose.ctypes.data, self.given, reference.ctypes.data, out.ctypes.data)
        return STATUS.get(status, str(status))

    def nearest(self, pose: Floats, reference: Floats, weights: Floats) -> Floats | None:
        """``NAME_nearest`` of one pose, without limits."""
        self.give(reference)
        pose, reference, weights = map(self._array, (pose, reference, weights))
        low, q = self._array(np.full(self._n, -np.inf)), self._empty(self._n)
        high = -low
        arrays = (reference, weights, low, high, q)
        found = self._nearest(pose.ctypes.data, self.given, *(array.ctypes.data for array in arrays))
        return np.asarray(q, dtype=np.float64) if found > 0 else None

    def give(self, reference: Floats) -> None:
        """Put the locked inputs of a reference (n,) into the struct of parameters."""
        for place, column in self._places:
            self.given[place] = reference[column]

    def refuses(self, pose: Floats) -> bool:
        pose, buffer = self._array(pose), self._empty(self._most, self._n)
        return bool(self._ik(pose.ctypes.data, self.given, None, buffer.ctypes.data) < 0)

    def _each(self, function: Callable[..., Any], q: Floats, shape: tuple[int, int]) -> Floats:
        q, result = self._array(q), self._empty(len(q), *shape)
        for row in range(len(q)):
            function(q[row].ctypes.data, self.given, result[row].ctypes.data)
        return np.asarray(result, dtype=np.float64)

    def _array(self, values: Any) -> NDArray[Any]:
        """Values as the C reads them."""
        with np.errstate(over="ignore"):
            return np.ascontiguousarray(values, dtype=self.real)

    def _empty(self, *shape: int) -> NDArray[Any]:
        """Room for what the C writes."""
        return np.full(shape, np.nan, dtype=self.real)


class TreeKinematics:
    """The forward kinematics and the Jacobian of a schedule in vectorised float64, read from the trees."""

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        numbers = floating()
        self._names = [joint.name for joint in schedule.joints]
        self.free = np.array([name not in schedule.locked for name in self._names])
        given: dict[str, Any] = {name: as_float(value) for name, value in parameters.items()}
        constants = Program(schedule.constants, (), numbers)
        self._given = constants.names(given)
        self._forward = Program(schedule.forward.definitions, schedule.forward.outputs, numbers)
        self._jacobian = Program(schedule.jacobian.definitions, schedule.jacobian.outputs, numbers)
        self.size = float(Program((), (schedule.size,), numbers)({**AT_THE_ORIGIN, **self._given})[0])

    def forward(self, q: Floats) -> Floats:
        """(..., n) to (..., 4, 4)."""
        pose = np.zeros((*q.shape[:-1], 4, 4))
        pose[..., 3, 3] = 1.0
        for position, value in enumerate(self._forward(self._with(q))):
            pose[..., position // 4, position % 4] = value
        return pose

    def jacobian(self, q: Floats) -> Floats:
        """(..., n) to (..., 6, n); a locked joint does not move, so its column is zero."""
        n = len(self._names)
        result = np.zeros((*q.shape[:-1], 6, n))
        for position, value in enumerate(self._jacobian(self._with(q))):
            result[..., position // n, position % n] = value
        result[..., ~self.free] = 0.0
        return result

    def _with(self, q: Floats) -> dict[str, Any]:
        return {**self._given, **{name: q[..., column] for column, name in enumerate(self._names)}}
