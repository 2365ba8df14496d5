"""The generated Python package built without setuptools: its two C files compiled, its Python imported.

It is imported under a private name, so that it meets no package of the same name, and leaves none behind.
"""

from __future__ import annotations

import importlib.util
import sys
import sysconfig
from pathlib import Path
from types import ModuleType

from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.errors import CheckFailed

#: A slot of a module is a function kept as a pointer to data, which ISO C does not know but every platform does.
_FLAGS = tuple(flag for flag in FLAGS if flag != "-Wpedantic")


def headers() -> Path | None:
    """The folder of Python.h; None where Python came without it."""
    folder = Path(sysconfig.get_path("include"))
    return folder if (folder / "Python.h").is_file() else None


def build(folder: Path, name: str, compiler: str, include: Path, flags: tuple[str, ...] = _FLAGS) -> Path:
    """Compile the package in ``folder`` (``NAME-solver``) and return the folder that can be imported.

    Raises CheckFailed if that fails.
    """
    package = folder / "src" / name
    # Other programs' headers are not held to our warnings.
    more = ["-isystem", str(include)]
    if not sysconfig.get_config_var("Py_GIL_DISABLED"):
        more.append("-DPy_LIMITED_API=0x030B0000")
    if sys.platform == "darwin":
        more += ["-undefined", "dynamic_lookup"]
    compile_shared(folder / "c", "_core", package, compiler=compiler, flags=(*flags, *more), more=(f"{name}.c",))
    return package


def load_package(package: Path) -> ModuleType:
    """Import a built package."""
    name = f"_kinsym_checked_{package.name}"
    spec = importlib.util.spec_from_file_location(
        name, package / "__init__.py", submodule_search_locations=[str(package)]
    )
    if spec is None or spec.loader is None:
        raise CheckFailed(f"{package.name} is no Python package")
    module = importlib.util.module_from_spec(spec)
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = before
        for loaded in [key for key in sys.modules if key == name or key.startswith(f"{name}.")]:
            del sys.modules[loaded]
    return module
