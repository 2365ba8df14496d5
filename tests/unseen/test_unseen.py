"""A few arms of the hardest classes pass their checks; what fails or raises is told."""

from __future__ import annotations

import pytest

from kinsym.errors import KinsymError
from tests.emit.built import needs_compiler
from tests.unseen import measure
from tests.unseen.__main__ import section
from tests.unseen.measure import Outcome, outcome


@needs_compiler
@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("three axes meet, 1-3", 0),
        ("three axes parallel, 4-6", 1),
        ("three slides anywhere", 1),
        ("two slides anywhere", 2),
        ("five joints, task that fits", 3),
    ],
)
def test_no_law_fails(name: str, number: int) -> None:
    found = outcome((name, number, 77))
    assert found.laws > 50
    assert not found.failed


def test_what_is_raised_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(robot: object) -> None:
        raise KinsymError("no")

    monkeypatch.setattr(measure, "derive", refuse)
    assert outcome(("SCARA and wrist", 0, 1)) == Outcome("SCARA and wrist", 0, 0, ("KinsymError: no",))


def test_the_page_names_what_failed() -> None:
    text = section([Outcome("a", 0, 60, ()), Outcome("a", 1, 60, ("law: 1 of 2",)), Outcome("b", 0, 50, ())], "python")
    assert "| a | 2 | 120 | 1 |" in text
    assert "| b | 1 | 50 | 0 |" in text
    assert "In all 3 arms, 1 with a law that failed." in text
    assert text[-1] == "* a, 1: law: 1 of 2"
