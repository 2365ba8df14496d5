"""The section on singular poses of a page."""

from __future__ import annotations

import re
from dataclasses import dataclass

from markupsafe import Markup, escape

from kinsym.emit.html.mathml import operator
from kinsym.emit.html.sentences import Placeholders
from kinsym.emit.html.writer import Writer
from kinsym.emit.prose.singular import (
    FAMILIES,
    angles,
    equations,
    follows,
    heading,
    introduction,
    leading_to,
    remainder,
    shown,
    verdict,
)
from kinsym.kinematics.singular import Condition

_LETTERS = {"det J": r"\det J", "J": "J", "w": "w"}


@dataclass(frozen=True, kw_only=True)
class SingularSection:
    """What the template prints; a condition is its heading and its equations, a family where it is and what it says."""

    introduction: Markup
    determinant: Markup
    verdict: Markup
    conditions: tuple[tuple[str, Markup], ...]
    remainder: tuple[str, ...]
    heading: str
    families: tuple[tuple[Markup, Markup], ...]


def singular_section(writer: Writer) -> SingularSection:
    """The section of a derivation."""
    singular, families = writer.derivation.singular, writer.derivation.families
    held = Placeholders()
    return SingularSection(
        introduction=_in_math(introduction(singular), writer),
        determinant=writer.equation(writer.row(r"\det J"), singular.determinant) if shown(singular) else Markup(""),
        verdict=_in_math(verdict(singular), writer),
        conditions=tuple((heading(condition), _equations(condition, writer)) for condition in singular.listed),
        remainder=remainder(singular),
        heading=FAMILIES,
        families=tuple(
            (
                Markup(", ").join(writer.relation(relation) for relation in family.conditions),
                held.filled(
                    follows(family, lambda tree: held.put(writer.math(tree)), lambda name: held.put(writer.name(name)))
                ),
            )
            for family in families
        ),
    )


def _equations(condition: Condition, writer: Writer) -> Markup:
    held = Placeholders()
    equal = Markup(f" <math>{operator('=')}</math> ")

    def put(text: str) -> Markup:
        return held.filled(text) if text != "0" else Markup("<math><mn>0</mn></math>")

    lines = [put(left) + equal + put(right) for left, right in equations(condition, lambda t: held.put(writer.math(t)))]
    values = angles(condition, lambda tree: held.put(writer.math(tree)))
    if values:
        lines[-1] += Markup(' <span class="note">{} {}</span>').format(leading_to(condition), held.filled(values))
    return Markup("").join(Markup('<p class="eq">{}</p>\n').format(line) for line in lines)


def _in_math(sentence: str, writer: Writer) -> Markup:
    """A sentence with J, det J and w as mathematics."""
    parts = re.split(r"(\bdet J\b|\bJ\b|\bw\b)", sentence)
    return Markup("").join(writer.tex(_LETTERS[part]) if k % 2 else escape(part) for k, part in enumerate(parts))
