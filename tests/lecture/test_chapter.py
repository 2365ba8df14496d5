"""The lecture as one LaTeX document: complete, its numbers at the right equations, and set within its margins."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from kinsym.emit.latex.sentences import escape
from kinsym.lecture.chapter import chapters
from kinsym.lecture.latex import chapter_document
from kinsym.lecture.latex.notation import LecturePrinter
from kinsym.lecture.latex.places import place_of, stated_in
from kinsym.lecture.latex.shown import Shown, derived, shown
from kinsym.lecture.notation import NotationError, parse
from kinsym.lecture.sections import further, sections
from kinsym.lecture.told import markdown, plain
from kinsym.lecture.verdict import Truth, Verdict, verdicts
from tests.compiled import compile_twice, needs_pdflatex


@cache
def found() -> tuple[Verdict, ...]:
    return tuple(verdicts())


@cache
def chapter() -> str:
    return chapter_document(found())


@needs_pdflatex
def test_it_compiles_within_its_margins(tmp_path: Path) -> None:
    log = compile_twice(chapter(), tmp_path)
    assert "Font Warning" not in log


def test_the_same_bytes_in_another_process_with_another_hash_seed() -> None:
    root = Path(__file__).resolve().parents[2]
    code = (
        "from kinsym.lecture.latex import chapter_document; from kinsym.lecture.verdict import verdicts;"
        "print(chapter_document(list(verdicts())), end='')"
    )
    other = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONHASHSEED": "4242", "PYTHONPATH": str(root)},
        cwd=root,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert other == chapter()


def test_it_holds_every_section_every_number_and_every_mistake() -> None:
    text = chapter()
    for section in sections():
        assert escape(section.title).replace("Denavit-Hartenberg", "Denavit--Hartenberg") in text
    printed = {number for group in re.findall(r"\\lecture\{([^}]*)\}", text) for number in group.split(", ")}
    printed |= set(re.findall(r"\\eqref\{[^}]*\}~\{\\footnotesize\[([^]]*)\]\}", text))
    assert printed == {verdict.entry.number for verdict in found()} - {""}
    mistakes = [verdict for verdict in found() if verdict.truth is Truth.ERRATUM]
    labels = [f"erratum:{v.chapter.file.removesuffix('.toml')}:{v.entry.id}" for v in mistakes]
    assert len(labels) == 28
    for label in labels:
        assert text.count(f"\\label{{{label}}}") == 1
        assert f"\\ref{{{label}}}" in text
    conditions = sum("unstated" in verdict.entry.printed.options for verdict in found())
    assert text.count("\\begin{condition}") == conditions == 6


def test_every_line_of_the_lecture_is_on_the_page() -> None:
    """An entry is stated by a derivation, or stands in its own form among what the slides hold beside it."""
    text, printer = re.sub(r"\s+", " ", chapter()), LecturePrinter()
    derivations = [one for section in sections() for one in shown(section.derivations)]
    stated = [(one, stated_in(one)) for one in derivations]
    for verdict in found():
        form = verdict.entry.printed
        if verdict.truth is Truth.ERRATUM or not (form.members or form.claim):
            continue
        if any(place_of(verdict, one, equations) for one, equations in stated):
            continue
        shown_as = printer.told(form.claim)[1:] if form.claim else printer(form.members[0])
        assert re.sub(r"\s+", " ", shown_as) in text, (verdict.chapter.file, verdict.entry.id)


def test_every_system_is_derived_and_every_arm_solved() -> None:
    derivations = [one for part in (*sections(), *further()) for one in shown(part.derivations)]
    assert {one.arm.robot.name for one in derivations} >= {c.robot for c in chapters() if c.robot} - {"screw_link"}
    assert any(one.derivation.robot == "screw_link" for one in derivations)
    solved = {one.derivation.robot for one in derivations if _solves(one)}
    arms = {one.derivation.robot for one in derivations if one.robot is not None}
    # three planar arms that are one: the lecture solves it as planar_rrr_paul and planar_rrr_craig
    assert arms - solved == {"planar_rrr_geometric", "planar_rrr_screw"}


def _solves(one: Shown) -> bool:
    unknowns = {solution.unknown for solution in one.derivation.solutions}
    return one.robot is not None and unknowns >= {*one.robot.variables}


@pytest.mark.parametrize(
    ("file", "entry", "robot", "method", "name"),
    [
        ("23_fanuc_s900w.toml", "2.82", "fanuc_s900w", "decoupled", "loop.y"),
        ("12_stanford_paul.toml", "fk.r11", "stanford_paul", "paul", "u_x"),
        ("12_stanford_paul.toml", "A2", "stanford_paul", "paul", "T_1_2"),
        ("13_screw_general.toml", "p_x", "screw_link", "general_screw", "A"),
        ("14_planar_rrr_screw.toml", "home.u0", "planar_rrr_screw", "screws", "u0"),
        ("23_fanuc_s900w.toml", "2.82", "fanuc_s900w", "paul", ""),
    ],
)
def test_places(file: str, entry: str, robot: str, method: str, name: str) -> None:
    verdict = next(v for v in found() if v.chapter.file == file and v.entry.id == entry)
    one = derived(robot, method)
    assert place_of(verdict, one, stated_in(one)) == name


def test_the_general_screw_is_printed_once() -> None:
    text = chapter()
    assert text.count("\\label{screw_link:screws:A}") == 1
    assert text.count("Put into the general displacement, \\eqref{screw_link:screws:A}") == 3


@pytest.mark.parametrize(
    ("source", "latex"),
    [
        ("-(a + b)", "-(a + b)"),
        ("1 - c2", "1 - c_{2}"),
        ("x*(a + b)/2", r"\frac{x (a + b)}{2}"),
        ("kappa1 + pm*sqrt(kappa2)", r"\kappa_{1} \pm \sqrt{\kappa_{2}}"),
        ("transpose(R3)*w_vec", r"R_{3}^{T} \vec{w}"),
        ("T_0_1[:3, 3]", r"\bigl({}^{0}T_{1}\bigr)_{4}"),
        ("cos(deg(180) - theta2)", r"\cos(180^{\circ} - \theta_{2})"),
    ],
)
def test_the_lectures_notation(source: str, latex: str) -> None:
    assert LecturePrinter()(parse(source)) == latex


def test_what_has_no_printed_form_is_refused() -> None:
    with pytest.raises(NotationError, match="no printed form"):
        LecturePrinter()(parse("unit(3)"))


def test_sentences() -> None:
    assert plain("`a_1 != 0` here") == "a_1 != 0 here"
    assert markdown("`a|b*c` and a|b*c_1") == "`a\\|b*c` and a\\|b\\*c\\_1"
    told = LecturePrinter().told("50 % of `s_1 <= 2`, `[u v w]` & more")
    assert told == r"50 \% of $s_{1} \le 2$, $[u \; v \; w]$ \& more"
