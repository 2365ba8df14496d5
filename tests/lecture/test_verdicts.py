"""Every entry of the lecture is accounted for, and a slip in any of them is seen."""

from __future__ import annotations

import random
from collections import Counter
from dataclasses import replace

import pytest

from kinsym.lecture import verdicts
from kinsym.lecture.chapter import Chapter, Entry, chapter_of, chapters
from kinsym.lecture.form import COUNTED, Likeness
from kinsym.lecture.verdict import Truth, Verdict, failed_ways, verdict
from kinsym.robot.files import RobotError
from tests.lecture.files import FILES, content
from tests.lecture.flips import slips_of

SLIPS_AN_ENTRY = 2


@pytest.fixture(scope="module")
def found() -> list[Verdict]:
    """The verdicts on the whole lecture."""
    return list(verdicts())


def test_every_entry_is_accounted_for(found: list[Verdict]) -> None:
    """The chapter has 444 entries, 28 of them mistakes (counted by hand when it was typed)."""
    assert [f"{v.chapter.file} {v.entry.id}: {v.why}" for v in found if not v.accounted] == []
    assert Counter(v.truth for v in found) == {Truth.TRUE: 416, Truth.ERRATUM: 28}


def test_every_way_leads_to_the_pose() -> None:
    """The five whole solutions: two for planar RRR, four for a wrist point, eight for six joints."""
    totals = [way["total"] for chapter in chapters() for way in chapter.ways]
    assert totals == [2, 4, 8, 8, 8]
    assert [failed for chapter in chapters() for failed in failed_ways(chapter)] == []


def test_a_way_with_another_number_of_solutions_fails() -> None:
    """The number of solutions is counted."""
    chapter = next(chapter for chapter in chapters() if chapter.ways)
    wrong = replace(chapter, ways=tuple({**way, "total": 4} for way in chapter.ways))
    assert failed_ways(wrong) == ["chain"]


def test_nine_in_ten_are_printed_alike(found: list[Verdict]) -> None:
    """Of transforms, products, forward kinematics and solutions; every other form has its reason."""
    counted = [v for v in found if v.entry.kind in COUNTED and v.likeness is not Likeness.NONE]
    alike = [v for v in counted if v.likeness is Likeness.SAME]
    assert len(counted) == 136
    assert len(alike) >= 0.9 * len(counted)
    assert [v.entry.id for v in found if v.likeness is Likeness.OTHER and not v.entry.instead] == []


@pytest.mark.parametrize(
    ("file", "name", "written"),
    [
        ("12_stanford_paul.toml", "fk.r13", "c1*c2*c4*s5 + c1*s2*c5 - s1*s4*s5"),
        ("11_scorbot_5r.toml", "fk.q_x", "a1*c1 + c1*(a2*c2 + a3*c23 - d5*s234)"),
        ("02_planar_rr.toml", "fk.x", "l1*c1 + l2*(c1*c2 - s1*s2)"),
        ("19_planar_rrr_ik.toml", "kappa", "(p_x**2 + p_y**2)/(2*a1*a2) - (a1**2 + a2**2)/(2*a1*a2)"),
    ],
)
def test_another_form_is_seen(file: str, name: str, written: str) -> None:
    """The same value multiplied out, or written with other angles, is true and not in the printed form."""
    raw = content(file)
    number = next(n for n, entry in enumerate(raw["equation"]) if entry["id"] == name)
    key = (
        "left" if "right" in raw["equation"][number] and raw["equation"][number]["right"] in ("x_e", "y_e") else "right"
    )
    plain = chapter_of(file, raw)
    assert verdict(plain, plain.entries[number]).likeness is Likeness.SAME
    raw["equation"][number][key] = written
    other = chapter_of(file, raw)
    seen = verdict(other, other.entries[number])
    assert (seen.truth, seen.likeness) == (Truth.TRUE, Likeness.OTHER)


@pytest.mark.parametrize("file", FILES)
def test_slips_of_sign_are_seen(file: str) -> None:
    """Two slips in each entry, picked at random with a fixed seed: none of them leaves the entry accounted for."""
    raw = content(file)
    generator = random.Random(file)
    missed = []
    entries = raw["equation"]
    plain = chapter_of(file, raw)
    for number, entry in enumerate(entries):
        found = list(slips_of(plain, raw, number))
        for slip in generator.sample(found, min(SLIPS_AN_ENTRY, len(found))):
            chapter = slip.chapter(file, raw)
            try:
                accounted = verdict(chapter, chapter.entries[number]).accounted
            except RobotError:
                accounted = False  # a cell of a table that cannot be read
            if accounted:
                missed.append(f"{entry['id']}: {slip.before} -> {slip.after}")
    assert missed == []


def test_most_entries_can_have_a_slip_of_sign() -> None:
    """The test above turns signs in all but the sentences, which hold no sign."""
    without = 0
    for file in FILES:
        raw = content(file)
        plain = chapter_of(file, raw)
        without += sum(not any(True for _ in slips_of(plain, raw, n)) for n in range(len(plain.entries)))
    assert without <= 45


def errata() -> list[tuple[Chapter, Entry]]:
    """The entries with two forms."""
    return [(chapter, entry) for chapter in chapters() for entry in chapter.entries if entry.mended is not None]


def test_a_mistake_is_found_and_not_believed() -> None:
    """The two forms changed over, the mended one twice, or the printed one twice: all of that is seen."""
    for chapter, entry in errata():
        assert entry.mended is not None
        assert verdict(chapter, replace(entry, printed=entry.mended, mended=entry.printed)).truth is Truth.FALSE
        assert verdict(chapter, replace(entry, printed=entry.mended)).truth is Truth.FALSE
        assert verdict(chapter, replace(entry, mended=entry.printed)).truth is Truth.FALSE
        assert verdict(chapter, replace(entry, mended=None)).truth is Truth.FALSE


def test_an_entry_that_asks_for_nothing_is_not_true() -> None:
    """A sentence that no test decides is not taken for true."""
    chapter = chapters()[0]
    entry = chapter.entries[0]
    empty = replace(entry, check="identity", printed=replace(entry.printed, members=(), options={}))
    assert verdict(chapter, empty).truth is Truth.FALSE
