"""The generated C of a robot with a loop over ``ik_near`` beside it: a million poses are ten calls."""

from __future__ import annotations

import ctypes
import tempfile
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.check.solvers import Floats, Solutions, as_float
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule

LOOP = Path(__file__).with_name("loop.c")


class Library(CSolver):
    """The compiled C for one choice of parameters; ``sources`` are its files, what is generated if None."""

    def __init__(
        self, schedule: Schedule, parameters: Mapping[str, Fraction], sources: Mapping[str, str] | None = None
    ) -> None:
        inputs = [(row, joint.name) for row, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]
        values = [as_float(parameters[parameter.name]) for parameter in schedule.parameters]
        numbers = max(1, len(values) + len(inputs))
        library = _compiled(schedule, sources or TARGETS["c"](schedule), numbers)
        super().__init__(library, schedule, parameters)
        self._joints, self._width = len(schedule.joints), schedule.maximum
        self._numbers = np.array([*values, *[0.0] * (numbers - len(values))])
        self._columns = np.array([column for column, _ in inputs], dtype=np.intc)
        self._fields = np.arange(len(values), len(values) + len(inputs), dtype=np.intc)
        self._loop = library.stress_solve
        self._loop.restype = None
        pointer = ctypes.c_void_p
        self._loop.argtypes = [pointer, pointer, ctypes.c_int, pointer, ctypes.c_int, *[pointer] * 4]

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        """``ik_near`` of poses (m, 4, 4) with references (m, n): packed solutions, NaN behind them, and their numbers.

        The number is negative where a pose was refused; a value in a solution that is no number is infinite.
        """
        poses, reference = np.ascontiguousarray(poses), np.ascontiguousarray(reference)
        q, counts = np.zeros((len(poses), self._width, self._joints)), np.zeros(len(poses), dtype=np.intc)
        address = [array.ctypes.data for array in (self._fields, self._columns, q, counts)]
        self._loop(
            poses.ctypes.data,
            reference.ctypes.data,
            len(poses),
            self._numbers.ctypes.data,
            len(self._fields),
            *address,
        )
        q[np.isnan(q)] = np.inf
        q[np.arange(self._width) >= counts[:, None]] = np.nan
        return q, counts.astype(np.intp)


def _compiled(schedule: Schedule, sources: Mapping[str, str], numbers: int) -> ctypes.CDLL:
    sizes = {
        "HEADER": f'"{schedule.name}.h"',
        "NAME": schedule.name,
        "JOINTS": str(len(schedule.joints)),
        "MOST": str(schedule.maximum),
        "NUMBERS": str(numbers),
    }
    flags = (*FLAGS, *(f"-D{name}={value}" for name, value in sizes.items()))
    with tempfile.TemporaryDirectory() as folder:
        for file, text in sources.items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        (Path(folder) / LOOP.name).write_text(LOOP.read_text(encoding="utf-8"), encoding="utf-8")
        return ctypes.CDLL(str(compile_shared(folder, schedule.name, folder, flags=flags, more=(LOOP.name,))))
