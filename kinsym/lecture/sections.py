"""The lecture's sections and what of kinsym does what each of them teaches."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path


@dataclass(frozen=True, kw_only=True)
class Section:
    """A section: its slides, first and last, names of kinsym's objects or commands, and what kinsym derives there.

    Each of ``derivations`` is a robot and a method.
    """

    title: str
    slides: tuple[int, int]
    kinsym: tuple[str, ...]
    derivations: tuple[tuple[str, str], ...]

    def holds(self, slide: int) -> bool:
        """Whether a slide belongs to the section."""
        first, last = self.slides
        return first <= slide <= last

    @property
    def place(self) -> str:
        """The slides as text.

        >>> sections()[0].place
        '5'
        """
        first, last = self.slides
        return str(first) if first == last else f"{first}-{last}"


@lru_cache(maxsize=1)
def sections() -> tuple[Section, ...]:
    """All sections that state something, in the lecture's order."""
    path = Path(str(resources.files("kinsym.lecture"))) / "sections.toml"
    return tuple(
        Section(
            title=raw["title"],
            slides=(raw["slides"][0], raw["slides"][1]),
            kinsym=tuple(raw["kinsym"]),
            derivations=tuple(_derivation(text) for text in raw.get("derivations", ())),
        )
        for raw in tomllib.loads(path.read_text("utf-8"))["section"]
    )


def _derivation(text: str) -> tuple[str, str]:
    robot, _, method = text.partition(" ")
    return robot, method
