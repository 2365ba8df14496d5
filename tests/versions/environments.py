"""Virtual environments at the ends of what ``pyproject.toml`` allows."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LOWEST, NEWEST = "lowest", "newest"


@dataclass(frozen=True, kw_only=True)
class Environment:
    """An interpreter and what pip is asked for."""

    python: Path
    version: tuple[int, int]
    ends: str
    requirements: tuple[str, ...]

    @property
    def label(self) -> str:
        """For example ``python 3.11, lowest``."""
        return f"python {self.version[0]}.{self.version[1]}, {self.ends}"

    def make(self, folder: Path) -> Path:
        """Make it in ``folder`` unless it is there; its interpreter."""
        place = folder / re.sub(r"\W+", "-", self.label)
        interpreter = place / "bin" / "python"
        if not (place / "complete").exists():
            shutil.rmtree(place, ignore_errors=True)
            subprocess.run([self.python, "-m", "venv", place], check=True)
            pip = [interpreter, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
            subprocess.run([*pip, *self.requirements], check=True)
            (place / "complete").touch()
        return interpreter


def environments() -> list[Environment]:
    """The oldest Python with the lowest versions, and each Python that is found here with the newest."""
    found = pythons()
    oldest = min(found)
    first = Environment(
        python=found[oldest], version=oldest, ends=LOWEST, requirements=tuple(map(lowest, requirements()))
    )
    rest = [
        Environment(python=path, version=version, ends=NEWEST, requirements=requirements())
        for version, path in sorted(found.items())
    ]
    return [first, *rest]


def requirements() -> tuple[str, ...]:
    """What kinsym needs, and its extras ``flint`` and ``urdf``."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    return tuple(re.sub(r"\s*;.*", "", line) for line in (*project["dependencies"], *extras["flint"], *extras["urdf"]))


def lowest(requirement: str) -> str:
    """A requirement at its lower bound.

    >>> lowest("numpy>=1.26,<3")
    'numpy==1.26'
    """
    name, bound = re.fullmatch(r"([\w.-]+)>=([\d.]+)(?:,.*)?", requirement).groups()  # type: ignore[union-attr]
    return f"{name}=={bound}"


def pythons() -> dict[tuple[int, int], Path]:
    """The supported interpreters of this machine by version: those on the path, and those of pyenv."""
    least = supported()[0]
    candidates = [shutil.which(f"python3.{minor}") for minor in range(least[1], least[1] + 20)]
    candidates += map(
        str, sorted(Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")).glob("versions/*/bin/python"))
    )
    found: dict[tuple[int, int], Path] = {}
    for path in filter(None, candidates):
        code = "import sys; print(*sys.version_info[:2])"
        told = subprocess.run([path, "-c", code], capture_output=True, text=True, check=False)
        if told.returncode == 0:
            major, minor = map(int, told.stdout.split())
            if (major, minor) in supported():
                found.setdefault((major, minor), Path(path))
    return found


def supported() -> list[tuple[int, int]]:
    """The versions of Python that the classifiers name."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = (re.search(r":: (3)\.(\d+)$", line) for line in project["classifiers"])
    return sorted((int(match[1]), int(match[2])) for match in named if match)
