"""kinsym's own Python: the package and the module as they were generated, found on the path that is given."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.benchmarks.speed.arms import Floats


def load(folder: Path, name: str) -> Any:
    """Import ``name`` from a folder; one folder and another may hold a module of the same name."""
    sys.path.insert(0, str(folder))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(folder))
        for loaded in [key for key in sys.modules if key == name or key.startswith(f"{name}.")]:
            del sys.modules[loaded]


def solve(module: Any) -> tuple[Callable[[Floats], Any], Callable[[Any], Floats]]:
    """The call for one pose; its answer is an array already."""
    return module.ik, lambda answer: answer


def batch(module: Any) -> tuple[Callable[[Floats], Any], Callable[[Any], list[Floats]]]:
    """The call for many poses."""
    return module.ik_batch, lambda answer: [q[valid] for q, valid in zip(*answer, strict=True)]
