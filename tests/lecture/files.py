"""The files of equations as they are stored."""

from __future__ import annotations

import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

FOLDER = Path(str(resources.files("kinsym.lecture"))) / "equations"
FILES = sorted(path.name for path in FOLDER.glob("*.toml"))


def content(file: str) -> dict[str, Any]:
    """What a file of equations holds."""
    return tomllib.loads((FOLDER / file).read_text("utf-8"))
