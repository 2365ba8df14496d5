"""One step of a solver without a closed form, as both the terminal and paper print it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

Naming = Callable[[str], str]
"""How a name of the program is written; on paper it becomes mathematics."""


@dataclass(frozen=True)
class Formula:
    """``left = right``, as plain text and for LaTeX."""

    text: tuple[str, str]
    tex: tuple[str, str]


@dataclass(frozen=True)
class Stage:
    """One numbered step: its unknowns, what happens to them, and sentences with formulas between them.

    In a sentence what stands in braces is mathematics.
    """

    unknowns: tuple[str, ...]
    title: str
    body: tuple[str | Formula, ...]


def inline(text: str) -> str:
    """Mathematics inside a sentence."""
    return f"{{{text}}}"
