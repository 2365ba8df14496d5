"""What was read otherwise than written, as an entry of the report.

The table in the report is the exact one, so that a later ``kinsym check`` cannot find the deviation anew: it is
carried over from report to report.
"""

from __future__ import annotations

from typing import Any

from kinsym.robot.model import Change, Deviation


def recorded(deviation: Deviation) -> dict[str, Any]:
    """The entry: two figures in the table's unit of length and in radians, then one entry a change.

    >>> recorded(Deviation(changes=(), position=1.25e-17, rotation=0.0))
    {'position': '1.2e-17', 'rotation': '0.0e+00', 'changes': []}
    """
    changes = [
        {
            "where": change.where,
            "written": change.written,
            "read_as": change.read_as,
            "difference": f"{change.difference:.1e}",
        }
        for change in deviation.changes
    ]
    return {"position": f"{deviation.position:.1e}", "rotation": f"{deviation.rotation:.1e}", "changes": changes}


def recalled(entry: Any) -> Deviation | None:
    """The deviation of an entry, None for a report without one. Raises KeyError, TypeError, ValueError."""
    if entry is None:
        return None
    changes = tuple(
        Change(
            where=str(change["where"]),
            written=str(change["written"]),
            read_as=str(change["read_as"]),
            difference=float(change["difference"]),
        )
        for change in entry["changes"]
    )
    return Deviation(changes=changes, position=float(entry["position"]), rotation=float(entry["rotation"]))
