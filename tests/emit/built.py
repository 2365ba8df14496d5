"""Generated source brought to life: the module imported, the C compiled and called through ctypes."""

from __future__ import annotations

import ctypes
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from kinsym.check.compiler import compile_shared, find_compiler
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.core import FILES

needs_compiler = pytest.mark.skipif(find_compiler() is None, reason="no C compiler")
#: For a template that is rendered alone, without the macros of the header.
PLAIN = replace(FILES, local="static", inlined="static inline")


def numpy_module(schedule: Schedule) -> Any:
    """The generated Python module of a schedule."""
    module = ModuleType(schedule.name)
    text = TARGETS["numpy"](schedule)[f"{schedule.name}.py"]
    exec(compile(text, f"{schedule.name}.py", "exec"), module.__dict__)
    return module


def _pointer(array: np.ndarray) -> Any:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


class CLibrary:
    """The generated C of a schedule, compiled with every warning an error."""

    def __init__(self, schedule: Schedule, extra: str = "") -> None:
        self.schedule = schedule
        self.joints = len(schedule.joints)
        with TemporaryDirectory() as folder:
            for name, text in TARGETS["c"](schedule).items():
                (Path(folder) / name).write_text(text + (extra if name.endswith(".c") else ""), encoding="utf-8")
            self.library = ctypes.CDLL(str(compile_shared(folder, schedule.name, folder)))

    def _call(self, function: str, *arguments: Any) -> int:
        return getattr(self.library, f"{self.schedule.name}_{function}")(*arguments)

    def _parameters(self, values: dict[str, float] | None) -> Any:
        if values is None:
            return None
        given = [values.get(item.name, item.value) for item in self.schedule.parameters]
        given += [values.get(name, np.nan) for name in self.schedule.inputs]
        return _pointer(np.array([float(value) for value in given]))

    def _matrix(self, function: str, q: Any, shape: tuple[int, int], parameters: dict[str, float] | None) -> np.ndarray:
        result = np.full(shape, 7.0)
        self._call(function, _pointer(np.array(q, dtype=float)), self._parameters(parameters), _pointer(result))
        return result

    def fk(self, q: Any, parameters: dict[str, float] | None = None) -> np.ndarray:
        """The pose of one joint vector."""
        return self._matrix("fk", q, (4, 4), parameters)

    def jacobian(self, q: Any, parameters: dict[str, float] | None = None) -> np.ndarray:
        """The Jacobian at one joint vector."""
        return self._matrix("jacobian", q, (6, self.joints), parameters)

    def status(self, T: Any, parameters: dict[str, float] | None = None) -> int:
        """What ik returns."""
        return self.ik(T, parameters=parameters)[0]

    def ik(self, T: Any, reference: Any = None, parameters: dict[str, float] | None = None) -> tuple[int, np.ndarray]:
        """What ik_near returns, and the solutions; rows beyond them must stay as they were."""
        q = np.full((self.schedule.maximum + 1, self.joints), 99.0)
        near = None if reference is None else _pointer(np.array(reference, dtype=float))
        count = self._call(
            "ik_near", _pointer(np.array(T, dtype=float)), self._parameters(parameters), near, _pointer(q)
        )
        assert count <= self.schedule.maximum
        assert (q[-1] == 99.0).all()
        return count, q[: max(count, 0)]

    def fk_batch(self, q: Any, parameters: dict[str, float] | None = None) -> np.ndarray:
        """What fk_batch writes for many joint vectors."""
        q = np.array(q, dtype=float).reshape(-1, self.joints)
        poses = np.full((len(q) + 1, 4, 4), 99.0)
        self._call("fk_batch", _pointer(q), len(q), self._parameters(parameters), _pointer(poses))
        assert (poses[-1] == 99.0).all()
        return poses[:-1]

    def ik_batch(
        self,
        T: Any,
        reference: Any = None,
        parameters: dict[str, float] | None = None,
        values: tuple[np.ndarray | None, ...] = (),
    ) -> tuple[int, np.ndarray, np.ndarray]:
        """What ik_batch returns, the numbers of solutions and the solutions; what lies behind must stay as it was."""
        T = np.array(T, dtype=float).reshape(-1, 16)
        q = np.full((len(T) + 1, self.schedule.maximum, self.joints), 99.0)
        counts = np.full(len(T) + 1, 99, dtype=np.int32)
        near = None if reference is None else _pointer(np.array(reference, dtype=float))
        values = values or (None,) * len(self.schedule.inputs)
        given = [None if each is None else _pointer(each) for each in values]
        reached = self._call(
            "ik_batch", _pointer(T), len(T), self._parameters(parameters), near, *given, _pointer(q), counts.ctypes
        )
        assert (q[-1] == 99.0).all()
        assert counts[-1] == 99
        return reached, counts[:-1], q[:-1]


@cache
def both(make: Any) -> tuple[Any, CLibrary]:
    """The module and the compiled library of a schedule, made once for all tests."""
    schedule = make()
    return numpy_module(schedule), CLibrary(schedule)


def same_angles(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The largest difference of angles, whole turns aside."""
    difference = np.asarray(a) - np.asarray(b)
    return np.abs(np.angle(np.exp(1j * difference))).max(axis=-1)
