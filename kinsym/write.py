"""A set of files, all or none.

Everything is written into a private folder beside the targets first; only then are the files moved into place, each
in one step. What was there before comes back if a move fails. Files of other names are never touched.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from kinsym.errors import OutputError


def check_place(folder: Path, names: Iterable[str]) -> None:
    """Whether the files can be written into ``folder``, as far as can be told without writing.

    Raises OutputError where a file is in the way of the folder, a folder in the way of a file, or a permission is
    missing. Called before a long calculation, so that a slip shows at once.
    """
    for name in names:
        if Path(name).name != name or name in ("", ".", ".."):
            raise OutputError(f"{name!r} is no plain file name. Choose a name without folders.")
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
            if (folder / name).is_dir():
                raise OutputError(f"{folder / name} is a folder, so the file cannot be written. Rename the folder.")
    except OSError as error:
        raise OutputError(f"{folder} cannot be used: {_reason(error)}. Choose another with --output.") from error


def write_set(folder: Path, files: Mapping[str, str]) -> tuple[Path, ...]:
    """Write every text (UTF-8, ``\\n`` line ends) into ``folder``, made if need be; the paths in order.

    Raises OutputError; then the folder is as it was before.
    """
    check_place(folder, files)
    made: list[Path] = []
    try:
        made = _make(folder)
        with tempfile.TemporaryDirectory(prefix=".kinsym-", dir=folder) as private:
            new, old = Path(private, "new"), Path(private, "old")
            new.mkdir()
            old.mkdir()
            for name, text in files.items():
                (new / name).write_text(text, encoding="utf-8", newline="\n")
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
