"""A set of files, all or none, in a folder that may hold files of others.

Everything is written into a private folder first. What is guaranteed then:

* Where the folder is new it appears with all its files in one step (one ``rename``): there is no moment at which it
  holds some of them.
* Where the folder is there each file is replaced in one step, so that no file is ever half written, and the whole
  move is under a journal (:mod:`kinsym.journal`). A move that fails (a full disk, a permission, Ctrl-C) is undone
  before the error is told. A process that is killed in the midst of it, or a machine that loses its power, leaves the
  journal, and the next ``kinsym derive`` or ``kinsym check`` of that folder first puts the old set back. Between the
  kill and that run files of both sets can lie side by side: a folder can only be exchanged whole, in one step, if
  the user's own files are moved with it. The digests in the report tell the two sets apart.
* A file is replaced if kinsym wrote it (:mod:`kinsym.ownership`). Others are never replaced, removed or changed, and
  symbolic links never followed, except in the name of the folder itself.
* Two runs into one folder wait for each other.

Where a file system has no locks (some network drives) a killed run cannot be told from one at work, so there the
journal stays until somebody reads it.

A name may lead into sub-folders (``ur5-solver/setup.py``), never out of the folder.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath

from kinsym.errors import OutputError
from kinsym.journal import NEW, alone, discard, move, stage, stays_inside, sweep
from kinsym.ownership import foreign


def check_place(folder: Path, names: Iterable[str], *, anything: bool = False) -> None:
    """Whether the files can be written into ``folder``, as far as can be told without writing.

    Raises OutputError where a file is in the way of the folder, a folder in the way of a file, a file there is not
    kinsym's (unless ``anything`` may be replaced), or a permission is missing. Called before a long calculation, so
    that a slip shows at once.
    """
    names = list(names)
    for name in names:
        if not stays_inside(name):
            raise OutputError(f"{name!r} is no file name below a folder. Choose a plain name.")
    if "\0" in str(folder):
        raise OutputError("the name of the folder holds a zero byte. Choose another with --output.")
    try:
        if folder.exists() and not folder.is_dir():
            raise OutputError(
                f"{_shown(folder)} is a file, so no folder can be made there. Choose another with --output."
            )
        if not folder.exists():
            parent = next((above for above in folder.absolute().parents if above.exists()), Path("/"))
            if not parent.is_dir():
                raise OutputError(
                    f"{_shown(parent)} is a file, so {_shown(folder)} cannot be made. Choose another with --output."
                )
            if not _writable(parent):
                raise OutputError(f"{_shown(parent)} does not allow writing. Choose another folder with --output.")
            return
        if not _writable(folder):
            raise OutputError(f"{_shown(folder)} does not allow writing. Choose another folder with --output.")
        for name in names:
            _check_way(folder, name)
        other = None if anything else foreign(folder, names)
    except OSError as error:
        raise OutputError(
            f"{_shown(folder)} cannot be used: {_reason(error)}. Choose another with --output."
        ) from error
    if other is not None:
        raise OutputError(
            f"{_shown(other)} was not written by kinsym, so it is not replaced. "
            "Rename it, or choose another folder with --output."
        )


def write_set(folder: Path, files: Mapping[str, str | bytes], *, anything: bool = False) -> tuple[Path, ...]:
    """Write every text (UTF-8, ``\\n`` line ends) or picture into ``folder``, made if need be; the paths in order.

    With ``anything`` the user named the very files, and they are replaced whoever wrote them. Raises OutputError; then
    the folder is as it was before.
    """
    put_back(folder)
    check_place(folder, files, anything=anything)
    try:
        while not _written(folder, files):
            pass
    except OSError as error:
        raise OutputError(
            f"{_shown(folder)} could not be written: {_reason(error)}. Nothing there was changed."
        ) from error
    return tuple(folder / name for name in files)


def put_back(folder: Path) -> bool:
    """Undo what a killed run has left half moved in a folder; whether there was such a thing.

    Raises OutputError if it cannot be undone.
    """
    try:
        with alone(folder) as known:
            return known and sweep(folder)
    except OSError as error:
        raise OutputError(
            f"what an interrupted run has left in {_shown(folder)} cannot be undone: {_reason(error)}. "
            "Mend that, and run kinsym again."
        ) from error


def _written(folder: Path, files: Mapping[str, str | bytes]) -> bool:
    """Write the set in one of the two ways; False if the folder came or went while its lock was awaited."""
    absolute = Path(os.path.realpath(folder))
    missing = [path for path in (absolute, *absolute.parents) if not path.exists()]
    place = missing[-1].parent if missing else absolute
    with alone(place) as known:
        if missing[-1].exists() if missing else not absolute.exists():
            return False
        if known:
            sweep(place)
        if not missing:
            _replace(absolute, files)
        else:
            _appear(absolute, missing[-1], files)
    return True


def _appear(folder: Path, top: Path, files: Mapping[str, str | bytes]) -> None:
    """Make a new folder with all its files; ``top`` is the outermost of the folders that are missing."""
    way = folder.relative_to(top.parent).as_posix()
    private = stage(top.parent, {f"{way}/{name}": text for name, text in files.items()})
    try:
        os.rename(private / NEW / top.name, top)
    finally:
        discard(private)


def _replace(folder: Path, files: Mapping[str, str | bytes]) -> None:
    private = stage(folder, files)
    try:
        move(private, folder, list(files))
    finally:
        discard(private)


def _check_way(folder: Path, name: str) -> None:
    """OutputError if a file is in the way of a sub-folder, a folder in the way of the file, or one cannot be used."""
    path = folder / name
    if path.is_dir():
        raise OutputError(f"{_shown(path)} is a folder, so the file cannot be written. Rename the folder.")
    for above in PurePosixPath(name).parents[:-1]:
        place = folder / above
        if place.is_symlink():
            raise OutputError(
                f"{_shown(place)} is a symbolic link, which is not followed. Rename it, or choose another --output."
            )
        if place.exists() and not place.is_dir():
            raise OutputError(
                f"{_shown(place)} is a file, so no folder can be made there. Choose another with --output."
            )
        if place.exists() and not _writable(place):
            raise OutputError(f"{_shown(place)} does not allow writing. Choose another folder with --output.")


def _writable(folder: Path) -> bool:
    return os.access(folder, os.W_OK | os.X_OK, effective_ids=os.access in os.supports_effective_ids)


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _shown(path: Path) -> str:
    """A path as messages name it: on one line, and cut where it is no path that a system knows."""
    text = str(path)
    return (text if text.isprintable() else ascii(text)[1:-1])[:1000]
