"""Generated C++ on disk and compiled."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule

WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror")
COMPILERS = [path for path in map(shutil.which, ("g++", "clang++")) if path]
needs_compiler = pytest.mark.skipif(not COMPILERS, reason="no C++ compiler")


def write(schedule: Schedule, target: str, folder: Path) -> None:
    """The files of one target."""
    for name, text in TARGETS[target](schedule).items():
        (folder / name).write_text(text, encoding="utf-8")


def compiled(compiler: str, folder: Path, source: str, *flags: str) -> None:
    """Fail with what the compiler says where ``source`` does not compile without a warning."""
    command = [compiler, *WARNINGS, *flags, source]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stderr}"
