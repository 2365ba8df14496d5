"""The control functions of one arm in both languages, with results of one form."""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from kinsym.emit.program import build_schedule
from tests.arms import derivation, numpy_module
from tests.emit.built import CLibrary

STATUS = {
    0: "unreachable",
    1: "solved",
    2: "singular",
    -1: "not a pose",
    -2: "parameter",
    -3: "reference",
    -4: "limit",
    -5: "weight",
}


class Answer(NamedTuple):
    """Joint vectors with their branches, masks of joints, status."""

    q: Any
    branch: list[int]
    free: Any
    border: Any
    status: str


def array(values: Any) -> Any:
    """A pointer to doubles, NULL for None."""
    if values is None:
        return None
    flat = np.ascontiguousarray(values, dtype=float)
    return flat.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


class CControl:
    """The compiled C of an arm; ``given`` are values of parameters and inputs in their order."""

    def __init__(self, name: str) -> None:
        self.schedule = build_schedule(derivation(name))
        self.library, self.name = CLibrary(self.schedule).library, name
        self.n, self.most = len(self.schedule.joints), self.schedule.maximum

    def __getattr__(self, function: str) -> Any:
        return getattr(self.library, f"{self.name}_{function}")

    @property
    def branches(self) -> list[str]:
        """The names that the library holds."""
        return [item.decode() for item in (ctypes.c_char_p * self.most).in_dll(self.library, f"{self.name}_branches")]

    def limits(self) -> Any:
        """The limits that the library holds, (n, 2)."""
        sides = [(ctypes.c_double * self.n).in_dll(self.library, f"{self.name}_{side}") for side in ("lower", "upper")]
        return np.array([list(side) for side in sides]).T

    def solved(self, T: Any, given: Any = None, reference: Any = None) -> Answer:
        """NAME_solve."""

        class Solutions(ctypes.Structure):
            _fields_ = (
                ("status", ctypes.c_int),
                ("count", ctypes.c_int),
                ("q", ctypes.c_double * (self.n * self.most)),
                ("marks", ctypes.c_uint * (3 * self.most)),
            )

        out = Solutions()
        status = self.solve(array(T), array(given), array(reference), ctypes.byref(out))
        assert status == out.status
        q = np.array(out.q).reshape(self.most, self.n)[: out.count]
        return self._answer(q, np.array(out.marks).reshape(-1, 3)[: out.count], STATUS[status])

    def inside(
        self, T: Any, given: Any = None, reference: Any = None, limits: Any = None, capacity: int = 5000
    ) -> tuple[int, Answer]:
        """NAME_within: the number and what was written."""
        q, marks = np.full((capacity + 1, self.n), 99.0), np.full((capacity + 1, 3), 77, dtype=np.uint32)
        low, high = (None, None) if limits is None else map(array, np.transpose(np.array(limits, dtype=float)))
        number = self.within(
            array(T),
            array(given),
            array(reference),
            low,
            high,
            capacity,
            array_of(q),
            marks.ctypes.data_as(ctypes.c_void_p),
        )
        written = max(0, min(number, capacity))
        assert (q[written:] == 99.0).all()
        return number, self._answer(q[:written], marks[:written], "")

    def closest(
        self, T: Any, reference: Any, given: Any = None, weights: Any = None, limits: Any = None
    ) -> tuple[str, Any]:
        """NAME_nearest: the status and the vector, None where it was left alone."""
        q = np.full(self.n, 99.0)
        low, high = (None, None) if limits is None else map(array, np.transpose(np.array(limits, dtype=float)))
        status = self.nearest(array(T), array(given), array(reference), array(weights), low, high, array_of(q))
        return STATUS[status], None if (q == 99.0).all() else q

    def _answer(self, q: Any, marks: Any, status: str) -> Answer:
        spread = (marks[:, 1:, None] >> np.arange(self.n, dtype=np.uint32)) & 1 != 0
        return Answer(q, marks[:, 0].tolist(), spread[:, 0], spread[:, 1], status)


def array_of(out: Any) -> Any:
    """A pointer into an array that the callee writes."""
    return out.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


@cache
def c_control(name: str) -> CControl:
    """The compiled C of an arm, made once."""
    return CControl(name)


class Case(NamedTuple):
    """One arm with numbers for every parameter and locked joint, in the words of either language."""

    module: Any
    keywords: dict[str, float]
    inputs: dict[str, float]
    given: Any


@cache
def case(name: str) -> Case:
    """Parameters without a value are 0.2, 0.3, ...; locked inputs are 0.4."""
    schedule = build_schedule(derivation(name))
    values = {
        item.name: float(item.value) if item.value is not None else 0.2 + 0.1 * k
        for k, item in enumerate(schedule.parameters)
    }
    inputs = dict.fromkeys(schedule.inputs, 0.4)
    return Case(numpy_module(name), values, inputs, [*values.values(), *inputs.values(), 0.0])


def sample(name: str, seed: int) -> Any:
    """A random joint vector, locked joints at their values, lengths of some tenths."""
    found, generator = case(name), np.random.default_rng(seed)
    schedule = build_schedule(derivation(name))
    q = np.where([joint.kind == "R" for joint in schedule.joints], 1.0, 0.2) * generator.uniform(
        -3.0, 3.0, len(schedule.joints)
    )
    for place, joint in enumerate(schedule.joints):
        if joint.name in schedule.locked:
            value = found.inputs.get(joint.name, found.module.LOCKED[joint.name])
            q[place] = value
    return q
