"""``kinsym lecture`` as its user meets it, and the page that it writes."""

from __future__ import annotations

import importlib
from dataclasses import replace
from pathlib import Path

import pytest

from kinsym.cli import main
from kinsym.lecture import chapter as chapter_module
from kinsym.lecture import report
from kinsym.lecture.chapter import chapters
from kinsym.lecture.sections import sections

PAGE = Path(__file__).resolve().parent.parent.parent / "docs" / "lecture.md"


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]):  # type: ignore[no-untyped-def]
    """One call; its exit status, output and errors."""

    def call(*arguments: str) -> tuple[int, str, str]:
        status = main(["lecture", *arguments])
        out, err = capsys.readouterr()
        return status, out, err

    return call


def test_one_system(run) -> None:  # type: ignore[no-untyped-def]
    """A line an entry with its number, the mended form of a mistake, and the table, in 80 columns."""
    status, out, _ = run("spherical_wrist")
    assert status == 0
    lines = out.splitlines()
    assert max(map(len, lines)) <= 80
    assert sum("  spherical_wrist  " in line for line in lines) == 10 + 1
    assert "         spherical_wrist       T56               erratum" in lines
    assert "         mended: entry (1,2) = -s6, entry (1,3) = 0, entry (2,2) = c6, entry" in lines
    assert "  total            10       7     3       0     6 of 7" in lines


def test_whole_solutions_are_walked(run) -> None:  # type: ignore[no-untyped-def]
    """The eight solutions of the Fanuc arm are counted, and all branches lead back."""
    status, out, _ = run("fanuc_s900w")
    text = " ".join(out.split())
    assert status == 0
    assert "8 solutions in all branches of theta1, theta3, theta2, theta5, theta4, theta6; each leads back" in text


def test_errata_with_their_reasons(run) -> None:  # type: ignore[no-untyped-def]
    """Both forms and why; other entries are not listed."""
    status, out, _ = run("stanford_screw", "--errata")
    assert status == 0
    assert out.count("because:") == out.count("printed:") == out.count("mended:") == 2
    assert "(2.174)" in out
    assert "2 mistakes among 55 entries" in out


def test_an_unknown_system_names_the_nearest(run) -> None:  # type: ignore[no-untyped-def]
    """The name, a guess and the list; nothing is written."""
    for wrong, guess in (("fanuc", "fanuc_s900w"), ("stanford_srew", "stanford_screw"), ("../x", "")):
        status, out, err = run(wrong)
        assert (status, out) == (2, "")
        assert "the lecture has no system" in err
        assert not guess or f"Did you mean {guess}?" in err


def test_a_system_without_dimensions_says_what_is_missing(run) -> None:  # type: ignore[no-untyped-def]
    """The elbow arm of the first slide has joints and no table."""
    status, out, _ = run("elbow_rrr")
    text = " ".join(out.split())
    assert status == 0
    assert "alpha, a and d of 3 rows are missing" in text
    assert "d1, a2, a3" in text


def test_a_false_entry_ends_with_status_1(run, monkeypatch: pytest.MonkeyPatch) -> None:  # type: ignore[no-untyped-def]
    """An entry that is not accounted for is named, and a way that misses its pose as well."""
    real = next(chapter for chapter in chapters() if chapter.file.startswith("19"))
    broken = replace(
        real,
        entries=tuple(
            replace(entry, printed=real.entry("fk.y").printed) if entry.id == "p_x" else entry for entry in real.entries
        ),
        ways=tuple({**way, "total": 5} for way in real.ways),
    )
    squares = replace(real.entry("squares"), printed=real.entry("expand.x").printed)
    broken = replace(broken, entries=(*broken.entries, replace(squares, printed=replace(squares.printed, members=()))))
    monkeypatch.setattr(report, "chapters", lambda: (broken,))
    monkeypatch.setattr(chapter_module, "chapters", lambda: (broken,))
    status, out, err = run("planar_rrr_paul")
    assert status == 1
    assert "NOT ACCOUNTED FOR" in out
    assert "planar_rrr_paul: chain" in err


def test_the_page_takes_no_system(run) -> None:  # type: ignore[no-untyped-def]
    """--markdown is the whole lecture."""
    status, _, err = run("scara", "--markdown")
    assert status == 2
    assert "Leave out" in err


def test_the_page_is_what_the_command_writes(run) -> None:  # type: ignore[no-untyped-def]
    """docs/lecture.md is up to date: kinsym lecture --markdown > docs/lecture.md."""
    status, out, _ = run("--markdown")
    assert status == 0
    assert out == PAGE.read_text(encoding="utf-8")


def test_sections_cover_every_slide_once() -> None:
    """Every entry belongs to exactly one section."""
    for chapter in chapters():
        for entry in chapter.entries:
            assert sum(section.holds(entry.slide) for section in sections()) == 1, f"{chapter.file} {entry.id}"


def test_sections_name_what_there_is() -> None:
    """Every dotted name can be imported, every command is one of the parser's."""
    for section in sections():
        for name in section.kinsym:
            if name.startswith("kinsym "):
                assert name.split()[1] in ("show", "derive", "lecture", "workspace"), name
            else:
                _find(name)


def _find(name: str) -> object:
    """The object of a dotted name."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            found: object = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            found = getattr(found, part)
        return found
    raise AssertionError(name)
