"""The compiled C, called through ctypes."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.solvers import Floats, Solutions, as_float, inputs_of
from kinsym.emit.schedule import Schedule

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
        self._places = [(len(values) + k, column) for k, (column, _) in enumerate(inputs_of(schedule))]
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
        rounding = float(np.finfo(self.real).eps) ** 0.5
        if not np.allclose(batch[:, :3], poses[:, :3], atol=rounding, equal_nan=True):
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
