"""The costs by which the search prefers one rule to another are those that the documentation tells."""

from __future__ import annotations

import re
from pathlib import Path

from kinsym.inverse.rules import LAST_RULES, RULES

PAGE = Path(__file__).resolve().parents[2] / "docs" / "architecture.md"


def documented() -> list[int]:
    """The last column of the table of rules."""
    _, _, table = PAGE.read_text(encoding="utf-8").partition("| rule | shape | branches | cost |\n")
    rows = table.partition("\n\n")[0].splitlines()[1:]
    return [int(number) for row in rows for number in re.findall(r"\d+", row.rstrip(" |").rpartition("|")[2])]


def costs(rules: tuple[object, ...]) -> list[int]:
    """The costs that modules of rules name."""
    return [value for rule in rules for name, value in vars(rule).items() if name.endswith("COST")]


def test_costs_are_those_of_the_table() -> None:
    assert sorted(costs((*RULES, *LAST_RULES))) == sorted(documented())


def test_the_rules_that_are_asked_last_are_the_dearest() -> None:
    assert max(costs(RULES)) < min(costs(LAST_RULES))
