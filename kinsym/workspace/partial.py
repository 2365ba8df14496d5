"""What a sweep has found so far, kept in a file so that one that was stopped goes on where it was.

The file is replaced in one step, twice a second at most and seldom enough to cost little, so that even a process that
is killed leaves a whole one. It says which question it belongs to; one of another arm or of other settings is refused,
never mixed in.
"""

from __future__ import annotations

import io
import json
import os
import time
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from kinsym.errors import OutputError

if TYPE_CHECKING:
    from kinsym.workspace.sweeping import Counts, Question

_PAUSE, _COST = 0.5, 20.0
"""The least time between two writings, in seconds and in times that the last one took."""
_UNKNOWN = -1
_FORMAT = "kinsym workspace, in part"


class Kept:
    """The answers to a question, point by point; in a file too if one is named."""

    def __init__(self, question: Question, path: Path | None) -> None:
        import numpy as np

        self._said, self._path = question.said(), path
        total = int(np.prod(question.shape))
        self._hits = np.full(total, _UNKNOWN, dtype=np.int64)
        if path is not None and path.exists():
            self._hits[:] = _read(path, self._said, total)
        self._next = time.monotonic() + _PAUSE

    def __enter__(self) -> Kept:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # Ctrl-C or a lost worker: what there is stays; a second error would hide the first.
        if kind is not None and self.count:
            self._write()

    @property
    def count(self) -> int:
        """How many points are known."""
        return int((self._hits != _UNKNOWN).sum())

    def has(self, start: int, stop: int) -> bool:
        """Whether all of these points are known."""
        return bool((self._hits[start:stop] != _UNKNOWN).all())

    def put(self, start: int, stop: int, hits: Counts) -> None:
        """Add what was found at some points."""
        self._hits[start:stop] = hits
        if time.monotonic() > self._next:
            self._write()

    def done(self) -> Counts:
        """All answers; the file stays until :func:`forget` is told that the results are written."""
        self._write()
        return self._hits

    def _write(self) -> None:
        import numpy as np

        if self._path is None:
            return
        began = time.monotonic()
        said = json.dumps({"format": _FORMAT, **self._said})
        fresh = _fresh(self._path)
        try:
            fresh.parent.mkdir(parents=True, exist_ok=True)
            with fresh.open("wb") as file:
                np.savez_compressed(file, said=np.array(said), hits=self._hits)
            os.replace(fresh, self._path)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise OutputError(f"{self._path} could not be written: {reason}. Name another output.") from error
        now = time.monotonic()
        self._next = now + max(_PAUSE, _COST * (now - began))


def forget(path: Path) -> None:
    """Remove the file of a sweep whose results are written."""
    path.unlink(missing_ok=True)
    _fresh(path).unlink(missing_ok=True)


def _fresh(path: Path) -> Path:
    """Where the file is written before it is moved into place; a process that is killed may leave it behind."""
    return path.with_name(path.name + ".new")


def _read(path: Path, said: dict[str, str], total: int) -> Any:
    import numpy as np

    remedy = "Remove the file, or name another output."
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as content:
            kept, hits = json.loads(str(content["said"])), np.asarray(content["hits"])
        if kept.get("format") != _FORMAT:
            raise ValueError("it is of another format")
    except Exception as error:
        # NumPy, zipfile and zlib each have errors of their own for a broken file.
        raise OutputError(f"{path} is no part of a workspace: {error}. {remedy}") from error
    other = [word for word, value in said.items() if kept.get(word) != value]
    if other:
        raise OutputError(
            f"{path} holds a part of another sweep: {_listed(other)} differ{'s' * (len(other) == 1)}. {remedy}"
        )
    if hits.shape != (total,):
        raise OutputError(f"{path} is no part of a workspace: it has {hits.shape} points. {remedy}")
    return hits


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
