"""Files moved into a folder so that an interruption at any moment can be undone.

The files are prepared in a private folder inside the target, ``.kinsym-XXXXXXXX``:

    new/      the new files, written to the disk before anything else happens
    old/      what they will replace, as second names of the same files (copies where a file system has no hard links)
    journal   the names, and the digests of the new files

As long as there is a journal the move is not finished, and :func:`undo` leads back: a file whose digest is that of the
new one is replaced by the old one, or removed where there was none. What is neither is somebody's own work by now and
is left alone. Every step can be repeated, so that an undoing that is cut off is simply done again. The removal of
the journal is the one moment at which the new set counts.

Who moves or undoes holds the lock of the folder (``flock``, given back by the system whatever ends the process), so
that a private folder found under the lock belongs to nobody any more.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from kinsym.errors import OutputError

NEW, OLD, JOURNAL = "new", "old", "journal"
PREFIX = ".kinsym-"
PATIENCE = 30.0
LARGEST_JOURNAL = 1 << 20

_PRIVATE = re.compile(re.escape(PREFIX) + r"[a-z0-9_]{8}")
_PART = JOURNAL + ".part"


@dataclass(frozen=True)
class _Entry:
    digest: str
    replaces: bool


@dataclass(frozen=True)
class _Journal:
    """``files`` below the target by name, ``folders`` made for them, outermost first."""

    files: Mapping[str, _Entry]
    folders: tuple[str, ...]

    def text(self) -> str:
        files = {name: [entry.digest, entry.replaces] for name, entry in self.files.items()}
        return json.dumps({"files": files, "folders": self.folders})


def stays_inside(name: str) -> bool:
    """Whether a name is that of a file below a folder, and written plainly.

    >>> stays_inside("ur5-solver/setup.py"), stays_inside("../ur5.py"), stays_inside("/ur5.py"), stays_inside("a//b")
    (True, False, False, False)
    """
    path = PurePosixPath(name)
    inside = str(path) == name and bool(path.name) and ".." not in path.parts and not Path(name).anchor
    return inside and "\0" not in name


@contextlib.contextmanager
def alone(folder: Path) -> Iterator[bool]:
    """Hold the lock of a folder; whether it could be had at all.

    Without it (a folder that cannot be read, a file system or a platform that has none) the others are not known, and
    nothing of theirs must be touched. Raises OutputError if another run holds it for ``PATIENCE`` seconds.
    """
    descriptor = _opened(folder)
    if descriptor is None:
        yield False
        return
    try:
        yield _lock(descriptor, folder)
    finally:
        os.close(descriptor)


def stage(place: Path, files: Mapping[str, str | bytes]) -> Path:
    """A private folder in ``place`` with the texts (UTF-8, ``\\n`` line ends) or pictures under ``new``, on disk."""
    private = Path(tempfile.mkdtemp(prefix=PREFIX, dir=place))
    try:
        for name, content in files.items():
            target = private / NEW / name
            target.parent.mkdir(parents=True, exist_ok=True)
            _write(target, content)
        _sync_below(private)
    except BaseException:
        discard(private)
        raise
    return private


def move(private: Path, folder: Path, names: list[str]) -> None:
    """Put the files of a private folder into ``folder``, all or none.

    If that fails what was there comes back; if even that fails the journal stays, for :func:`sweep`.
    """
    folders = _missing_folders(folder, names)
    entries: dict[str, _Entry] = {}
    for name in names:
        replaces = os.path.lexists(folder / name)
        if replaces:
            _keep(folder / name, private / OLD / name)
        entries[name] = _Entry(_digest(private / NEW / name) or "", replaces)
    _write(private / _PART, _Journal(entries, folders).text())
    _sync_below(private)
    os.replace(private / _PART, private / JOURNAL)
    _sync(private)
    try:
        for below in folders:
            (folder / below).mkdir()
        for name in names:
            os.replace(private / NEW / name, folder / name)
        for place in sorted({(folder / name).parent for name in names}):
            _sync(place)
        (private / JOURNAL).unlink()
    except BaseException as error:
        try:
            undo(private, folder)
        except OSError as further:
            raise OutputError(
                f"{folder} could not be written ({error}), nor set back ({further}). What was there lies in {private}; "
                "the next kinsym derive or kinsym check in that folder puts it back."
            ) from error
        raise
    _sync(private)


def undo(private: Path, folder: Path) -> None:
    """Lead back to the old files; nothing where there is no journal, or one that is not ours."""
    journal = _read(private)
    if journal is None:
        return
    for name, entry in journal.files.items():
        if not _leads_inside(folder, name) or _digest(folder / name) != entry.digest:
            continue
        if not entry.replaces:
            (folder / name).unlink()
        elif os.path.lexists(private / OLD / name):
            os.replace(private / OLD / name, folder / name)
    for below in reversed(journal.folders):
        with contextlib.suppress(OSError):  # it holds something that is not ours
            (folder / below).rmdir()
    _sync(folder)
    (private / JOURNAL).unlink()


def sweep(folder: Path) -> bool:
    """Undo and clear away what runs that were killed have left; whether a set had to be undone.

    For the one who holds the lock.
    """
    undone = False
    for private in sorted(folder.glob(PREFIX + "*")):
        if not _is_ours(private):
            continue
        if (private / JOURNAL).exists():
            if _read(private) is None:
                continue
            undo(private, folder)
            undone = True
        discard(private)
    return undone


def discard(private: Path) -> None:
    """Remove a private folder, unless it is still needed to lead back."""
    if not (private / JOURNAL).exists():
        shutil.rmtree(private, ignore_errors=True)


def _opened(folder: Path) -> int | None:
    try:
        import fcntl  # noqa: F401, what POSIX alone has

        return os.open(folder, os.O_RDONLY)
    except (ImportError, OSError, ValueError):
        return None


def _lock(descriptor: int, folder: Path) -> bool:
    import fcntl

    end = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            if time.monotonic() > end:
                raise OutputError(f"another run of kinsym is writing into {folder}. Wait until it has ended.") from None
            time.sleep(0.01)
        except OSError:
            return False


def _is_ours(private: Path) -> bool:
    """Whether a folder is one that this user's kinsym has made, by name, owner and content."""
    if not _PRIVATE.fullmatch(private.name):
        return False
    state = private.lstat()
    return (
        stat.S_ISDIR(state.st_mode)
        and state.st_uid == os.geteuid()
        and {entry.name for entry in private.iterdir()} <= {NEW, OLD, JOURNAL, _PART}
    )


def _read(private: Path) -> _Journal | None:
    """The journal, None if it is none; names that lead out of the folder are nobody's."""
    path = private / JOURNAL
    try:
        if not stat.S_ISREG(path.lstat().st_mode) or path.stat().st_size > LARGEST_JOURNAL:
            return None
        content = json.loads(path.read_text(encoding="utf-8"))
        files = {str(name): _Entry(str(entry[0]), bool(entry[1])) for name, entry in content["files"].items()}
        folders = tuple(map(str, content["folders"]))
    except (FileNotFoundError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return None
    return _Journal(files, folders) if all(map(stays_inside, (*files, *folders))) else None


def _leads_inside(folder: Path, name: str) -> bool:
    """Whether no symbolic link on the way to a file leads elsewhere."""
    return not any((folder / above).is_symlink() for above in PurePosixPath(name).parents[:-1])


def _missing_folders(folder: Path, names: list[str]) -> tuple[str, ...]:
    """The sub-folders that the files need and that are not there, outermost first."""
    above = [str(place) for name in names for place in reversed(PurePosixPath(name).parents[:-1])]
    return tuple(place for place in dict.fromkeys(above) if not (folder / place).exists())


def _keep(path: Path, kept: Path) -> None:
    """A second name for a file, a link itself included; a copy where there are no second names."""
    kept.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(path, kept, follow_symlinks=False)
    except (OSError, NotImplementedError):
        shutil.copy2(path, kept, follow_symlinks=False)


def _digest(path: Path) -> str | None:
    """The digest of a plain file; None of anything else."""
    try:
        if not stat.S_ISREG(path.lstat().st_mode):
            return None
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except (FileNotFoundError, NotADirectoryError):
        return None


def _write(path: Path, content: str | bytes) -> None:
    with path.open("xb") as file:
        file.write(content.encode() if isinstance(content, str) else content)
        file.flush()
        os.fsync(file.fileno())


def _sync_below(folder: Path) -> None:
    for place, _, _ in os.walk(folder):
        _sync(Path(place))


def _sync(folder: Path) -> None:
    """Have the names in a folder written to the disk, where the system can do that."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
