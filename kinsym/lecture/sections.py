"""The lecture's sections and what of kinsym does what each of them teaches."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any


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


@dataclass(frozen=True, kw_only=True)
class Further:
    """What kinsym derives of the lecture's arms beyond the lecture."""

    title: str
    derivations: tuple[tuple[str, str], ...]


@lru_cache(maxsize=1)
def sections() -> tuple[Section, ...]:
    """All sections that state something, in the lecture's order."""
    return tuple(
        Section(
            title=raw["title"],
            slides=(raw["slides"][0], raw["slides"][1]),
            kinsym=tuple(raw["kinsym"]),
            derivations=_derivations(raw),
        )
        for raw in _content()["section"]
    )


@lru_cache(maxsize=1)
def further() -> tuple[Further, ...]:
    """The inverse kinematics of the arms that the lecture leaves to its reader."""
    return tuple(Further(title=raw["title"], derivations=_derivations(raw)) for raw in _content()["further"])


def _content() -> dict[str, Any]:
    path = Path(str(resources.files("kinsym.lecture"))) / "sections.toml"
    return tomllib.loads(path.read_text("utf-8"))


def _derivations(raw: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    pairs = (text.partition(" ") for text in raw.get("derivations", ()))
    return tuple((robot, method) for robot, _, method in pairs)
