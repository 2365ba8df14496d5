"""What the C templates of the general six-joint solver are filled in with: the arm, its cuts, the constant tables."""

from __future__ import annotations

from collections.abc import Iterable
from math import comb
from typing import Any

from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.needs import held_needs
from kinsym.emit.source.wrapping import WIDTH, cut
from kinsym.general import tables
from kinsym.general.plan import Cut, GeneralPlan, Link

#: The parts of the solver in the order in which they are printed, one template each. What opens the loop and comes
#: back from a root differs for arms with two joints that slide; the search for roots and Newton's method do not.
_BEFORE = ("links", "motion", "arm", "loop")
_LOOP = ("states", "equations", "determinant")
_BACK = ("kernel", "substitute")
_ROOTS = ("isolate", "resample", "circle")
_AFTER = ("polish", "collect", "descend", "eliminate")


def parts(kinds: str, gate: bool = False) -> tuple[str, ...]:
    """The templates for an arm, by the kinds of its joints and whether the sixth has to stand still.

    >>> parts("RRPRPR")[4:6]
    ('two_slides', 'isolate')
    """
    after = (*_AFTER, *(("still", "solve") if gate else ("solve",)))
    if kinds.count("P") == 2:
        return (*_BEFORE, "two_slides", *_ROOTS, *after)
    return (*_BEFORE, *_LOOP, *_ROOTS, *_BACK, *after)


def general_names(schedule: Schedule, plan: GeneralPlan, printer: Printer) -> dict[str, Any]:
    """The names that the templates in c/general read."""
    return {
        "parts": [f"c/general/{part}.c.jinja" for part in parts(plan.kinds, plan.gate)],
        "sliding": [int(kind == "P") for kind in plan.kinds],
        "signs": [f"{sign}.0" for sign in plan.signs],
        "links": [_link(link, printer) for link in plan.transforms],
        "cuts": [_cut(item) for item in plan.cuts] or [_round(number) for number in plan.suppressed[:2]],
        "solved": [place for place, name in enumerate(schedule.solution) if name not in schedule.locked],
        "held": held_needs(schedule),
        "tables": _tables(),
    }


def _link(link: Link, printer: Printer) -> list[str]:
    """A constant motion as an initialiser: rotation, then translation."""
    rotation = ", ".join(printer(entry) for row in link.rotation for entry in row)
    translation = ", ".join(printer(entry) for entry in link.translation)
    return cut(f"{{{{{rotation}}}, {{{translation}}}}},", WIDTH - 8)


def _cut(item: Cut) -> str:
    order = ", ".join(str(number - 1) for number in item.order)
    return f"{{{{{order}}}, {int(item.backward)}, {int(item.shift)}, {int(item.bordered)}}}"


def _round(suppressed: int) -> str:
    """A way round a loop with two joints that slide: it begins two joints before the suppressed one."""
    order = ", ".join(str((suppressed - 3 + k) % 6) for k in range(6))
    return f"{{{{{order}}}, 0, 0, 0}}"


def _tables() -> dict[str, Any]:
    """The constant tables in lines that fit; a single number is its text."""
    turn = tables.turns(tables.SAMPLES)
    eighth = tables.turns(tables.ARCS)
    start, chart = tables.direction(tables.OFFSET), tables.direction(tables.CHART)
    return {
        "border_column": _lines(tables.BORDER_COLUMN),
        "border_row": _lines(tables.BORDER_ROW),
        "binomial_arc": _lines(float(comb(2 * tables.DEGREE, k)) for k in range(2 * tables.DEGREE + 1)),
        "binomial_local": _lines(float(comb(tables.LOCAL, k)) for k in range(tables.LOCAL + 1)),
        "chebyshev": _lines(tables.chebyshev_points()),
        "to_local": [line for row in tables.local_table() for line in _lines(row)],
        "strides": _lines(tables.STRIDES),
        "starts": str(tables.STARTS),
        "descent": str(tables.DESCENT),
        "start": repr(tables.OFFSET),
        "start_cos": repr(start[0]),
        "start_sin": repr(start[1]),
        "chart": repr(tables.CHART),
        "chart_cos": repr(chart[0]),
        "chart_sin": repr(chart[1]),
        "cos17": _lines(c for c, _ in turn),
        "sin17": _lines(s for _, s in turn),
        "cos8": _lines(c for c, _ in eighth),
        "arc_end": repr(tables.arc_end()),
        "to_arc": [line for row in tables.arc_table()[: tables.DEGREE + 1] for line in _lines(row)],
    }


def _lines(values: Iterable[float]) -> list[str]:
    """Numbers with a comma behind each, on as many lines as it takes."""
    return cut(", ".join(map(repr, values)) + ",", WIDTH - 4)
