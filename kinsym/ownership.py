"""Which files of a folder kinsym wrote, so that no others are ever replaced.

The report of a robot lists its files. Where another run has written another report since, most files still say in their
head who made them; the few that do not lie in a sub-folder of which another file says so.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

REPORTS = "*.report.json"
LARGEST_FILE = 1 << 24

_MARK = re.compile(rb"\b(generated|derived)\s+by\s+kinsym\b", re.IGNORECASE)


def foreign(folder: Path, names: Iterable[str]) -> Path | None:
    """The first of the files below ``folder`` that is there and was not written by kinsym; None if there is none."""
    listed = _listed(folder)
    return next((folder / name for name in names if name not in listed and _is_foreign(folder, name)), None)


def _is_foreign(folder: Path, name: str) -> bool:
    path, top = folder / name, folder / PurePosixPath(name).parts[0]
    if not os.path.lexists(path) or _says_so(path):
        return False
    return path == top or not any(map(_says_so, top.iterdir()))


def _listed(folder: Path) -> set[str]:
    """The names in the reports of a folder, and those of the reports themselves."""
    names: set[str] = set()
    for path in folder.glob(REPORTS):
        try:
            files = json.loads(_text(path))["files"]
            names |= {path.name, *map(str, files)}
        except (ValueError, LookupError, TypeError, RecursionError):
            continue  # no report of ours
    return names


def _says_so(path: Path) -> bool:
    """Whether a file is empty, or its text says that kinsym made it."""
    if path.is_dir():
        return False
    text = _text(path)
    return not text or _MARK.search(text) is not None


def _text(path: Path) -> bytes:
    """What a plain file holds, as far as a file of ours could; of anything else a word that says nothing."""
    if path.is_symlink() or not path.is_file():
        return b"?"
    with path.open("rb") as file:
        return file.read(LARGEST_FILE)
