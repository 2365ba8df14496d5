"""The lecture's names of matrices, by what kinsym derives: ``T_0_3``, ``A2``, ``R1``, ``O_4``, ``Z_3``, ``T_0_E``."""

from __future__ import annotations

import re
from dataclasses import dataclass

from kinsym.lecture.chapter import Chapter
from kinsym.lecture.system import Derived, System

_BETWEEN = re.compile(r"([TAR])_([a-z0-9]+)_([a-z0-9]+)")
_LINK = re.compile(r"([AR])([1-9])")
_PART = re.compile(r"([OXZ])_([a-z0-9]+)")
_COLUMNS = {"X": 0, "Z": 2, "O": 3}


@dataclass(frozen=True)
class Named:
    """A derived matrix, or the rotation (``"R"``) or a column (0 to 3) of it."""

    derived: Derived
    part: str | int | None


@dataclass(frozen=True)
class Frames:
    """The frames of a system as a chapter names them."""

    system: System
    labels: tuple[str, ...]

    @staticmethod
    def of(chapter: Chapter, system: System) -> Frames:
        """The frames of a chapter, numbered from 0 where it does not say."""
        rows = len(system.robot.joints)
        return Frames(system, chapter.frames or tuple(str(number) for number in range(rows + 1)))

    def find(self, name: str) -> Named | None:
        """What a name stands for; None where it is no matrix of this system."""
        if self.system.screws:
            return self._displacement(name)
        if found := _BETWEEN.fullmatch(name):
            letter, start, end = found.groups()
            if start in self.labels and end in self.labels and start != end:
                first, last = self.labels.index(start), self.labels.index(end)
                derived = self.system.part(first, last) if first < last else self.system.inverse(last, first)
                return Named(derived, "R" if letter == "R" else None)
        if (found := _LINK.fullmatch(name)) and found[2] in self.labels[1:]:
            return Named(self.system.link(self.labels.index(found[2])), "R" if found[1] == "R" else None)
        if (found := _PART.fullmatch(name)) and found[2] in self.labels:
            last = self.labels.index(found[2])
            return Named(self.system.part(0, last) if last else self.system.base, _COLUMNS[found[1]])
        return None

    def _displacement(self, name: str) -> Named | None:
        rows = len(self.system.robot.joints)
        if name == "T_0_E":
            return Named(self.system.pose, None)
        if name == "A_E":
            return Named(self.system.part(0, rows), None)
        if (found := _LINK.fullmatch(name)) and int(found[2]) <= rows:
            return Named(self.system.link(int(found[2])), "R" if found[1] == "R" else None)
        return None
