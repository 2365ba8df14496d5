"""The package around the C, built and loaded in this process.

What :mod:`kinsym.check.extension` builds to be checked is built here to be used: with the flags of the package's own
``setup.py`` instead of those that make every warning an error.
"""

from __future__ import annotations

import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.check.compiler import find_compiler
from kinsym.check.extension import build, headers, load_package
from kinsym.emit.source.extension import extension_source
from kinsym.errors import KinsymError
from kinsym.write import write_set

if TYPE_CHECKING:
    from types import ModuleType

    from kinsym.emit.schedule import Schedule

FLAGS = ("-std=c99", "-O3", "-fno-math-errno", "-fno-trapping-math")
"""Those of ``templates/extension/setup.py.jinja``, and the language, which setuptools leaves to the compiler."""


def compiled_module(schedule: Schedule) -> ModuleType:
    """The compiled functions of a schedule; the folder they are built in is removed once they are loaded.

    Raises :class:`KinsymError` where the machine has no C compiler or Python came without its headers, and
    :class:`kinsym.errors.CheckFailed` with the compiler's own words if the C does not compile.
    """
    compiler, include = find_compiler(), headers()
    if compiler is None:
        raise KinsymError(
            f"{schedule.name} cannot be compiled: no C compiler was found. Install gcc or clang, or name one in the "
            "variable CC; derive(robot).numpy() needs none."
        )
    if include is None:
        raise KinsymError(
            f"{schedule.name} cannot be compiled: Python.h is not in {sysconfig.get_path('include')}. Install the "
            f"headers of Python {sys.version_info.major}.{sys.version_info.minor} (python3-dev); "
            "derive(robot).numpy() needs none."
        )
    with tempfile.TemporaryDirectory(prefix="kinsym-", ignore_cleanup_errors=True) as folder:
        write_set(Path(folder), extension_source(schedule))
        place = Path(folder, f"{schedule.name}-solver")
        return load_package(build(place, schedule.name, compiler, include, FLAGS))
