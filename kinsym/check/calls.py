"""What a controller can call, with one face for both languages: solutions with their marks, windings, the nearest.

A call that is refused returns the word for what was wrong: "not a pose", "parameter", "reference", "limit", "weight".
"""

from __future__ import annotations

import ctypes
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple, Protocol

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Floats

NOT_A_POSE = "not a pose"
PARAMETER, REFERENCE, LIMIT, WEIGHT = "parameter", "reference", "limit", "weight"
_REFUSALS = {-1: NOT_A_POSE, -2: PARAMETER, -3: REFERENCE, -4: LIMIT, -5: WEIGHT}
_WORDS = {"rigid motion": NOT_A_POSE, "reference": REFERENCE, "limits": LIMIT, "weight": WEIGHT}
_STATUS = {0: "unreachable", 1: "solved", 2: "singular"}

#: More windings than the limits of the checks leave.
_ROOM = 4096


class Marked(NamedTuple):
    """Solutions (m, n), their branches (m,), masks (m, n) of free joints, of border joints and of families.

    The status is None where the language does not tell it.
    """

    q: Floats
    branch: Any
    free: Any
    border: Any
    family: Any
    status: str | None


class Nearest(NamedTuple):
    """The joint vector (n,) nearest to a reference; the status of that solution where the language tells it."""

    q: Floats
    status: str | None


class Calls(Protocol):
    """The calls; ``None`` stands for what a caller leaves out, parameters are those of the solver if None."""

    def solve(self, pose: Floats, reference: Floats | None, parameters: Mapping[str, float] | None = None) -> Any:
        """Marked solutions of one pose (4, 4), or why it is refused."""

    def within(self, pose: Floats, reference: Floats | None, limits: Floats | None) -> Any:
        """The marked joint vectors (w, n) inside limits (n, 2), or why the call is refused."""

    def nearest(self, pose: Floats, reference: Floats | None, weights: Floats | None, limits: Floats | None) -> Any:
        """The nearest of the joint vectors, None if there is none, or why the call is refused."""

    def refusing(self, pose: Floats, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        """Which functions of one pose refuse parameters that no solver is for; also those for many poses.

        Among the parameters may be the value of a locked joint."""

    def refusing_forward(self, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        """Which functions of one joint vector (n,) refuse parameters that are no numbers, if the language does so."""

    def spared(self, pose: Floats, q: Floats, values: Mapping[str, float]) -> dict[str, bool]:
        """Which functions say the same of a pose, or of q (n,), with these values and where they are left out."""

    def tables(self) -> dict[str, Any]:
        """Names of branches, limits and the values of parameters, where the language holds them."""


def calls_of(target: NumpySolver | CSolver) -> Calls:
    """The calls of a language."""
    return CCalls(target) if isinstance(target, CSolver) else _NumpyCalls(target)


class _NumpyCalls:
    def __init__(self, target: NumpySolver) -> None:
        self._target, self._module = target, target.module

    def solve(self, pose: Floats, reference: Floats | None, parameters: Mapping[str, float] | None = None) -> Any:
        given = {**self._given(reference), **(parameters or {})}
        try:
            found = self._module.solve(pose, reference=reference, **given)
        except ValueError as error:
            return _word(error)
        return NOT_A_POSE if found.status == NOT_A_POSE else Marked(*found)

    def within(self, pose: Floats, reference: Floats | None, limits: Floats | None) -> Any:
        try:
            found = self._module.within(pose, reference=reference, limits=limits, **self._given(reference))
        except ValueError as error:
            return _word(error)
        return NOT_A_POSE if found.status == NOT_A_POSE else Marked(*found)

    def nearest(self, pose: Floats, reference: Floats | None, weights: Floats | None, limits: Floats | None) -> Any:
        try:
            q = self._module.nearest(pose, reference, weights=weights, limits=limits, **self._given(reference))
        except ValueError as error:
            return _word(error)
        return None if q is None else Nearest(np.asarray(q, dtype=np.float64), None)

    def refusing(self, pose: Floats, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        given = {**self._target.given(q), **parameters}
        module = self._module
        every = {"ik": module.ik, "ik_batch": module.ik_batch, "solve": module.solve, "within": module.within}
        told = {name: self._refuses(parameters, call, pose, **given) for name, call in every.items()}
        return {**told, "nearest": self._refuses(parameters, module.nearest, pose, q, **given)}

    def refusing_forward(self, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        given = {**self._target.parameters, **parameters}
        every = {"fk": self._module.fk, "jacobian": self._module.jacobian}
        return {name: self._refuses(parameters, call, q, **given) for name, call in every.items()}

    def spared(self, pose: Floats, q: Floats, values: Mapping[str, float]) -> dict[str, bool]:
        module = self._module
        calls: dict[str, Callable[..., Any]] = {name: getattr(module, name) for name in ("fk", "jacobian")}
        still = {name: value for name, value in self._target.parameters.items() if name not in values}
        told = {name: _alike(call(q, **still, **values), call(q, **still)) for name, call in calls.items()}
        given = {name: value for name, value in self._target.given(q).items() if name not in values}
        for name in ("ik", "ik_batch", "solve", "within", "nearest"):
            call = partial(getattr(module, name), pose, **({"reference": q} if name == "nearest" else {}), **given)
            told[name] = _alike(call(**values), call())
        return told

    def _refuses(self, wrong: Iterable[str], call: Callable[..., Any], *arguments: Any, **given: Any) -> bool:
        """Whether a call is refused, and for the parameters that are wrong."""
        try:
            call(*arguments, **given)
        except ValueError as error:
            named = all(re.search(rf"\b{name}\b", str(error)) for name in wrong)
            return _word(error) == PARAMETER and named
        return False

    def tables(self) -> dict[str, Any]:
        module = self._module
        branches = tuple(getattr(module, "BRANCHES", ()))
        return {"branches": branches, "limits": np.array(module.LIMITS), "parameters": dict(module.PARAMETERS)}

    def _given(self, reference: Floats | None) -> dict[str, Any]:
        return dict(self._target.parameters) if reference is None else self._target.given(np.asarray(reference))


def _alike(left: Any, right: Any) -> bool:
    """Whether two answers are the same to the bit, part by part."""
    if isinstance(left, tuple):
        return len(left) == len(right) and all(map(_alike, left, right))
    if left is None or isinstance(left, str):
        return bool(left == right)
    return right is not None and np.array_equal(left, right, equal_nan=True)


def _word(error: ValueError) -> str:
    return next((word for text, word in _WORDS.items() if text in str(error)), PARAMETER)


class CCalls:
    """The calls of a compiled source; also any of its functions by its name."""

    def __init__(self, target: CSolver) -> None:
        self._target, self._name = target, target.schedule.name
        self._n, self._most = len(target.schedule.joints), target.schedule.maximum
        self._real = target.real

    def solve(self, pose: Floats, reference: Floats | None, parameters: Mapping[str, float] | None = None) -> Any:
        if reference is not None:
            self._target.give(reference)
        given = self.given_with(parameters or {})
        q, marks = self._room(self._most), np.zeros((self._most, 3), dtype=np.uint32)
        # two ints, then the numbers of every solution, then the three numbers of every mark
        out = np.zeros(8 + q.nbytes + marks.nbytes + 8, dtype=np.uint8)
        status = self.call("solve", pose, given, reference, out)
        if status < 0:
            return _REFUSALS.get(status, str(status))
        count = int(out[4:8].view(np.int32)[0])
        found = out[8 : 8 + q.nbytes].view(self._real).reshape(q.shape)[:count].astype(np.float64)
        marks = out[8 + q.nbytes : 8 + q.nbytes + marks.nbytes].view(np.uint32).reshape(marks.shape)[:count]
        return self._marked(found, marks, _STATUS.get(status, str(status)))

    def within(self, pose: Floats, reference: Floats | None, limits: Floats | None) -> Any:
        if reference is not None:
            self._target.give(reference)
        low, high = _ends(limits)
        q, marks = self._room(_ROOM), np.zeros((_ROOM, 3), dtype=np.uint32)
        arguments = (pose, self._target.given, reference, low, high)
        count = self.call("within", *arguments, _ROOM, q, marks)
        if count < 0:
            return _REFUSALS.get(count, str(count))
        # with less room the same number is told, and what fits is written
        few, same = self._room(_ROOM), np.zeros_like(marks)
        told, room = self.call("within", *arguments, count // 2, few, same), count // 2
        fits = told == count and np.array_equal(few[:room], q[:room]) and bool(np.isnan(few[room:]).all())
        fits = fits and np.array_equal(same[:room], marks[:room]) and not same[room:].any()
        found = q[:count].astype(np.float64)
        return self._marked(found, marks[:count], None) if fits else "another answer with less room"

    def nearest(self, pose: Floats, reference: Floats | None, weights: Floats | None, limits: Floats | None) -> Any:
        if reference is not None:
            self._target.give(reference)
        q = self._room(1)[0]
        arguments = (pose, self._target.given, reference, weights, *_ends(limits))
        status = self.call("nearest", *arguments, q)
        if status <= 0:
            return _REFUSALS.get(status, str(status)) if status else None
        return Nearest(q.astype(np.float64), _STATUS.get(status, str(status)))

    def refusing(self, pose: Floats, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        self._target.give(q)
        given, found, counts = self.given_with(parameters), self._room(self._most), np.zeros(1, dtype=np.intc)
        values = [None] * len(self._target.schedule.inputs)
        told = {
            "ik": self.call("ik", pose, given, found),
            "ik_batch": self.call("ik_batch", pose, 1, given, None, *values, found, counts),
            "within": self.call("within", pose, given, q, None, None, 0, None, None),
            "nearest": self.call("nearest", pose, given, q, None, None, None, found),
        }
        refused = {name: _REFUSALS.get(status) == PARAMETER for name, status in told.items()}
        return {**refused, "solve": self.solve(pose, q, parameters) == PARAMETER}

    def refusing_forward(self, q: Floats, parameters: Mapping[str, float]) -> dict[str, bool]:
        return {}

    def spared(self, pose: Floats, q: Floats, values: Mapping[str, float]) -> dict[str, bool]:
        schedule = self._target.schedule
        if schedule.inputs or len(values) < len(schedule.parameters):
            return {}
        every = (self.given_with(values), None)
        calls = {"ik_near": self._one, "ik_batch": self._many}
        return {name: _alike(*(call(pose, q, given) for given in every)) for name, call in calls.items()}

    def _one(self, pose: Floats, q: Floats, given: Any) -> tuple[Any, ...]:
        found = self._room(self._most)
        return self.call("ik_near", pose, given, q, found), found

    def _many(self, pose: Floats, q: Floats, given: Any) -> tuple[Any, ...]:
        found, counts = self._room(self._most), np.zeros(1, dtype=np.intc)
        return self.call("ik_batch", pose, 1, given, q, found, counts), found, counts

    def _marked(self, q: Floats, marks: Any, status: str | None) -> Marked:
        """Solutions (m, n) with the three numbers of each of their marks (m, 3)."""
        branch, free, border = marks.T
        family = np.array([self.call("family", int(bits)) for bits in free], dtype=np.uint32)
        free, border, family = (
            (bits[:, None] >> np.arange(self._n, dtype=np.uint32)) & 1 != 0 for bits in (free, border, family)
        )
        return Marked(q, branch.astype(np.intp), free, border, family, status)

    def given_with(self, parameters: Mapping[str, float]) -> Any:
        """The struct of parameters and locked inputs with some of them changed."""
        given = type(self._target.given)(*self._target.given)
        schedule = self._target.schedule
        for place, name in enumerate([*(parameter.name for parameter in schedule.parameters), *schedule.inputs]):
            given[place] = parameters.get(name, given[place])
        return given

    def tables(self) -> dict[str, Any]:
        library = self._target.library
        names: tuple[str, ...] = ()
        if self._target.schedule.branches:
            held = (ctypes.c_char_p * self._most).in_dll(library, f"{self._name}_branches")
            names = tuple((name or b"").decode() for name in held)
        row = np.ctypeslib.as_ctypes_type(self._real) * self._n
        ends = [np.array(row.in_dll(library, f"{self._name}_{end}"), dtype=np.float64) for end in _ENDS]
        return {"branches": names, "limits": np.stack(ends, axis=1)}

    def call(self, name: str, *arguments: Any) -> int:
        """What a function returns that is given by its name; arrays are handed over where they lie, None as NULL."""
        function = getattr(self._target.library, f"{self._name}_{name}")
        held = [self._handed(each) if isinstance(each, np.ndarray) else each for each in arguments]
        handed = [ctypes.c_void_p(each.ctypes.data) if isinstance(each, np.ndarray) else each for each in held]
        return int(function(*handed))

    def _handed(self, values: Any) -> Any:
        """An array where it lies, unless its numbers are of another type than those of the C."""
        with np.errstate(over="ignore"):
            return np.ascontiguousarray(values, dtype=self._real if values.dtype.kind == "f" else None)

    def _room(self, rows: int) -> Any:
        return np.full((rows, self._n), np.nan, dtype=self._real)


_ENDS = ("lower", "upper")


def _ends(limits: Floats | None) -> Sequence[Floats | None]:
    return (None, None) if limits is None else tuple(np.ascontiguousarray(end) for end in np.asarray(limits).T)
