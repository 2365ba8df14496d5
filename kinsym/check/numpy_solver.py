"""The generated NumPy module, and the compiled package that has its interface."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.solvers import Floats, Solutions, as_float, inputs_of
from kinsym.emit.schedule import Schedule


class NumpySolver:
    """A generated NumPy module, imported from its file under a private name."""

    name = "NumPy"

    def __init__(self, module: ModuleType, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.module = module
        self._inputs = inputs_of(schedule)
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
