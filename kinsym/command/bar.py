"""How far a long calculation is: a bar on a terminal, nothing where standard error is a file or a pipe."""

from __future__ import annotations

import contextlib
import sys
import time
from typing import TextIO

_WIDTH = 30
_EVERY = 0.1
"""Seconds between two drawings."""


class Bar:
    """A bar that is redrawn in place and leaves nothing behind."""

    def __init__(self, *, quiet: bool = False, err: TextIO | None = None) -> None:
        self._err = sys.stderr if err is None else err
        self._shown = not quiet and self._err.isatty()
        self._start = time.monotonic()
        self._drawn = -_EVERY
        self._before: int | None = None
        self._columns = 0

    def __call__(self, done: int, total: int) -> None:
        """So many of all are done."""
        now = time.monotonic() - self._start
        self._before = done if self._before is None else self._before
        if not self._shown or (now - self._drawn < _EVERY and done < total):
            return
        self._drawn = now
        share = done / total if total else 1.0
        rest = ""
        if done > self._before and done < total:
            rest = f"  {now * (total - done) / (done - self._before):.0f} s left"
        filled = round(share * _WIDTH)
        self._write(f"  [{'#' * filled}{'.' * (_WIDTH - filled)}] {100.0 * share:3.0f} %{rest}")

    def clear(self) -> None:
        """Take the bar away."""
        if self._columns:
            self._write("")

    def _write(self, text: str) -> None:
        with contextlib.suppress(BrokenPipeError):
            self._err.write("\r" + text.ljust(self._columns) + ("\r" if not text else ""))
            self._err.flush()
        self._columns = len(text)
