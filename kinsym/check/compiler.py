"""The C compiler of the machine, if it has one.

The generated C is compiled the way a careful user would: C99, optimised, every warning an error.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from kinsym.errors import CheckFailed

#: What generated C must compile with.
FLAGS = (
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wshadow",
    "-Werror",
)
_SECONDS = 120
_LINES = 20


def find_compiler() -> str | None:
    """The path of a C compiler: ``$CC`` if it names a program, else cc, gcc or clang; None if there is none."""
    try:
        named = shlex.split(os.environ.get("CC", ""))
    except ValueError:  # a quotation mark without its partner
        named = []
    for candidate in [*named[:1], "cc", "gcc", "clang"]:
        path = shutil.which(candidate)
        if path:
            return path
    return None


def compiler_version(compiler: str) -> str:
    """The first line that a compiler says about itself, empty if it says nothing."""
    finished = _run([compiler, "--version"], Path.cwd())
    return finished.stdout.splitlines()[0].strip() if finished.stdout.strip() else ""


def compile_shared(
    source_dir: Path | str,
    name: str,
    out_dir: Path | str,
    *,
    compiler: str | None = None,
    flags: tuple[str, ...] = FLAGS,
    more: tuple[str, ...] = (),
    suffix: str = ".c",
) -> Path:
    """Compile ``NAME.c`` of a folder, and ``more`` sources there, to a shared library in another and return its path.

    Raises CheckFailed, with the first lines of the compiler, if the source does not compile or there is no compiler.
    """
    compiler = compiler or find_compiler()
    if compiler is None:
        raise CheckFailed("no C compiler was found. Install gcc or clang, or name one in the variable CC")
    source_dir, library = Path(source_dir), Path(out_dir).resolve() / f"{name}.so"
    command = [compiler, *flags, "-fPIC", "-shared", f"{name}{suffix}", *more, "-o", str(library), "-lm"]
    # What the compiler leaves when it is ended goes with the folder.
    finished = _run(command, source_dir, {"TMPDIR": str(library.parent)})
    if finished.returncode != 0:
        said = "\n".join((finished.stderr or finished.stdout).splitlines()[:_LINES])
        raise CheckFailed(f"{name}{suffix} does not compile with {Path(compiler).name}:\n{said}")
    return library


def _run(
    command: list[str], folder: Path, environment: Mapping[str, str] = MappingProxyType({})
) -> subprocess.CompletedProcess[str]:
    """Run a compiler to its end, or end it together with all that it has started: it is a group of its own."""
    try:
        with subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, **environment},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            start_new_session=True,
        ) as process:
            try:
                out, err = process.communicate(timeout=_SECONDS)
            except BaseException:  # Ctrl-C above all
                _end(process)
                raise
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CheckFailed(f"the compiler {Path(command[0]).name} could not be run: {error}") from error
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def _end(process: subprocess.Popen[str]) -> None:
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except (AttributeError, ProcessLookupError):  # no groups on this platform, or it ended by itself
        process.kill()
