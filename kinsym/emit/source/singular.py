"""Singular poses in the comments of generated code: what is singular, and which joint is then free."""

from __future__ import annotations

import textwrap

from kinsym.emit.prose.singular import equations, family_conditions, follows, heading, remainder
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.wrapping import WIDTH
from kinsym.emit.text.formula import TextPrinter

_MARGIN = 4


def singular_lines(schedule: Schedule) -> list[str]:
    """The lines of the comment, not yet escaped for a language; none where the arm has no singular pose."""
    if schedule.singular is None:
        return []
    write = TextPrinter(ascii=True)
    singular, families = schedule.singular.set, schedule.singular.families
    lines = ["Singular poses:"] if singular.listed else []
    for condition in singular.listed:
        zero = " and ".join(f"{left} = {right}" for left, right in equations(condition, write))
        lines += _item(f"{zero}: {_lower(heading(condition))}.")
    for sentence in remainder(singular):
        lines += _item(sentence)
    lines += ["Families of solutions; a free joint takes its value in the reference:"] if families else []
    for family in families:
        lines += _item(f"{family_conditions(family, write)}: {follows(family, write, str)}.")
    return lines


def _lower(text: str) -> str:
    return text[:1].lower() + text[1:]


def _item(text: str) -> list[str]:
    indent = " " * _MARGIN
    return textwrap.wrap(
        text,
        WIDTH - _MARGIN,
        initial_indent="  ",
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )
