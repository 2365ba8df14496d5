"""The section on singular poses for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

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
from kinsym.emit.text.page import Page
from kinsym.inverse.families import Family
from kinsym.kinematics.singular import Condition, SingularSet

#: What stands beside the left side of an equation that is zero.
_BESIDE = 10


def singular_poses(singular: SingularSet, families: Sequence[Family], page: Page | None = None) -> str:
    """det J in factors, what each of them means, and where a joint is free."""
    page = page or Page()
    lines = [page.prose(introduction(singular))] if introduction(singular) else []
    if shown(singular):
        lines.append(page.equation("det J", singular.determinant))
    lines.append(page.prose(verdict(singular)) if verdict(singular) else "")
    parts = ["\n".join(filter(None, lines))]
    parts += ["\n".join(_condition(condition, page)) for condition in singular.listed]
    parts += [page.prose(sentence) for sentence in remainder(singular)]
    if families:
        parts.append("\n".join([page.prose(FAMILIES), *(line for one in families for line in _family(one, page))]))
    return "\n\n".join(parts)


def _condition(condition: Condition, page: Page) -> Iterator[str]:
    yield page.prose(heading(condition))
    relations = [
        page.equation(left, right, indent=6)
        if len(left) + _BESIDE <= page.width
        else page.equation(right, left, indent=6)
        for left, right in equations(condition, page.formula)
    ]
    values = angles(condition, page.formula)
    joints = f"{leading_to(condition)} {values}"
    beside = f"{relations[-1]}, {joints}"
    if values and len(beside) <= page.width:
        relations[-1] = beside
    elif values:
        relations.append(page.prose(joints, indent=6))
    yield from relations


def _family(family: Family, page: Page) -> Iterator[str]:
    yield page.prose(f"{family_conditions(family, page.formula)}:", indent=4)
    yield page.prose(follows(family, page.formula, str), indent=6)
