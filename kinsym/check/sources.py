"""Generated sources made ready to run: the module imported, C and package compiled, all in a private folder."""

from __future__ import annotations

import ctypes
import platform
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import FLAGS, compile_shared, compiler_version, find_compiler
from kinsym.check.cpp import IKFAST, CppSolver, IkfastSolver, build_header, build_ikfast, find_cpp_compiler
from kinsym.check.extension import build, headers, load_package
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import ExtensionSolver, NumpySolver
from kinsym.check.single import SingleSolver
from kinsym.check.solvers import Solver
from kinsym.emit.schedule import Schedule
from kinsym.errors import CheckFailed

IMPORT = "the module can be imported"
COMPILE = "compiles without a warning"
BUILD = "the package can be built"
NUMPY, C, EXTENSION = NumpySolver.name, CSolver.name, ExtensionSolver.name


@dataclass(frozen=True, kw_only=True)
class Sources:
    """What of the generated sources can be run here."""

    schedule: Schedule
    module: ModuleType | None
    library: ctypes.CDLL | None
    package: ModuleType | None
    header: ctypes.CDLL | None
    ikfast: IkfastSolver | None
    versions: dict[str, Any]

    def solvers(self, parameters: Mapping[str, Fraction]) -> list[Solver]:
        """One solver for each language at hand, for one choice of parameters."""
        found: list[Solver] = []
        if self.module is not None:
            found.append(NumpySolver(self.module, self.schedule, parameters))
        if self.library is not None:
            solver = SingleSolver if self.schedule.real.single else CSolver
            found.append(solver(self.library, self.schedule, parameters))
        if self.package is not None:
            found.append(ExtensionSolver(self.package, self.schedule, parameters))
        if self.header is not None:
            found.append(CppSolver(self.header, self.schedule, parameters))
        return found


def load(
    schedule: Schedule, sources: Mapping[str, str], folder: Path, ledger: Ledger, progress: Callable[[str], None]
) -> Sources:
    """Write the sources (file name -> text) into ``folder``, import and compile them.

    What fails is recorded in the ledger as a failed law; a missing compiler as a law that was not run.
    """
    for name, text in sources.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    versions: dict[str, Any] = {"python": platform.python_version(), "numpy": np.__version__}
    module, library, package, header, ikfast = None, None, None, None, None
    if f"{schedule.name}.py" in sources:
        module = _imported(schedule, folder / f"{schedule.name}.py", NumpySolver.load, NUMPY, ledger)
    if f"{schedule.name}.c" in sources:
        progress("compiling the C")
        library = _compiled(schedule, folder / f"{schedule.name}.c", ledger, versions)
    if f"{schedule.name}-solver/c/_core.c" in sources:
        progress("building the package")
        place = _built(schedule, folder / f"{schedule.name}-solver", ledger, versions)
        if place is not None:
            package = _imported(schedule, place, load_package, EXTENSION, ledger)
    if f"{schedule.name}.hpp" in sources:
        progress("compiling the C++")
        header = _compiled_cpp(CppSolver.name, partial(build_header, schedule, folder), ledger, versions)
    if f"{schedule.name}_ikfast.cpp" in sources:
        progress("compiling the ikfast solver")
        solver = _compiled_cpp(IKFAST, partial(build_ikfast, schedule, folder), ledger, versions)
        ikfast = None if solver is None else IkfastSolver(solver, schedule)
    return Sources(
        schedule=schedule,
        module=module,
        library=library,
        package=package,
        header=header,
        ikfast=ikfast,
        versions=versions,
    )


def _compiled_cpp(
    subject: str, build_with: Callable[[str], ctypes.CDLL], ledger: Ledger, versions: dict[str, Any]
) -> ctypes.CDLL | None:
    compiler = find_cpp_compiler()
    if compiler is None:
        ledger.skip(COMPILE, subject, "no C++ compiler was found, so the C++ is written but not compiled")
        return None
    try:
        versions["c++ compiler"] = compiler_version(compiler)
        library = build_with(compiler)
    except (CheckFailed, OSError) as error:
        ledger.fail(COMPILE, subject, str(error))
        return None
    ledger.count(COMPILE, subject, 1, 0)
    return library


def _built(schedule: Schedule, folder: Path, ledger: Ledger, versions: dict[str, Any]) -> Path | None:
    compiler, include = find_compiler(), headers()
    if compiler is None or include is None:
        missing = "C compiler" if compiler is None else "Python.h"
        ledger.skip(BUILD, EXTENSION, f"no {missing} was found, so the package is written but not built")
        return None
    try:
        versions["compiler"] = compiler_version(compiler)
        place = build(folder, schedule.name, compiler, include)
    except (CheckFailed, OSError) as error:
        ledger.fail(BUILD, EXTENSION, str(error))
        return None
    ledger.count(BUILD, EXTENSION, 1, 0)
    return place


def _imported(
    schedule: Schedule, path: Path, load_from: Callable[[Path], ModuleType], subject: str, ledger: Ledger
) -> ModuleType | None:
    try:
        module = load_from(path)
    except Exception as error:  # the file may hold anything by now
        ledger.fail(IMPORT, subject, f"{type(error).__name__}: {error}")
        return None
    return module if hold_module(module, schedule, subject, ledger) else None


def hold_module(module: ModuleType, schedule: Schedule, subject: str, ledger: Ledger) -> bool:
    """Whether a module has the functions and the constants that it must have."""
    wanted = ("fk", "ik", "ik_batch", "jacobian", "solve", "within", "nearest")
    missing = [name for name in wanted if not callable(getattr(module, name, None))]
    if missing:
        ledger.fail(IMPORT, subject, f"it has no {', '.join(missing)}")
        return False
    expected = {
        "NAME": schedule.name,
        "JOINTS": [joint.name for joint in schedule.joints],
        "JOINT_TYPES": [joint.kind for joint in schedule.joints],
        "PARAMETERS": [parameter.name for parameter in schedule.parameters],
        "MAX_SOLUTIONS": schedule.maximum,
    }
    for name, value in expected.items():
        given = getattr(module, name, None)
        if (list(given or ()) if isinstance(value, list) else given) != value:
            ledger.fail(IMPORT, subject, f"its {name} is {given!r}, the table's is {value!r}")
            return False
    ledger.count(IMPORT, subject, 1, 0)
    return True


def _compiled(schedule: Schedule, path: Path, ledger: Ledger, versions: dict[str, Any]) -> ctypes.CDLL | None:
    compiler = find_compiler()
    if compiler is None:
        ledger.skip(COMPILE, C, "no C compiler was found, so the C is written but not compiled")
        return None
    try:
        versions["compiler"] = compiler_version(compiler)
        versions["flags"] = " ".join(FLAGS)
        library = ctypes.CDLL(str(compile_shared(path.parent, schedule.name, path.parent, compiler=compiler)))
        for function in (
            "fk",
            "fk_batch",
            "ik",
            "ik_near",
            "ik_batch",
            "jacobian",
            "solve",
            "within",
            "nearest",
            "family",
        ):
            getattr(library, f"{schedule.name}_{function}")
    except (CheckFailed, OSError, AttributeError) as error:
        ledger.fail(COMPILE, C, str(error))
        return None
    ledger.count(COMPILE, C, 1, 0)
    return library
