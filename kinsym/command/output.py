"""The files of commands that draw: which names they may have, and what their kinds need."""

from __future__ import annotations

import argparse
import importlib.util
from collections.abc import Mapping, Sequence
from pathlib import Path

from kinsym.errors import KinsymError, OutputError
from kinsym.write import check_place, write_set

PICTURES = ("png", "svg")


def targets(named: Sequence[str] | None, usual: Sequence[str], kinds: Sequence[str]) -> list[Path]:
    """The files to write, checked as far as can be without writing: the named ones, or the usual ones.

    A file that is there is replaced only if it is named. Raises :class:`OutputError` for a name whose ending is none of
    ``kinds``, for a file that is in the way, and :class:`KinsymError` for a picture without matplotlib.
    """
    paths = [Path(name) for name in named or usual]
    for path in paths:
        if path.suffix.lower().removeprefix(".") not in kinds:
            endings = ", ".join("." + kind for kind in kinds)
            raise OutputError(f"{path} is no name of a file that is written here. Its ending tells what: {endings}.")
        if not named and path.exists():
            raise OutputError(f"{path} is there already. Name a file with --output; that one is then replaced.")
        check_place(path.parent, [path.name], anything=True)
    if len({path.absolute() for path in paths}) < len(paths):
        raise OutputError("a file is named twice. Name each once.")
    if any(kind_of(path) in PICTURES for path in paths) and importlib.util.find_spec("matplotlib") is None:
        raise KinsymError("pictures need matplotlib. Install it with: pip install 'kinsym[plot]'")
    return paths


def kind_of(path: Path) -> str:
    """What a file is, by its ending.

    >>> kind_of(Path("arm.SVG"))
    'svg'
    """
    return path.suffix.lower().removeprefix(".")


def unit_of(options: argparse.Namespace) -> str:
    """The unit to write at the axes: the one that is given, metres for a URDF file, which has no other, else none."""
    metres = options.table is not None and options.table.lower().endswith(".urdf")
    return options.unit or ("m" if metres else "")


def write(files: Mapping[Path, bytes]) -> None:
    """Write every file; all those of a folder or none of them."""
    for folder in dict.fromkeys(path.parent for path in files):
        write_set(
            folder, {path.name: content for path, content in files.items() if path.parent == folder}, anything=True
        )
