"""The rules, one file a shape of equation; the search asks each of them for candidates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from kinsym.inverse.rules import (
    homogeneous,
    lengths,
    linear,
    linear_pole,
    sine_cosine,
    slides,
    square_and_add,
    square_and_add_slide,
    triangle,
)
from kinsym.inverse.rules.base import Candidate, View


class Rule(Protocol):
    """What the search wants of the module of a rule."""

    TITLES: dict[str, str]

    def candidates(self, view: View) -> Iterator[Candidate]:
        """The candidates that a rule sees in a state."""
        ...


RULES: tuple[Rule, ...] = (sine_cosine, lengths, slides, homogeneous, triangle, linear_pole, linear)
"""In order of preference; the cost of a candidate decides."""

LAST_RULES: tuple[Rule, ...] = (square_and_add, square_and_add_slide)
"""Rules that are dearer than all others, and take longer to look."""

TITLES: dict[str, str] = {key: title for rule in (*RULES, *LAST_RULES) for key, title in rule.TITLES.items()}
"""What a reader calls each rule."""
