"""What is written down wrongly is told by file and place, or is not taken for true."""

from __future__ import annotations

from typing import Any

import pytest

from kinsym.errors import KinsymError
from kinsym.lecture.chapter import chapter_of, chapters
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import NotationError, parse_relation
from kinsym.lecture.relation import holds
from kinsym.lecture.residue import Undefined
from kinsym.lecture.verdict import Truth, failed_ways, verdict
from tests.lecture.files import content

PLANAR = "19_planar_rrr_ik.toml"


def changed(file: str, name: str, **fields: Any) -> dict[str, Any]:
    """The content of a file, one entry of which has other fields."""
    raw = content(file)
    next(entry for entry in raw["equation"] if entry["id"] == name).update(fields)
    return raw


@pytest.mark.parametrize(
    ("file", "name", "fields"),
    [
        (PLANAR, "theta2", {"count": 3}),
        (PLANAR, "theta2", {"branches": ["acos(kappa)", "acos(kappa)"]}),
        (PLANAR, "theta2", {"branches": ["acos(kappa)", "pi - acos(kappa)"]}),
        (PLANAR, "theta2", {"right": "2*acos(kappa)"}),
        (PLANAR, "theta2", {"branches": ["acos(kappa)", "acos(phi_of_nothing)"]}),
        (PLANAR, "theta2", {"conditions": [{"when": "abs(kappa) < 1", "solutions": 2, "at": [{"kappa": "2"}]}]}),
        (PLANAR, "theta2", {"conditions": [{"when": "abs(kappa) < 1", "solutions": 1, "at": [{"kappa": "3/5"}]}]}),
        (PLANAR, "theta2", {"conditions": [{"when": "abs(kappa) < 1", "solutions": 2, "at": []}]}),
        (PLANAR, "theta1", {"branches": ["atan(s1/c1)"]}),
        (PLANAR, "kappa", {"equals": "s2"}),
        ("11_scorbot_5r.toml", "table", {"heads": ["i", "theta", "d", "a", "alpha"]}),
    ],
)
def test_a_statement_that_does_not_hold_is_not_true(file: str, name: str, fields: dict[str, Any]) -> None:
    right, wrong = chapter_of(file, content(file)), chapter_of(file, changed(file, name, **fields))
    assert verdict(right, right.entry(name)).accounted
    assert verdict(wrong, wrong.entry(name)).truth is Truth.FALSE


@pytest.mark.parametrize(
    ("branches", "total"),
    [
        (["acos(kappa)", "-acos(kappa)"], 1),
        (["acos(kappa)", "pi - acos(kappa)"], 2),
        (["-acos(kappa)"], 1),
        (["acos(kappa)", "acos(phi_of_nothing)"], 2),
    ],
    ids=["more than claimed", "one that misses the pose", "the known one is lost", "of what nothing is known"],
)
def test_a_way_that_does_not_lead_there_is_told(branches: list[str], total: int) -> None:
    assert failed_ways(chapter_of(PLANAR, content(PLANAR))) == []
    raw = changed(PLANAR, "theta2", branches=branches, count=len(branches))
    raw["way"][0]["total"] = total
    assert failed_ways(chapter_of(PLANAR, raw)) == ["chain"]


def test_a_file_that_cannot_be_read_is_named() -> None:
    """By the file and the entry, or by the text itself, with what to write instead."""
    with pytest.raises(NotationError, match=rf"{PLANAR}, theta2: no kind of entry is called 'guess'\."):
        chapter_of(PLANAR, changed(PLANAR, "theta2", kind="guess"))
    with pytest.raises(NotationError, match=r"'theta2 is free' is no equation. Write left = right or left != right\."):
        chapter_of(PLANAR, changed(PLANAR, "theta2.symmetry", means=["theta2 is free"]))
    with pytest.raises(NotationError, match=r"has no equation 'theta9'. Mend the name\."):
        chapters()[0].entry("theta9")
    raw = content(PLANAR)
    raw["free"] = {"phi_of_nothing": "colour"}
    wrong = chapter_of(PLANAR, raw)
    with pytest.raises(KinsymError, match="a free symbol cannot be a 'colour'"):
        verdict(wrong, wrong.entry("theta2"))


def test_residues_have_no_order() -> None:
    """A condition is decided at numbers, never modulo the prime."""
    condition = parse_relation("1 < 2")
    assert holds(condition, Evaluator({}.__getitem__, exact=True))
    with pytest.raises(Undefined, match="a residue cannot be compared"):
        holds(condition, Evaluator({}.__getitem__))
