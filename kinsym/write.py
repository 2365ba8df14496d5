"""A set of files, all or none.

Everything is written into a private folder beside the targets first; only then are the files moved into place, each
in one step. What was there before comes back if a move fails. Files of other names are never touched. A name may lead
into sub-folders (``ur5-solver/setup.py``), never out of the folder.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath

from kinsym.errors import OutputError


def check_place(folder: Path, names: Iterable[str]) -> None:
    """Whether the files can be written into ``folder``, as far as can be told without writing.

    Raises OutputError where a file is in the way of the folder, a folder in the way of a file, or a permission is
    missing. Called before a long calculation, so that a slip shows at once.
    """
    for name in names:
        if not _stays_inside(name):
            raise OutputError(f"{name!r} is no file name below a folder. Choose a plain name.")
    if "\0" in str(folder):
        raise OutputError("the name of the folder holds a zero byte. Choose another with --output.")
    try:
        if folder.exists() and not folder.is_dir():
            raise OutputError(f"{folder} is a file, so no folder can be made there. Choose another with --output.")
        if not folder.exists():
            parent = next((above for above in folder.absolute().parents if above.exists()), Path("/"))
            if not parent.is_dir():
                raise OutputError(f"{parent} is a file, so {folder} cannot be made. Choose another with --output.")
            if not _writable(parent):
                raise OutputError(f"{parent} does not allow writing. Choose another folder with --output.")
            return
        if not _writable(folder):
            raise OutputError(f"{folder} does not allow writing. Choose another folder with --output.")
        for name in names:
            _check_way(folder, name)
    except OSError as error:
        raise OutputError(f"{folder} cannot be used: {_reason(error)}. Choose another with --output.") from error


def write_set(folder: Path, files: Mapping[str, str | bytes]) -> tuple[Path, ...]:
    """Write every text (UTF-8, ``\\n`` line ends) or picture into ``folder``, made if need be; the paths in order.

    Raises OutputError; then the folder is as it was before.
    """
    check_place(folder, files)
    made: list[Path] = []
    try:
        for place in dict.fromkeys((folder, *((folder / name).parent for name in files))):
            made += _make(place)
        with tempfile.TemporaryDirectory(prefix=".kinsym-", dir=folder) as private:
            new, old = Path(private, "new"), Path(private, "old")
            for name, content in files.items():
                for side in (new, old):
                    (side / name).parent.mkdir(parents=True, exist_ok=True)
                (new / name).write_bytes(content.encode() if isinstance(content, str) else content)
            _move(new, old, folder, list(files))
    except OSError as error:
        for path in reversed(made):
            path.rmdir()
        raise OutputError(f"{folder} could not be written: {_reason(error)}. Nothing there was changed.") from error
    except BaseException:
        for path in reversed(made):
            if not any(path.iterdir()):
                path.rmdir()
        raise
    return tuple(folder / name for name in files)


def _stays_inside(name: str) -> bool:
    path = PurePosixPath(name)
    return str(path) == name and bool(path.name) and ".." not in path.parts and not Path(name).anchor


def _check_way(folder: Path, name: str) -> None:
    """OutputError if a file is in the way of a sub-folder, a folder in the way of the file, or one cannot be used."""
    path = folder / name
    if path.is_dir():
        raise OutputError(f"{path} is a folder, so the file cannot be written. Rename the folder.")
    for above in PurePosixPath(name).parents[:-1]:
        place = folder / above
        if place.exists() and not place.is_dir():
            raise OutputError(f"{place} is a file, so no folder can be made there. Choose another with --output.")
        if place.exists() and not _writable(place):
            raise OutputError(f"{place} does not allow writing. Choose another folder with --output.")


def _make(folder: Path) -> list[Path]:
    """Make the folder and what is above it; the new ones, outermost first."""
    absolute = folder.absolute()
    missing = [path for path in (absolute, *absolute.parents) if not path.exists()]
    made: list[Path] = []
    try:
        for path in reversed(missing):
            path.mkdir()
            made.append(path)
    except OSError:
        for path in reversed(made):
            path.rmdir()
        raise
    return made


def _move(new: Path, old: Path, folder: Path, names: list[str]) -> None:
    moved: list[str] = []
    try:
        for name in names:
            if (folder / name).exists():
                shutil.copy2(folder / name, old / name)
        for name in names:
            os.replace(new / name, folder / name)
            moved.append(name)
    except BaseException:
        for name in moved:
            if (old / name).exists():
                os.replace(old / name, folder / name)
            else:
                (folder / name).unlink()
        raise


def _writable(folder: Path) -> bool:
    return os.access(folder, os.W_OK | os.X_OK, effective_ids=os.access in os.supports_effective_ids)


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()
