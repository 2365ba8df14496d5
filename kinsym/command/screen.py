"""What a user sees while a command runs: progress on standard error, results on standard output.

On a terminal progress is one line that is rewritten, with the time that has passed; elsewhere every stage is a line
without a time, so that the logs of two equal runs are equal. A reader who closes the pipe early
(``kinsym derive ur5 | head``) ends the printing, not the work.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import textwrap
import time
from collections.abc import Mapping
from typing import TextIO

from kinsym.command.colour import BOLD, RED, painted, styled, understands, wanted
from kinsym.command.progress import USUAL, Progress, columns

#: Lines of text are as wide as the terminal, within these limits.
_NARROWEST, _WIDEST = 60, 140


class Screen:
    """The two streams of one run.

    ``quiet`` keeps everything but messages back. With ``as_json`` standard output is one JSON object, that of
    :meth:`give`, and nothing is said beside it.
    """

    def __init__(
        self, *, quiet: bool = False, as_json: bool = False, out: TextIO | None = None, err: TextIO | None = None
    ) -> None:
        self._quiet, self._as_json = quiet, as_json
        self._out = sys.stdout if out is None else out
        self._err = sys.stderr if err is None else err
        self._start = time.monotonic()
        self._open = True
        self._painted = wanted(self._out)
        self._progress = Progress(self._err, self._start) if understands(self._err) and not quiet else None

    def stage(self, text: str) -> None:
        """Progress: what is being done now."""
        if self._progress is not None:
            self._progress.stage(text)
        elif not self._quiet:
            self._to_error(f"{text} ...")

    @property
    def speaks(self) -> bool:
        """Whether what is said is printed: long texts need not be made otherwise."""
        return self._open and not self._quiet and not self._as_json

    def say(self, text: str = "", *, plain: bool = False) -> None:
        """A result; ``plain`` text is a file for another program and is never painted."""
        if self.speaks:
            self._to_output(painted(text) if self._painted and not plain else text)

    def heading(self, text: str) -> None:
        """The title of what follows, underlined."""
        self.say(f"{text}\n{'-' * len(text)}")

    def item(self, mark: str, text: str) -> None:
        """One line of a list, more if it is long: a word such as ``ok`` and what it is about."""
        for number, line in enumerate(filled(text, self.width - 10)):
            self.say(f"  {'' if number else mark:<7} {line}")

    def give(self, content: Mapping[str, object]) -> None:
        """The result as a JSON object, with ``--quiet`` as well: it is what was asked for."""
        self._to_output(json.dumps(content, indent=2))

    def refuse(self, kind: str, message: str, status: int) -> None:
        """Where a JSON object is expected: the one of a run that has no result."""
        if self._as_json:
            self.give({"status": status, "error": {"kind": kind, "message": message}})

    def warn(self, text: str) -> None:
        """A message that even a quiet run shows."""
        line = f"kinsym: {text}"
        if self._err.isatty():
            line = "\n".join(filled(line, columns(self._err)))
        if wanted(self._err):
            line = line.replace("kinsym:", styled("kinsym:", f"{BOLD};{RED}"), 1)
        self._to_error(line)

    def end(self) -> None:
        """Nothing follows: the line of progress gives way to the time that all of it took."""
        if self._progress is not None and self._progress.end():
            self._to_error(f"took {time.monotonic() - self._start:.1f} s")
        self.flush()

    def flush(self) -> None:
        """Send what is buffered, so that a closed pipe shows here and not at the interpreter's end."""
        try:
            self._out.flush()
        except BrokenPipeError:
            self._close()

    @property
    def width(self) -> int:
        """Columns to write in."""
        return max(_NARROWEST, min(columns(self._out), _WIDEST)) if self._out.isatty() else USUAL

    @property
    def ascii(self) -> bool:
        """Whether the output can show no more than ASCII."""
        try:
            "±".encode(self._out.encoding or "ascii")
        except (UnicodeEncodeError, LookupError):
            return True
        return False

    def _to_output(self, text: str) -> None:
        if not self._open:
            return
        try:
            with self._progress or contextlib.nullcontext():
                self._out.write(self._shown(text) + "\n")
                if self._progress is not None:
                    self._out.flush()
        except BrokenPipeError:
            self._close()

    def _shown(self, text: str) -> str:
        """The text in letters that the output has."""
        encoding = self._out.encoding or "utf-8"
        return text.encode(encoding, "replace").decode(encoding)

    def _to_error(self, text: str) -> None:
        with contextlib.suppress(BrokenPipeError, UnicodeEncodeError), self._progress or contextlib.nullcontext():
            print(text, file=self._err, flush=True)

    def _close(self) -> None:
        self._open = False
        if self._out is sys.stdout:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def filled(text: str, width: int) -> list[str]:
    """A text in lines; no word and no formula without blanks is cut."""
    return textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False)
