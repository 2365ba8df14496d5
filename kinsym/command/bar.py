"""How far a long calculation is, as a bar with the time that is left."""

from __future__ import annotations

import time
from collections.abc import Callable

_WIDTH = 16


class Bar:
    """Turns counts into text: ``[########........]  50 %, 12 s left``."""

    def __init__(self, show: Callable[[str], None]) -> None:
        self._show = show
        self._start = time.monotonic()
        self._before: int | None = None

    def __call__(self, done: int, total: int) -> None:
        """So many of all are done; what was done before the first call says nothing about the speed."""
        if self._before is None:
            self._before, self._start = done, time.monotonic()
        share = done / total
        filled = round(share * _WIDTH)
        text = f"[{'#' * filled}{'.' * (_WIDTH - filled)}] {100.0 * share:3.0f} %"
        if self._before < done < total:
            left = (time.monotonic() - self._start) * (total - done) / (done - self._before)
            text += f", {left:.0f} s left"
        self._show(text)
