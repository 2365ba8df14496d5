"""What a mutant is, whatever it is made of."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

SIGN = "sign flipped"
TRIG = "sine and cosine swapped"
BRANCH = "branch dropped"
CONSTANT = "constant changed by 1e-6"
PARAMETER = "parameters swapped"
GUARD = "guard removed"
KINDS = (SIGN, TRIG, BRANCH, CONSTANT, PARAMETER, GUARD)

#: What is in no function.
OUTSIDE = "the head"

#: By how much a constant is changed, and what 0 becomes.
CHANGE = 1e-6


@dataclass(frozen=True, kw_only=True)
class Mutant:
    """One change: its kind, where it is (in a text function, line and column), what stood there and what does now.

    ``make`` gives the changed text, or the changed schedule of a plan.
    """

    language: str
    kind: str
    where: str
    before: str
    after: str
    make: Callable[[], Any]

    def __str__(self) -> str:
        return f"{self.language}, {self.where}: {self.kind}: {self.before} -> {self.after}"


Change = tuple[str, int, int, str]
"""The kind of a change in a text, where it begins and ends, and what stands there now."""


def text_mutants(language: str, text: str, changes: Iterable[Change], function: re.Pattern[str]) -> list[Mutant]:
    """The mutants of one source text; the pattern finds where a function begins, and its name."""
    heads = [(match.start(), match.group(1)) for match in function.finditer(text)]
    return [
        Mutant(
            language=language,
            kind=kind,
            where=f"{_inside(heads, start)}, {_place(text, start)}",
            before=_around(text, start, end, text[start:end]),
            after=_around(text, start, end, new),
            make=partial(_changed, text, start, end, new),
        )
        for kind, start, end, new in changes
    ]


def _inside(heads: list[tuple[int, str]], start: int) -> str:
    """The function that a place is in; what stands before all of them is named by a word of its own."""
    return next((name for begin, name in reversed(heads) if begin <= start), OUTSIDE)


def _place(text: str, start: int) -> str:
    """A place by its line and its column."""
    return f"line {text.count(chr(10), 0, start) + 1}:{start - text.rfind(chr(10), 0, start)}"


def _changed(text: str, start: int, end: int, new: str) -> str:
    return text[:start] + new + text[end:]


def _around(text: str, start: int, end: int, middle: str) -> str:
    """A change with some of its line on both sides."""
    left = text[text.rfind("\n", 0, start) + 1 : start].lstrip()[-32:]
    right = text[end : text.find("\n", end)][:24]
    return " ".join(f"{left}{middle}{right}".split())


def nudged(number: float) -> float:
    """The constant that takes the place of another."""
    return number * (1.0 + CHANGE) if number else CHANGE


def other(name: str, names: tuple[str, ...]) -> str | None:
    """The name after a name in a ring of names; None if it is none of them or the only one."""
    if name not in names or len(names) == 1:
        return None
    return names[(names.index(name) + 1) % len(names)]


def turned(name: str) -> str | None:
    """The cosine of a sine and the sine of a cosine by their names (c1, s23, c2m3, c, s); None for other names."""
    letter, rest = name[:1], name[1:]
    if letter not in ("c", "s") or not all(sign.isdigit() or sign == "m" for sign in rest) or rest.startswith("m"):
        return None
    return ("s" if letter == "c" else "c") + rest
