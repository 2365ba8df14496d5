"""The table of solutions of a page, in the tree of branches that leads to them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from markupsafe import Markup

from kinsym.emit.html.mathml import math as in_math
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names
from kinsym.emit.prose.wording import branch_rows, branchings
from kinsym.page.shown import Shown

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

#: How far a joint may lie outside its limits, in radians or the unit of length.
_WITHIN = 1e-9


@dataclass(frozen=True, kw_only=True)
class Row:
    """One solution in the table: its place in the tree of branches and its joint values, None where it is not real.

    ``forks`` are the cells of branching steps that begin here, each a mark and how many rows it holds for. A value has
    its text and whether it lies beyond the limits of its joint.
    """

    branch: int
    name: str
    forks: tuple[tuple[str, int], ...]
    values: tuple[tuple[str, bool], ...] | None
    current: bool


def forks(derivation: Derivation) -> list[tuple[int, Markup]]:
    """The branching steps: number and unknown."""
    if derivation.plan is None:
        return []
    return [(fork.number, in_math(mathml(Names([fork.unknown])[fork.unknown]))) for fork in branchings(derivation.plan)]


def rows(derivation: Derivation, shown: Shown) -> list[Row]:
    """A row for each branch of a closed form, for each solution of the general solver."""
    found = {solution.branch: solution.q for solution in shown.solutions}
    if derivation.plan is None:
        return [_row(shown, number, "", (), q) for number, q in found.items()]
    steps = branchings(derivation.plan)
    table = []
    for number, (_, marks) in enumerate(branch_rows(derivation.plan)):
        begins = tuple(
            (mark.replace("-", "−"), fork.run)
            for fork, mark in zip(steps, marks, strict=True)
            if number % fork.run == 0
        )
        names = derivation.branches.names
        table.append(_row(shown, number, names[number] if number < len(names) else "", begins, found.get(number)))
    return table


def _row(shown: Shown, branch: int, name: str, forks: tuple[tuple[str, int], ...], q: tuple[float, ...] | None) -> Row:
    values = None
    if q is not None:
        values = tuple(
            (
                _shown(math.degrees(value), 2) + "°" if kind == "R" else _shown(value, 4),
                _beyond(kind, value, *map(float, limits)),
            )
            for kind, value, limits in zip(shown.shape.kinds, q, shown.shape.limits, strict=True)
        )
    return Row(branch=branch, name=name, forks=forks, values=values, current=q is not None and is_current(shown, q))


def _shown(value: float, places: int) -> str:
    """A number with a proper minus sign and no negative zero."""
    return f"{round(value, places) + 0.0:.{places}f}".replace("-", "−")


def _beyond(kind: str, value: float, low: float, high: float) -> bool:
    """Whether a joint value lies outside the limits, whatever whole turns are added to an angle.

    >>> _beyond("R", -3.0, 2.0, 4.0), _beyond("P", -3.0, 2.0, 4.0)
    (False, True)
    """
    if unbounded(low, high):
        return False
    if kind == "R":
        value += 2 * math.pi * math.ceil((low - _WITHIN - value) / (2 * math.pi))
    return not low - _WITHIN <= value <= high + _WITHIN


def unbounded(low: float, high: float) -> bool:
    """Whether a joint has no limits."""
    return math.isinf(low) and math.isinf(high)


def is_current(shown: Shown, q: tuple[float, ...]) -> bool:
    """Whether a joint vector is the posture of the page, whole turns aside."""
    for kind, value, other in zip(shown.shape.kinds, q, shown.q, strict=True):
        apart = math.remainder(value - other, 2 * math.pi) if kind == "R" else (value - other) / shown.shape.size
        if abs(apart) > 1e-6:
            return False
    return True
