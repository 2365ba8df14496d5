"""Everything that generated code says to the same inputs, and whether two transcripts are the same."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any

import numpy as np

from kinsym.check.answers import CLOSE_PATH
from kinsym.check.interface import MORE_MARKS
from kinsym.check.poses import wrapped
from kinsym.check.solvers import Floats
from kinsym.emit.schedule import Schedule
from tests.sabotage.inputs import Inputs, broken_parameters, broken_vectors

#: Values that agree so well are the same but for rounding.
ROUNDING = 1e-9

#: By what was asked: words, numbers, or solutions (m, S, n) of poses, NaN where there is none.
Transcript = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Where two transcripts differ at most and by how much; 0 if nowhere, infinite if in more than rounding."""

    where: str = ""
    size: float = 0.0


def difference(good: Transcript, mutant: Transcript, inputs: Sequence[Inputs]) -> Difference:
    """The first thing that is more than rounding, else the largest rounding."""
    worst = Difference()
    for label, expected in good.items():
        size = _gap(label, expected, mutant[label], inputs)
        if size > ROUNDING:
            return Difference(where=label, size=math.inf)
        if size > worst.size:
            worst = Difference(where=label, size=size)
    return worst


def _gap(label: str, good: Any, mutant: Any, inputs: Sequence[Inputs]) -> float:
    if isinstance(good, str) or isinstance(mutant, str):
        return 0.0 if isinstance(good, str) and isinstance(mutant, str) and good == mutant else math.inf
    if good.shape != mutant.shape:
        return math.inf
    both = np.isnan(good) & np.isnan(mutant) if good.dtype.kind == "f" and mutant.dtype.kind == "f" else False
    same = (good == mutant) | both
    if same.all():
        return 0.0
    kind, _, number = label.partition(" of choice ")
    if good.dtype.kind != "f" or kind.endswith("marks"):
        rows = ~same.reshape(len(same), -1).all(axis=1)
        return ROUNDING if kind.endswith("marks") and _few(rows, inputs[int(number)]) else math.inf
    with np.errstate(invalid="ignore"):
        gaps = np.where(same, 0.0, np.abs(good - mutant) / np.maximum(1.0, np.abs(good)))
    if (gaps <= ROUNDING).all():
        return float(gaps.max())
    return _solution_gap(good, mutant, inputs[int(number)]) if kind.endswith("solutions") else math.inf


def _solution_gap(good: Floats, mutant: Floats, inputs: Inputs) -> float:
    """Solutions are the same if a way on which the pose stays joins them; where two singularities meet those are wanted
    that reach the pose."""
    judge = inputs.judge
    with np.errstate(invalid="ignore"):
        apart = np.abs(wrapped(mutant - good, judge.revolute)).max(axis=-1)
    there = [~np.isnan(q).any(axis=-1) for q in (good, mutant)]
    rows = np.flatnonzero((there[0] != there[1]).any(axis=1) | (there[0] & ~(apart <= ROUNDING)).any(axis=1))
    poses = inputs.T[rows]
    closures = judge.closures(mutant[rows], poses)
    if (np.where(there[1][rows], closures, 0.0) > ROUNDING).any():
        return math.inf
    judged = ~inputs.loose[rows]
    judge = replace(judge, path=max(judge.path, CLOSE_PATH))
    left, right = (_packed(q[rows][judged]) for q in (good, mutant))
    other = np.zeros(len(good), dtype=bool)
    other[rows[judged]] = ~judge.agreement(left, right, poses[judged])[1]
    other[rows[judged]] |= (left[1] != right[1]) & inputs.firm[rows][judged]
    return ROUNDING if _few(other, inputs) else math.inf


def _few(other: np.ndarray, inputs: Inputs) -> bool:
    """Whether poses (m,) at which something is another lie at the ends of bands, as few as the checks let pass."""
    soft = ~inputs.firm & ~inputs.loose
    return not (other & inputs.firm).any() and int((other & soft).sum()) <= 1 + int(soft.sum()) // MORE_MARKS


def _packed(q: Floats) -> tuple[Floats, np.ndarray]:
    there = ~np.isnan(q).any(axis=-1)
    order = np.argsort(~there, axis=1, kind="stable")
    return np.take_along_axis(q, order[..., None], axis=1), there.sum(axis=1)


def of_numpy(module: ModuleType, schedule: Schedule, inputs: Sequence[Inputs]) -> Transcript:
    """What a module says."""
    told: Transcript = {}
    for name in ("NAME", "JOINTS", "JOINT_TYPES", "PARAMETERS", "TASK", "MAX_SOLUTIONS", "BRANCHES", "LIMITS"):
        told[name] = repr(getattr(module, name, None))
    for number, each in enumerate(inputs):
        answers = _Module(module, schedule, each)
        answers.ordinary()
        answers.odd()
        told.update({f"{label} of choice {number}": answer for label, answer in answers.told.items()})
    return told


class _Module:
    """The functions of a module, asked with the inputs of one choice of parameters."""

    def __init__(self, module: ModuleType, schedule: Schedule, each: Inputs) -> None:
        self.told: Transcript = {}
        self._module, self._each = module, each
        self._columns = [(k, joint.name) for k, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]

    def ordinary(self) -> None:
        """What the functions are for."""
        module, each, q, T = self._module, self._each, self._each.q, self._each.T
        many = np.concatenate([q, each.turned])
        self._put("fk", module.fk, many, **each.parameters)
        self._put("jacobian", module.jacobian, many, **each.parameters)
        zeros = np.where(each.judge.kinematics.free, 0.0, q)
        self._put("near solutions", self._batch, q, reference=q)
        self._put("plain solutions", self._batch, zeros)
        self._put("solve marks", self._marks)
        self._rows("ik", self._ik, each.ordinary)
        for k, limits in enumerate((None, *each.limits)):
            self._rows(f"within {k}", self._within, each.ordinary, limits)
            for j, weights in enumerate((None, *each.weights)):
                self._rows(f"nearest {k} {j}", self._nearest, each.ordinary, limits, weights)
        self._put("one and many", module.ik_batch, T[:4].reshape(2, 2, 4, 4), **self._given(q[:4].reshape(2, 2, -1)))

    def odd(self) -> None:
        """What they must refuse."""
        module, each, q, T = self._module, self._each, self._each.q[0], self._each.T[0]
        given = self._given(q)
        calls = (module.ik, module.ik_batch, module.solve, module.within)
        for name, pose in {**each.odd, "a row": T[0], "words": np.array([["x"] * 4] * 4)}.items():
            for call in calls:
                self._put(f"{call.__name__} of {name}", call, pose, **given)
            self._put(f"nearest of {name}", module.nearest, pose, q, **given)
        for k, broken in enumerate(broken_parameters(each.parameters)):
            for call in (module.fk, module.jacobian):
                self._put(f"{call.__name__} with parameters {k}", call, q, **broken)
            for call in calls:
                self._put(f"{call.__name__} with parameters {k}", call, T, **{**given, **broken})
        for k, broken in enumerate(broken_vectors(q)):
            for call in calls:
                self._put(f"{call.__name__} near {k}", call, T, reference=broken, **given)
            self._put(f"nearest near {k}", module.nearest, T, broken, **given)
        for k, broken in enumerate(broken_vectors(each.limits[0])):
            self._put(f"within limits {k}", module.within, T, limits=broken, **given)
            self._put(f"nearest limits {k}", module.nearest, T, q, limits=broken, **given)
        for k, broken in enumerate(broken_vectors(each.weights[0])):
            self._put(f"nearest weights {k}", module.nearest, T, q, weights=broken, **given)

    def _given(self, q: Floats) -> dict[str, Any]:
        return {**self._each.parameters, **{name: q[..., column] for column, name in self._columns}}

    def _put(self, label: str, call: Callable[..., Any], *arguments: Any, **given: Any) -> None:
        try:
            self.told[label] = _flat(call(*arguments, **given))
        except Exception as error:
            self.told[label] = type(error).__name__

    def _rows(self, label: str, call: Callable[..., Any], rows: Any, *more: Any) -> None:
        """Answers for single poses one after the other, each with its length in front."""
        try:
            parts = [np.ravel(_flat(call(row, *more))) for row in rows]
        except Exception as error:
            self.told[label] = type(error).__name__
            return
        self.told[label] = np.concatenate([part for each in parts for part in ([float(len(each))], each)])

    def _batch(self, q: Floats, **more: Any) -> Any:
        return self._module.ik_batch(self._each.T, **more, **self._given(q))[0]

    def _marks(self) -> np.ndarray:
        """Branches, marks and status of some poses, zeros for the others; the joint vectors are those of ik_batch."""
        each = self._each
        width = self._module.MAX_SOLUTIONS * (1 + 3 * each.q.shape[1]) + 16
        told = np.zeros((len(each.T), width))
        for row in each.single:
            found = self._module.solve(each.T[row], reference=each.q[row], **self._given(each.q[row]))
            flat = _flat(tuple(found)[1:])
            told[row, : len(flat)] = flat
        return told

    def _ik(self, row: int) -> Any:
        return self._module.ik(self._each.T[row], **self._given(self._each.q[row]))

    def _within(self, row: int, limits: Any) -> Any:
        q = self._each.q[row]
        return self._module.within(self._each.T[row], limits=limits, reference=q, **self._given(q))

    def _nearest(self, row: int, limits: Any, weights: Any) -> Any:
        near, given = 3 * self._each.q[row - 1], self._given(self._each.q[row])
        return self._module.nearest(self._each.T[row], near, weights=weights, limits=limits, **given)


def _flat(answer: Any) -> np.ndarray:
    """Numbers in one array: those of a tuple one after the other, a word by its letters, None as NaN."""
    if isinstance(answer, tuple):
        return np.concatenate([np.ravel(_flat(part)).astype(float) for part in answer])
    if isinstance(answer, str):
        return np.frombuffer(answer.encode().ljust(16), dtype=np.uint8)
    return np.array([np.nan]) if answer is None else np.asarray(answer)


def of_c(library: ctypes.CDLL, schedule: Schedule, inputs: Sequence[Inputs]) -> Transcript:
    """What a compiled source says."""
    told: Transcript = {}
    code = _Code(library, schedule)
    n, most = code.n, code.most
    names = (ctypes.c_char_p * most).in_dll(library, f"{schedule.name}_branches") if schedule.branches else ()
    told["branches"] = repr([bytes(name or b"") for name in names])
    for name in ("lower", "upper"):
        told[name] = np.array((ctypes.c_double * n).in_dll(library, f"{schedule.name}_{name}"))
    told["family"] = np.array([library[f"{schedule.name}_family"](bits) for bits in range(2 ** min(n, 8))])
    told["defaults"] = np.concatenate(
        [code.fk(inputs[0].q[0], None), code.marked(inputs[0].T[0], None, None)[0].ravel()]
    )
    for number, each in enumerate(inputs):
        base, q, T = each.parameters, each.q, each.T

        def put(label: str, answer: Any, number: int = number) -> None:
            told[f"{label} of choice {number}"] = answer

        many = np.concatenate([q, each.turned])
        put("fk", np.array([code.fk(x, base) for x in many]))
        put("jacobian", np.array([code.jacobian(x, base) for x in many]))
        put("fk_batch", code.fk_batch(many, base))
        put("fk_batch of nothing", code.fk_batch(many[:3], None))
        for name, reference in (("near", q), ("plain", [None] * len(q))):
            answers = [code.marked(T[k], q[k], reference[k], base) for k in range(len(T))]
            put(f"{name} solutions", np.array([answer[0] for answer in answers]))
            put(f"{name} counts and marks", np.array([[answer[1], *answer[2].ravel()] for answer in answers]))
        for name in ("ik", "ik_near"):
            put(f"{name} solutions", np.array([code.plain(name, T[k], q[k], base) for k in range(len(T))]))
        for name, reference in (("batch", q[0]), ("batch, no reference", None)):
            batch, counts, reached = code.batch(T, q, reference, base)
            put(f"{name} solutions", batch)
            put(f"{name} counts and marks", counts)
            put(f"{name} reached", _ints([reached == (counts > 0).sum()]))
        put("solve marks", _ints(code.solve(T[k], q[k], q[k], base) for k in range(len(T))))
        put("solve of odd", _ints(code.solve(pose, q[0], q[0], base) for pose in each.odd.values()))
        put("refused", _ints(code.marked(pose, q[0], q[0], base)[1] for pose in each.odd.values()))
        put("batch refused", code.batch(np.array(list(each.odd.values())), q[: len(each.odd)], None, base)[1])
        for k, limits in enumerate((None, *each.limits)):
            for capacity in (0, 3, 64):
                answers = [code.within(T[row], q[row], limits, capacity, base) for row in each.ordinary]
                put(f"within {k} {capacity}, number", np.array([answer[0] for answer in answers]))
                put(f"within {k} {capacity}", np.array([answer[1] for answer in answers]))
                put(f"within {k} {capacity}, marks", np.array([answer[2] for answer in answers]))
            for j, weights in enumerate((None, *each.weights)):
                answers = [code.nearest(T[row], q[row], 3 * q[row - 1], weights, limits, base) for row in each.ordinary]
                put(f"nearest {k} {j}", np.array([answer[0] for answer in answers]))
                put(f"nearest {k} {j}, status", _ints(answer[1] for answer in answers))
        for k, broken in enumerate(broken_parameters(base)):
            answer = code.batch(T[:3], q[:3], None, broken)
            status = [code.marked(T[0], q[0], None, broken)[1], code.solve(T[0], q[0], None, broken), answer[2]]
            put(f"parameters {k}", _ints([*status, code.nearest(T[0], q[0], q[0], None, None, broken)[1]]))
            put(f"fk with parameters {k}", np.concatenate([code.fk(q[0], broken), code.fk_batch(q[:1], broken)[0]]))
        cases = [
            *((None, None, broken) for broken in broken_vectors(q[0])),
            *((None, limits, q[0]) for limits in broken_vectors(each.limits[0])),
            *((weights, None, q[0]) for weights in broken_vectors(each.weights[0])),
        ]
        put("bad", _ints(code.nearest(T[0], q[0], near, weights, limits, base)[1] for weights, limits, near in cases))
        put("bad within", _ints(code.within(T[0], near, limits, 4, base)[0] for _, limits, near in cases))
        put("bad solve", _ints(code.solve(T[0], q[0], near, base) for *_, near in cases[:3]))
    return told


def _ints(values: Any) -> np.ndarray:
    return np.array(list(values), dtype=np.int64)


def _at(array: Any) -> Any:
    return None if array is None else array.ctypes.data


class _Code:
    """The functions of a compiled source, by arrays."""

    def __init__(self, library: ctypes.CDLL, schedule: Schedule) -> None:
        self._library, self._schedule = library, schedule
        self.n, self.most = len(schedule.joints), schedule.maximum
        self._columns = [k for k, joint in enumerate(schedule.joints) if joint.name in schedule.inputs]

    def _call(self, name: str, *arguments: Any) -> int:
        function = self._library[f"{self._schedule.name}_{name}"]
        function.restype = ctypes.c_int
        # what an array stands for lives as long as the call
        return int(function(*(ctypes.c_void_p(_at(each)) if not isinstance(each, int) else each for each in arguments)))

    def _given(self, parameters: dict[str, float] | None, q: Floats | None = None) -> Floats | None:
        if parameters is None:
            return None
        inputs = [np.nan if q is None else q[column] for column in self._columns]
        return np.array([*parameters.values(), *inputs, 0.0])

    def fk(self, q: Floats, parameters: dict[str, float] | None) -> Floats:
        T = np.full(16, 7.0)
        self._call("fk", q, self._given(parameters), T)
        return T

    def jacobian(self, q: Floats, parameters: dict[str, float] | None) -> Floats:
        J = np.full(6 * self.n, 7.0)
        self._call("jacobian", q, self._given(parameters), J)
        return J

    def fk_batch(self, q: Floats, parameters: dict[str, float] | None) -> Floats:
        q, T = np.ascontiguousarray(q), np.full((len(q), 16), 7.0)
        self._call("fk_batch", q, len(q), self._given(parameters), T)
        return T

    def marked(self, T: Floats, q: Floats | None, reference: Floats | None, parameters: Any = None) -> Any:
        found, marks = np.full((self.most, self.n), np.nan), np.zeros((self.most, 3), dtype=np.uint32)
        count = self._call("ik_marked", np.ascontiguousarray(T), self._given(parameters, q), reference, found, marks)
        found[max(0, count) :], marks[max(0, count) :] = np.nan, 0
        return found, count, marks

    def plain(self, name: str, T: Floats, q: Floats, parameters: dict[str, float]) -> Floats:
        found = np.full((self.most, self.n), np.nan)
        reference = [q] if name == "ik_near" else []
        count = self._call(name, np.ascontiguousarray(T), self._given(parameters, q), *reference, found)
        found[max(0, count) :] = np.nan
        return found

    def batch(self, T: Floats, q: Floats, reference: Floats | None, parameters: dict[str, float]) -> Any:
        T, counts = np.ascontiguousarray(T), np.full(len(T), -9, dtype=np.intc)
        found = np.full((len(T), self.most, self.n), np.nan)
        values = [np.ascontiguousarray(q[:, column]) for column in self._columns]
        reached = self._call("ik_batch", T, len(T), self._given(parameters, q[0]), reference, *values, found, counts)
        found[np.arange(self.most) >= counts[:, None]] = np.nan
        return found, counts, reached

    def solve(self, T: Floats, q: Floats, reference: Floats | None, parameters: dict[str, float]) -> int:
        out = np.zeros(1 + self.most * (self.n + 2))
        return self._call("solve", np.ascontiguousarray(T), self._given(parameters, q), reference, out)

    def within(self, T: Floats, q: Floats, limits: Any, capacity: int, parameters: dict[str, float]) -> Any:
        low, high = (None, None) if limits is None else map(np.ascontiguousarray, np.asarray(limits).T)
        found, marks = np.zeros((capacity + 1, self.n)), np.zeros((capacity + 1, 3), dtype=np.uint32)
        T = np.ascontiguousarray(T)
        number = self._call("within", T, self._given(parameters, q), q, low, high, capacity, found, marks)
        return number, found, marks

    def nearest(self, T: Floats, q: Floats, reference: Any, *more: Any) -> Any:
        weights, limits, parameters = more
        low, high = (None, None) if limits is None else map(np.ascontiguousarray, np.asarray(limits).T)
        found, T = np.full(self.n, 7.0), np.ascontiguousarray(T)
        status = self._call("nearest", T, self._given(parameters, q), reference, weights, low, high, found)
        return found, status
