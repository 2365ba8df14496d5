"""The section on singular poses of a LaTeX document."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from kinsym.algebra.tree import Tree
from kinsym.emit.latex.layout import PAGE, Block, Relation, aligned
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.passages import Formulas
from kinsym.emit.prose.singular import (
    FAMILIES,
    angles,
    equations,
    family_conditions,
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
class Named:
    """A condition: its name, its geometry and its equations."""

    name: str
    reason: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, kw_only=True)
class SingularSection:
    """What the template prints; each of ``families`` is where it is and what it says."""

    introduction: str
    determinant: tuple[Block, ...]
    verdict: str
    conditions: tuple[Named, ...]
    remainder: tuple[str, ...]
    heading: str
    families: tuple[tuple[str, str], ...]


def singular_section(formulas: Formulas) -> SingularSection:
    """The section of a derivation."""
    singular, families = formulas.derivation.singular, formulas.derivation.families

    def math(tree: Tree) -> str:
        return f"${formulas.formula(tree)}$"

    def name(text: str) -> str:
        return f"${formulas.names[text]}$"

    product = Relation(left=r"\det J", right=formulas.formula(singular.determinant))
    return SingularSection(
        introduction=_in_math(introduction(singular)),
        determinant=aligned([product]) if shown(singular) else (),
        verdict=_in_math(verdict(singular)),
        conditions=tuple(_named(condition, formulas) for condition in singular.listed),
        remainder=remainder(singular),
        heading=FAMILIES,
        families=tuple(
            (family_conditions(family, formulas.formula, apart=r",\; "), follows(family, math, name))
            for family in families
        ),
    )


def _named(condition: Condition, formulas: Formulas) -> Named:
    relations = [
        Relation(left=left, right=right) if width(left) <= PAGE / 2 else Relation(left=right, right=left)
        for left, right in equations(condition, formulas.formula, told=_text)
    ]
    values = angles(condition, formulas.formula, either=_text(" or "))
    if values:
        relations[-1] = replace(
            relations[-1], right=f"{relations[-1].right}, \\qquad {_text(f'{leading_to(condition)} ')} {values}"
        )
    title, _, reason = heading(condition).rpartition(" singularity: ")
    return Named(name=f"{title} singularity" if title else "", reason=reason, blocks=aligned(relations))


def _text(words: str) -> str:
    """Words among formulas."""
    return f"\\text{{{words}}}"


def _in_math(sentence: str) -> str:
    """A sentence with J, det J and w as mathematics."""
    return re.sub(r"\bdet J\b|\bJ\b|\bw\b", lambda found: f"${_LETTERS[found[0]]}$", sentence)
