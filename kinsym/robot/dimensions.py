"""A system that names its joints and gives no dimensions, as the elbow arm at the beginning of the lecture."""

from __future__ import annotations

from collections.abc import Mapping

from kinsym.errors import RobotError
from kinsym.robot.rows import COLUMNS, SCREW_COLUMNS

_TOLD = frozenset({"type", "variable", "limits", "i"})
"""What a row may say without giving a dimension."""


def check_dimensions(draft: Mapping[str, object], where: str) -> None:
    """Raise RobotError where no row of a table has a cell; the message says which rows lack what.

    A row that has some of its cells is judged when it is read.
    """
    rows = draft.get("joints")
    if not isinstance(rows, list) or not rows:
        return
    if not all(isinstance(row, Mapping) and row and set(row) <= _TOLD for row in rows):
        return
    names = [row.get("variable") for row in rows]
    listed = ", ".join(name if isinstance(name, str) and name.isidentifier() else "?" for name in names)
    numbers = "row 1 lacks" if len(rows) == 1 else f"rows 1 to {len(rows)} lack"
    raise RobotError(
        f"the system has no dimensions: it names the joints {listed}, and {numbers} {', '.join(COLUMNS)}",
        where=where,
        remedy=f"Write these cells of each row, or {' and '.join(SCREW_COLUMNS)} of each with a [home] pose; "
        f'a name such as "a2" will do where there is no number.',
    )
