"""What the clock is given: groups of entries that answer the same inputs. Plain data, read on both sides."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tests.benchmarks.speed.arms import Floats

#: For each input the rows that came out: solutions, or one matrix as a row.
Answer = list[Floats]


@dataclass(frozen=True, kw_only=True)
class Library:
    """A compiled adapter (:mod:`tests.benchmarks.speed.native`) that writes ``rows`` of ``width`` numbers an input."""

    path: Path
    rows: int
    width: int


@dataclass(frozen=True, kw_only=True)
class Python:
    """A module of ``peers``; kinsym's is told where its files are."""

    peer: str
    many: bool = False
    folder: Path | None = None


@dataclass(frozen=True, kw_only=True)
class Refusal:
    """A library that cannot be asked, and why: it has a line of its own."""

    why: str


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One contender. ``number`` of the inputs are put to it; slow ones get fewer."""

    name: str
    arm: str
    program: Library | Python | Refusal
    number: int


@dataclass(frozen=True, kw_only=True)
class Goal:
    """The time of an entry over another's (the first one's if it is not named) must be at least so much, or at most."""

    entry: str
    ratio: float
    over: str = ""
    most: bool = False

    def met(self, ratio: float) -> bool:
        """Whether a ratio will do."""
        return ratio <= self.ratio if self.most else ratio >= self.ratio


@dataclass(frozen=True, kw_only=True)
class Group:
    """Contenders for one thing; all ratios are to the first one. ``kind`` is ``ik``, ``fk`` or ``jacobian``."""

    title: str
    arm: str
    kind: str
    inputs: Floats
    entries: tuple[Entry, ...]
    goals: tuple[Goal, ...] = ()
