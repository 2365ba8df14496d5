"""Everything that a compiled source says."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.calls import CCalls
from kinsym.check.solvers import Floats
from kinsym.emit.schedule import Schedule
from tests.sabotage.asking import controller, say
from tests.sabotage.inputs import Inputs, broken_parameters
from tests.sabotage.transcript import Transcript, flat

#: Room for so many windings; what does not fit is counted.
_LITTLE = (0, 3)


def of_c(library: ctypes.CDLL, schedule: Schedule, inputs: Sequence[Inputs]) -> Transcript:
    """What a compiled source says to the inputs of every choice of parameters."""
    told: Transcript = {}
    for number, each in enumerate(inputs):
        code = _Code(library, schedule, each)
        if number == 0:
            told.update(code.tables())
        answers = controller(code.calls, each)
        code.ordinary(answers)
        code.odd(answers)
        told.update({f"{label} of choice {number}": answer for label, answer in answers.items()})
    return told


class _Code:
    """The functions that are the C's own, asked with the inputs of one choice of parameters."""

    def __init__(self, library: ctypes.CDLL, schedule: Schedule, each: Inputs) -> None:
        parameters = {name: Fraction(value) for name, value in each.parameters.items()}
        self._solver, self._each = CSolver(library, schedule, parameters), each
        self.calls = CCalls(self._solver)
        self._shape = (schedule.maximum, len(schedule.joints))
        self._columns = [k for k, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]

    def tables(self) -> Transcript:
        """What stands in the source: names, limits, families, the table's parameters."""
        told = {name: repr(value) for name, value in self.calls.tables().items()}
        bits = range(2 ** min(self._shape[1], 8))
        told["family"] = np.array([self.calls.call("family", mask) for mask in bits])
        row = self._each.ordinary[0]
        defaults = self._solver.defaults(self._each.q[row : row + 1])
        found = self._marked(self._each.T[row : row + 1], [None], None)
        return {**told, "defaults": flat(defaults), "solutions with defaults": flat(found)}

    def ordinary(self, told: Transcript) -> None:
        """What the functions are for; a joint that is free has a reference, or none."""
        each, solver = self._each, self._solver
        many, T, q = np.concatenate([each.q, each.turned]), each.T, each.q
        say(told, "fk", solver.forward, many)
        say(told, "jacobian", solver.jacobian, many)
        say(told, "fk_batch", solver.forward_batch, many)
        for name, near in (("near", q), ("plain", [None] * len(q))):
            found, marks = self._marked(T, near, solver.given)
            told[f"{name} solutions"], told[f"{name} counts and marks"] = found, marks
        told["ik_near solutions"] = solver.inverse(T, q)[0]
        told["ik solutions"] = np.array([self._padded(pose, vector) for pose, vector in zip(T, q, strict=True)])
        for name, reference in (("batch", q[0]), ("batch, no reference", None)):
            found, counts, reached = self._batch(T, q, reference)
            told[f"{name} solutions"], told[f"{name} counts and marks"] = found, counts
            told[f"{name} reached"] = np.array([reached == (counts > 0).sum()])
        solver.give(q[each.ordinary[0]])
        for capacity in _LITTLE:
            say(told, f"within {capacity} places", partial(self._within, capacity))

    def odd(self, told: Transcript) -> None:
        """What is refused by functions that are no controller's."""
        each, solver, row = self._each, self._solver, self._each.ordinary[0]
        poses, q = np.array(list(each.odd.values())), each.q[row]
        told["refused"] = self._marked(poses, [q] * len(poses), solver.given)[1]
        told["batch refused"] = self._batch(poses, each.q[: len(poses)], None)[1]
        good = solver.given
        for k, broken in enumerate(broken_parameters(each.parameters)):
            solver.given = self.calls.given_with(broken)
            found = (solver.forward(q[None]), solver.jacobian(q[None]), solver.forward_batch(q[None]))
            say(told, f"fk with parameters {k}", tuple, found)
            told[f"batch with parameters {k}"] = self._batch(each.T[:3], each.q[:3], None)[1]
            solver.given = good

    def _marked(self, poses: Floats, references: Any, given: Any) -> tuple[Floats, np.ndarray]:
        """Solutions (m, S, n) of poses (m, 4, 4), and their numbers with their marks (m, 1 + 3 S)."""
        found, told = np.full((len(poses), *self._shape), np.nan), np.zeros((len(poses), 1 + 3 * self._shape[0]))
        for row, (pose, reference) in enumerate(zip(poses, references, strict=True)):
            if given is not None:
                self._solver.give(self._each.q[row] if reference is None else reference)
            q, marks = np.full(self._shape, np.nan), np.zeros((self._shape[0], 3), dtype=np.uint32)
            count = self.calls.call("ik_marked", pose, given, reference, q, marks)
            told[row, 0], there = count, max(0, count)
            found[row, :there], told[row, 1 : 1 + 3 * there] = q[:there], marks[:there].ravel()
        return found, told

    def _padded(self, pose: Floats, vector: Floats) -> Floats:
        """The answer (S, n) of the function that takes no reference."""
        self._solver.give(vector)
        q, found = np.full(self._shape, np.nan), self._solver.plain(pose)
        q[: len(found)] = found
        return q

    def _batch(self, T: Floats, q: Floats, reference: Floats | None) -> tuple[Floats, np.ndarray, int]:
        counts = np.full(len(T), -9, dtype=np.intc)
        found = np.full((len(T), *self._shape), np.nan)
        values = [np.ascontiguousarray(q[:, column]) for column in self._columns]
        reached = self.calls.call("ik_batch", T, len(T), self._solver.given, reference, *values, found, counts)
        found[np.arange(self._shape[0]) >= counts[:, None]] = np.nan
        return found, counts, reached

    def _within(self, capacity: int) -> tuple[Any, ...]:
        """The number, the windings and their marks where there is little room for them."""
        row, limits = self._each.ordinary[0], self._each.limits[0]
        q, marks = np.zeros((capacity + 1, self._shape[1])), np.zeros((capacity + 1, 3), dtype=np.uint32)
        ends = (np.ascontiguousarray(limits[:, 0]), np.ascontiguousarray(limits[:, 1]))
        arguments = (self._each.T[row], self._solver.given, self._each.q[row], *ends)
        return self.calls.call("within", *arguments, capacity, q, marks), q, marks
