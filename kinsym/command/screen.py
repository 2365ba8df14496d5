"""What a user sees while a command runs: progress on standard error, results on standard output.

Elapsed times appear on a terminal alone, so that a log of two equal runs is equal. A reader who closes the pipe
early (``kinsym derive ur5 | head``) ends the printing, not the work.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import time
from typing import TextIO


class Screen:
    """The two streams of one run."""

    def __init__(self, *, quiet: bool = False, out: TextIO | None = None, err: TextIO | None = None) -> None:
        self._quiet = quiet
        self._out = sys.stdout if out is None else out
        self._err = sys.stderr if err is None else err
        self._start = time.monotonic()
        self._open = True

    def stage(self, text: str) -> None:
        """Progress: what is being done now."""
        if self._quiet:
            return
        clock = f"[{time.monotonic() - self._start:5.1f} s] " if self._err.isatty() else ""
        self._to_error(f"{clock}{text} ...")

    def say(self, text: str = "") -> None:
        """A result."""
        if self._quiet or not self._open:
            return
        try:
            self._out.write(text + "\n")
        except UnicodeEncodeError:
            encoding = self._out.encoding or "ascii"
            self._out.write(text.encode(encoding, "replace").decode(encoding) + "\n")
        except BrokenPipeError:
            self._close()

    def warn(self, text: str) -> None:
        """A message that even a quiet run shows."""
        self._to_error(f"kinsym: {text}")

    def flush(self) -> None:
        """Send what is buffered, so that a closed pipe shows here and not at the interpreter's end."""
        try:
            self._out.flush()
        except BrokenPipeError:
            self._close()

    @property
    def width(self) -> int:
        """Columns to write in."""
        return max(60, min(shutil.get_terminal_size().columns, 140)) if self._out.isatty() else 96

    @property
    def ascii(self) -> bool:
        """Whether the output can show no more than ASCII."""
        try:
            "±".encode(self._out.encoding or "ascii")
        except (UnicodeEncodeError, LookupError):
            return True
        return False

    def _to_error(self, text: str) -> None:
        with contextlib.suppress(BrokenPipeError, UnicodeEncodeError):
            print(text, file=self._err, flush=True)

    def _close(self) -> None:
        self._open = False
        if self._out is sys.stdout:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
