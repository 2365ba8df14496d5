"""Running totals of the laws while the choices of parameters are worked through."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kinsym.check.report import FAILED, NOT_RUN, PASSED, Check, at_most


@dataclass
class _Entry:
    limit: str = ""
    tried: int = 0
    failed: int = 0
    worst: float | None = None
    note: str = ""
    run: bool = True


class Ledger:
    """Totals by law and by who was held to it, in the order in which the laws were first recorded."""

    def __init__(self) -> None:
        self._entries: dict[tuple[str, str], _Entry] = {}
        self.tallies: dict[str, int] = {}

    def judge(self, law: str, subject: str, errors: NDArray[np.float64], limit: float) -> None:
        """Every error must be at most ``limit``; NaN fails."""
        fine = errors <= limit
        self.count(law, subject, int(errors.size), int(errors.size - np.count_nonzero(fine)), limit=f"<= {limit:g}")
        entry = self._entries[law, subject]
        worst = float(np.max(np.where(np.isnan(errors), np.inf, errors), initial=0.0))
        entry.worst = max(entry.worst or 0.0, worst)

    def count(self, law: str, subject: str, tried: int, failed: int, *, limit: str = "", note: str = "") -> None:
        """Add cases to a law."""
        entry = self._entries.setdefault((law, subject), _Entry(limit=limit))
        entry.tried += tried
        entry.failed += failed
        entry.note = note or entry.note

    def fail(self, law: str, subject: str, note: str) -> None:
        """A law that cannot even be tried because the source is broken."""
        self.count(law, subject, 1, 1, note=note)

    def skip(self, law: str, subject: str, note: str) -> None:
        """A law that could not be tried through no fault of the source."""
        self._entries[law, subject] = _Entry(run=False, note=note)

    def tally(self, what: str, number: int) -> None:
        """A figure that depends on the machine."""
        self.tallies[what] = self.tallies.get(what, 0) + number

    def checks(self) -> tuple[Check, ...]:
        """The laws as the report holds them."""
        return tuple(
            Check(
                law=law,
                subject=subject,
                status=NOT_RUN if not entry.run else FAILED if entry.failed else PASSED,
                tried=entry.tried,
                failed=entry.failed,
                limit=entry.limit,
                note=entry.note,
            )
            for (law, subject), entry in self._entries.items()
        )

    def worst(self) -> dict[str, dict[str, str]]:
        """The largest error by law and subject, rounded upward."""
        largest: dict[str, dict[str, str]] = {}
        for (law, subject), entry in self._entries.items():
            if entry.worst is not None:
                largest.setdefault(law, {})[subject] = at_most(entry.worst)
        return largest
