"""One form of one entry, ready to be decided."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from kinsym.lecture.chapter import Chapter, Entry, Form
from kinsym.lecture.reading import Reading, read
from kinsym.lecture.screw import GeneralScrew
from kinsym.lecture.system import System, system

POINTS = 3
"""Random postures at which an identity must hold; one that is false passes with a chance of about 1e-17 each."""


@dataclass(frozen=True)
class Case:
    """A form, printed or mended, of an entry of a chapter."""

    chapter: Chapter
    entry: Entry
    form: Form

    def option(self, name: str) -> Any:
        """What the entry's data says beside the equation; None where it says nothing."""
        return self.form.options.get(name)

    @property
    def robots(self) -> tuple[str, ...]:
        """The robots that the entry speaks of; empty where it speaks of none."""
        several = self.option("robots")
        if several:
            return tuple(several)
        name = self.option("robot") or self.chapter.robot
        return (name,) if name else ()

    def generator(self, salt: object = "") -> random.Random:
        """A source of random numbers that is the same on every machine."""
        return random.Random(f"{self.chapter.file} {self.entry.id} {salt}")

    def system(self) -> System | None:
        """The system of the entry; None where its equations hold for any numbers."""
        return find(self.robots[0], self.generator("axis")) if self.robots else None

    def readings(self, points: Iterable[int] = range(POINTS)) -> Iterator[Reading]:
        """The chapter read at random postures, with what the entry gives and moves; in turn for special cases."""
        specials = [self.option("given") or {}, *(self.option("also_given") or ())]
        for robot in self.robots or ("",):
            for point in points:
                for number, given in enumerate(specials):
                    generator = self.generator((robot, point, number))
                    found = find(robot, generator) if robot else None
                    yield read(self.chapter, found, generator, given, self.option("moved") or {})


def find(name: str, generator: random.Random) -> System:
    """The system of a name; of the general screw another one each time."""
    return GeneralScrew(generator) if name == GeneralScrew.NAME else system(name)
