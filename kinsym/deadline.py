"""A limit of time that a derivation keeps by looking at the clock.

Every loop that can be long calls :meth:`Deadline.check`. There is no signal, no thread and no process behind it, so it
works on every platform, in every thread, and each derivation has its own.
"""

from __future__ import annotations

import math
import time

from kinsym.errors import DeadlineExceeded, KinsymError


class Deadline:
    """So many seconds from now; None for no limit.

    >>> Deadline(None).check()
    >>> Deadline(60).left() <= 60
    True
    """

    def __init__(self, seconds: float | None) -> None:
        if seconds is not None and not (math.isfinite(seconds) and seconds > 0):
            raise KinsymError(f"a deadline of {seconds:g} seconds is none. Give a positive number of seconds.")
        self._seconds = seconds
        self._end = math.inf if seconds is None else time.monotonic() + seconds
        self._reached = "nothing yet"

    def left(self) -> float:
        """The seconds that are left, infinity if there is no limit."""
        return self._end - time.monotonic()

    def note(self, reached: str) -> None:
        """Say how far the work has come, for the message of :meth:`check`."""
        self._reached = reached
        self.check()

    def check(self) -> None:
        """Raise :class:`DeadlineExceeded` if the time is over."""
        if self._end < math.inf and self.left() < 0:
            raise DeadlineExceeded(
                f"the derivation did not end within {self._seconds:g} s. Reached: {self._reached}. "
                "Give more time with --deadline (deadline=), or fold numbers in with --bind"
            )
