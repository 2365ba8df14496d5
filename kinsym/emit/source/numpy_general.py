"""What the templates of the general solver read: the solver of an arm without a closed form, in NumPy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kinsym.algebra.tree import ZERO
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.needs import InverseNeeds, held_needs
from kinsym.emit.source.python_text import code, head, names_tuple
from kinsym.emit.source.wrapping import WIDTH, cut
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.general.tables import (
    BORDER_COLUMN,
    BORDER_ROW,
    CHART,
    DESCENT,
    OFFSET,
    STARTS,
    STRIDES,
    arc_table,
    chebyshev_points,
    local_table,
)

#: The parts of the general solver: what opens the loop and follows from a root, what finds roots and polishes.
_LOOP = ("loop", "matrix", "substitution")
_SLIDES = ("slides",)
_SEARCH = ("roots", "isolation", "pivoting", "newton", "descent")
_STILL = ("still",)


def general_names(schedule: Schedule, plan: GeneralPlan, inverse: InverseNeeds, printer: Printer) -> dict[str, Any]:
    """What the solver of an arm without a closed form reads."""
    entries = [
        code(f"links[{number}, {row}, {column}]", printer(value))
        for number, link in enumerate(plan.transforms)
        for (row, column), value in link.places
        if value != ZERO
    ]
    held = held_needs(schedule)
    solved = [place for place, name in enumerate(schedule.solution) if name not in schedule.locked]
    needed, read = ([*(item.name for item in needs.parameters), *needs.inputs] for needs in (inverse, held))
    cuts = plan.cuts or [Cut.before(number) for number in plan.suppressed]
    ways = [(tuple(number - 1 for number in cut.order), cut.backward, cut.shift, cut.bordered) for cut in cuts]
    every = [parameter.name for parameter in schedule.parameters]
    return {
        "parts": ["solve", "closure", *(_SLIDES if plan.suppressed else _LOOP), *_SEARCH, *_STILL[: plan.gate]],
        "two_slides": bool(plan.suppressed),
        "cuts": ways,
        "attempts": tuple((way, nearby) for nearby in (False, True) for way in range(len(ways))),
        "signs": plan.signs,
        "letters": plan.kinds,
        "spin": plan.spin,
        "still": plan.gate,
        "axis": f"np.array([{', '.join(printer(row[2]) for row in plan.links[-1].rotation)}])",
        "columns": "2:" if plan.spin else ":",
        "names_in_order": ", ".join(name for name in schedule.solution if name not in schedule.locked),
        "solved": solved,
        "found": len(plan.kinds) if plan.gate else len(solved),
        "held": held,
        "whole_head": head("_whole", ["q", *read]),
        "whole_of": lambda q: f"_whole({', '.join([q, *looked_up(read)])})",
        "own_parameters": "{name: parameters[name] for name in PARAMETERS}" if schedule.inputs else "parameters",
        "link_entries": entries,
        "links_head": head("_links", needed),
        "link_parameters": names_tuple(needed),
        "blocks_call": [
            "T",
            "reference",
            f"dict({', '.join(f'{name}={name}' for name in every)})",
            *(f"{name}={name}" for name in schedule.inputs),
        ],
        "strides": list(STRIDES),
        "descent_starts": STARTS,
        "descent_passes": DESCENT,
        "offset": OFFSET,
        "chart": CHART,
        "border_column": list(BORDER_COLUMN),
        "border_row": list(BORDER_ROW),
        "arc_table": [_row(row) for row in arc_table()],
        "points": _array(chebyshev_points()),
        "local_table": [_row(row) for row in local_table()],
    }


def looked_up(names: Sequence[str]) -> list[str]:
    """What a function takes from the parameters of the arm."""
    return [f'parameters["{name}"]' for name in names]


def _array(values: Sequence[float]) -> str:
    return f"np.array([{', '.join(map(repr, values))}])"


def _row(values: Sequence[float]) -> str:
    """One row of a table of numbers, on as many lines as it takes."""
    return "\n".join(f"    {part}" for part in cut(f"[{', '.join(map(repr, values))}],", WIDTH - 4))
