"""The programs of this folder built for an arm and run; compilers that are asked whether they see anything wrong."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from pathlib import Path

from kinsym.check.compiler import FLAGS
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule

HERE = Path(__file__).resolve().parent
WARNINGS = tuple(flag for flag in FLAGS if flag.startswith("-W"))
#: Casts of what no int can hold are undefined too, but not part of gcc's "undefined".
SANITIZERS = ("-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")
STANDARDS = ("-std=c99", "-std=c11")
CPP = ("-x", "c++", "-std=c++17")
_SECONDS = 300
#: Only this library can turn floating-point traps on.
GLIBC = platform.libc_ver()[0] == "glibc"
#: Sections that hold what can be written: initialised, zeroed, common.
_WRITABLE = frozenset("dDbBC")


class Failed(AssertionError):
    """A program that did not end well, with what it said."""


def run(command: list[str], folder: Path, **environment: str) -> str:
    """What a command prints; raises :class:`Failed` where it does not end with zero in time."""
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            capture_output=True,
            text=True,
            errors="replace",
            env=os.environ | environment,
            check=False,
            timeout=_SECONDS,
        )
    except subprocess.TimeoutExpired as expired:
        raise Failed(f"{' '.join(command)}: no end after {_SECONDS} s") from expired
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)}: status {done.returncode}\n{(done.stderr or done.stdout)[-3000:]}")
    return done.stdout


def write(schedule: Schedule, folder: Path) -> None:
    """The C and the C++ of a schedule, and a source that includes the latter."""
    for target in ("c", "cpp"):
        for name, text in TARGETS[target](schedule).items():
            (folder / name).write_text(text, encoding="utf-8")
    (folder / "includes.cpp").write_text(f'#include "{schedule.name}.hpp"\n', encoding="utf-8")


def quiet(schedule: Schedule, folder: Path) -> int:
    """Every compiler at hand on the C as C99, C11 and C++17 and on the C++ header; how many runs there were."""
    runs = 0
    for compiler in filter(shutil.which, ("gcc", "clang")):
        for language, source in [
            *(((standard,), f"{schedule.name}.c") for standard in STANDARDS),
            (CPP, f"{schedule.name}.c"),
            (CPP, "includes.cpp"),
        ]:
            # gcc finds some faults, such as uninitialised values, while it optimises, in any language the same ones.
            optimised = compiler == "gcc" and language == STANDARDS[-1:]
            how = ("-O1", "-c", "-o", os.devnull) if optimised else ("-fsyntax-only",)
            run([compiler, *language, *WARNINGS, *how, source], folder)
            runs += 1
    return runs


def writable(schedule: Schedule, folder: Path) -> list[str]:
    """The symbols of the compiled C that can be written: state that threads would share."""
    run(["cc", "-std=c99", "-O1", "-fno-pic", "-c", f"{schedule.name}.c", "-o", "state.o"], folder)
    lines = (line.split() for line in run(["nm", "state.o"], folder).splitlines())
    return [name for *_, kind, name in lines if kind in _WRITABLE]


def program(source: str, schedule: Schedule, folder: Path, *flags: str, rounds: int = 1) -> str:
    """Build ``source`` of this folder with the C of an arm; the command that runs it."""
    names = [joint.name for joint in schedule.joints]
    values = [1.0 if item.value is None else float(item.value) for item in schedule.parameters]
    values = [*values, *[0.0] * len(schedule.inputs)] or [0.0]
    locked = [names.index(name) for name in schedule.inputs] or [0]
    macros = {
        "ARM": schedule.name,
        "HEADER": f'"{schedule.name}.h"',
        "JOINTS": len(names),
        "MAXIMUM": schedule.maximum,
        "FIELDS": len(schedule.parameters) + len(schedule.inputs),
        "INPUTS": len(schedule.inputs),
        "VALUES": f"{{{', '.join(map(repr, values))}}}",
        "LOCKED": f"{{{', '.join(map(str, locked))}}}",
        "ROUNDS_EACH": rounds,
    }
    macros |= {"REAL": schedule.real.name} if schedule.real.single else {}
    given = [f"-D{name}={value}" for name, value in macros.items()]
    output = f"./{Path(source).stem}"
    sources = [str(HERE / source), f"{schedule.name}.c"]
    run(["cc", "-std=c99", "-O1", "-g", *flags, *given, "-I.", *sources, "-o", output, "-lm", "-lpthread"], folder)
    return output


def hostile(schedule: Schedule, folder: Path, *, valgrind: bool = False) -> str:
    """The hostile calls under the sanitizers, or under valgrind; what they say when they end."""
    if valgrind:
        checker = ["valgrind", "--quiet", "--error-exitcode=9", "--leak-check=full"]
        return run([*checker, program("hostile.c", schedule, folder)], folder)
    return run([program("hostile.c", schedule, folder, *SANITIZERS)], folder)


def traps(schedule: Schedule, folder: Path, *flags: str) -> str:
    """The calls for one pose with floating-point traps on (glibc); what the program says when it ends."""
    return run([program("traps.c", schedule, folder, *flags)], folder)


def threads(schedule: Schedule, folder: Path, *flags: str, rounds: int = 1) -> str:
    """The same poses on many threads; what the program says when it ends."""
    return run([program("threads.c", schedule, folder, *flags, rounds=rounds)], folder)
