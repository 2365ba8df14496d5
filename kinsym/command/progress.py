"""What is being done, and for how long: one line of a terminal that a thread rewrites.

The line is erased whenever anything else is written and when the work ends, however it ends, so that a terminal is
left as it was found. The cursor stays visible: a killed process leaves nothing to be put right.
"""

from __future__ import annotations

import os
import threading
import time
from contextlib import suppress
from typing import TextIO

#: Seconds between two drawings of the line.
_PERIOD = 0.1
_ERASE = "\r\x1b[K"
#: Columns where no terminal says how many.
USUAL = 80


class Progress:
    """The live line of one terminal; nothing is drawn before the first :meth:`stage`.

    Inside ``with progress:`` the line is gone, so that other text can be written.
    """

    def __init__(self, stream: TextIO, start: float) -> None:
        self._stream, self._start = stream, start
        self._text, self._since = "", start
        self._drawn = False
        self._lock = threading.RLock()
        self._ended = threading.Event()
        self._thread: threading.Thread | None = None

    def stage(self, text: str) -> None:
        """Show another text, its own time counted from now."""
        with self._lock:
            self._text, self._since = text, time.monotonic()
            self._draw()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="progress", daemon=True)
            self._thread.start()

    def end(self) -> bool:
        """Stop for good and leave an empty line; whether there was anything to stop."""
        running, self._thread = self._thread, None
        self._ended.set()
        if running is not None:
            running.join()
        self._erase()
        return running is not None

    def __enter__(self) -> None:
        """Erase the line; it comes back at the next drawing."""
        self._lock.acquire()
        self._erase()

    def __exit__(self, *_: object) -> None:
        """The line may be drawn again."""
        self._lock.release()

    def _run(self) -> None:
        while not self._ended.wait(_PERIOD):
            # Never waiting for the lock, the thread can be joined even by one who was interrupted with the lock held.
            if self._lock.acquire(blocking=False):
                try:
                    self._draw()
                finally:
                    self._lock.release()

    def _draw(self) -> None:
        now = time.monotonic()
        line = f"[{now - self._start:5.1f} s] {self._text} ..."
        if self._since > self._start and now - self._since >= 1:
            line += f" {now - self._since:.0f} s"
        room = columns(self._stream) - 1  # a full line would wrap and leave its first half behind
        self._write(_ERASE + line[:room])
        self._drawn = True

    def _erase(self) -> None:
        if self._drawn:
            self._drawn = False
            self._write(_ERASE)

    def _write(self, text: str) -> None:
        with suppress(OSError, UnicodeEncodeError):  # a terminal that has gone away ends no derivation
            self._stream.write(text)
            self._stream.flush()


def columns(stream: TextIO) -> int:
    """The columns of the terminal behind a stream, ``USUAL`` where there is none; COLUMNS comes first, as everywhere.

    >>> import io
    >>> columns(io.StringIO())
    80
    """
    if not stream.isatty():
        return USUAL
    with suppress(KeyError, ValueError):
        if (told := int(os.environ["COLUMNS"])) > 0:
            return told
    with suppress(OSError):
        return os.get_terminal_size(stream.fileno()).columns or USUAL
    return USUAL
