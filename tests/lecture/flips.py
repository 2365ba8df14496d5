"""Slips of sign in the lecture's data: every text with one sign turned round, and whether that changes its value."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from kinsym.lecture.case import Case
from kinsym.lecture.chapter import Chapter, chapter_of
from kinsym.lecture.notation import parse
from kinsym.lecture.quantities import agree
from kinsym.lecture.residue import Undefined

KEYS = ("right", "left", "factors", "also", "rows", "branches", "means")
_SIGN = re.compile(r"(?<=[\w)\]]) ?([+-]) ?(?=[\w(])")


def slips(cell: Any) -> Iterator[tuple[Any, str, str]]:
    """A cell, list or table of cells with one sign turned, and the text before and after."""
    if isinstance(cell, str):
        for found in _SIGN.finditer(cell):
            place = found.start(1)
            after = cell[:place] + ("-" if cell[place] == "+" else "+") + cell[place + 1 :]
            yield after, cell, after
        bare = re.fullmatch(r"-(\w+)", cell)
        after = bare[1] if bare else f"-({cell})"
        if not cell.startswith("(") and "=" not in cell:
            yield after, cell, after
        return
    for place, inner in enumerate(cell):
        for changed, before, after in slips(inner):
            yield [*cell[:place], changed, *cell[place + 1 :]], before, after


@dataclass(frozen=True)
class Slip:
    """One sign turned round in one entry: ``key`` of its data, in the form that is true, becomes ``cells``."""

    number: int
    place: str | None
    key: str
    cells: Any
    before: str
    after: str

    def chapter(self, file: str, raw: dict[str, Any]) -> Chapter:
        """The chapter with this slip."""
        other = copy.deepcopy(raw)
        target = other["equation"][self.number]
        (target[self.place] if self.place else target)[self.key] = self.cells
        return chapter_of(file, other)


def slips_of(chapter: Chapter, raw: dict[str, Any], number: int) -> Iterator[Slip]:
    """The slips in one entry that change what a text stands for."""
    entry = raw["equation"][number]
    mended = entry.get("corrected", {})
    for key in KEYS:
        place = "corrected" if key in mended else None
        source = mended if place else entry
        if key not in source or (mended and not place and key in ("left", "right", "means")):
            continue
        if key in ("left", "right") and entry.get("check") == "solution":
            continue  # either sign of a root is one of the branches, which are turned one by one
        for cells, before, after in slips(source[key]):
            if _matters(chapter, number, before, after):
                yield Slip(number, place, key, cells, before, after)


def _matters(chapter: Chapter, number: int, before: str, after: str) -> bool:
    """Whether a slip changes what a text stands for at a random posture; sentences are compared side by side."""
    entry = chapter.entries[number]
    case = Case(chapter, entry, entry.mended or entry.printed)
    pairs = list(zip(re.split(r" !?= ", before), re.split(r" !?= ", after), strict=True))
    if before.startswith("(") or (not case.robots and not case.chapter.free):
        return True
    if case.option("rows_of"):
        return False  # its sides are read row by row, and one of them is zero
    reading = next(case.readings())
    for old, new in pairs:
        try:
            if not agree(reading.evaluate(parse(old)), reading.evaluate(parse(new))):
                return True
        except Undefined:
            return True
    return False
