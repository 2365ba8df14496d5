"""The singular poses as an entry of the report: read off the schedule, whether anything is checked or not."""

from __future__ import annotations

from typing import Any

from kinsym.emit.prose.singular import family_conditions
from kinsym.emit.schedule import Schedule
from kinsym.emit.text.formula import TextPrinter


def singular_figures(schedule: Schedule) -> dict[str, Any]:
    """The singular poses as the report holds them."""
    if schedule.singular is None:
        return {}
    write = TextPrinter(ascii=True)
    singular, families = schedule.singular.set, schedule.singular.families
    return {
        "determinant": write(singular.determinant) if singular.square else None,
        "all_known": singular.exhaustive,
        "conditions": [
            {
                "name": condition.meaning.name,
                "zero": [write(value) for value in condition.values],
                "meaning": condition.meaning.reason,
            }
            for condition in singular.listed
        ],
        "families": [
            {
                "where": family_conditions(family, write),
                "free": family.free,
                "constant": [write(tree) for tree in family.constant],
                "follows": list(family.follows),
                "equal_links_folded": family.folded,
            }
            for family in families
        ],
    }
