"""Free text inside source: it stays in its comment or string whatever it holds; and the rest of the banner."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinsym.check.compiler import compile_shared
from kinsym.emit import TARGETS
from kinsym.emit.operations import inverse_operations, line_operations
from kinsym.emit.schedule import Note, Schedule
from kinsym.emit.source.banner import c_comment, python_comment, python_docstring, python_string
from kinsym.emit.source.needs import inverse_needs
from tests.emit.built import needs_compiler, numpy_module
from tests.emit.schedules import assign, planar_2r, puma, solve

NASTY = [
    "*/ int x; /*",
    "**//",
    "ends in a backslash \\",
    "ends in a trigraph ??/",
    "spliced *\\\n/ int x;",
    '""" + __import__("os").getcwd() + """',
    'ends in quotes "',
    'ends in quotes ""',
    "tail \\",
    "\\N{bullet} \\x41 {{ name }} {% raw %}",
    "line\nbreak\r\nand \u2028 others\x00\x0c",
    "right \u202e to left",
    "lone \udc80 surrogate",
    "Grüße, 六軸 Ⓡ",
    "%s %n ${HOME} $(id)",
    "",
]
texts = st.text(max_size=40) | st.text(alphabet='*/\\?"\n #a', max_size=12)


@given(texts)
def test_c_comment_cannot_be_left(text: str) -> None:
    shown = c_comment(text)
    assert "*/" not in shown
    assert "/*" not in shown
    assert "??" not in shown
    assert not shown.endswith("\\")
    assert shown.isprintable()


@given(texts)
def test_python_docstring_cannot_be_left(text: str) -> None:
    module = ast.parse(f'"""{python_docstring(text)}\n{python_docstring(text)}\n"""\nx = 1\n')
    assert len(module.body) == 2


@given(texts)
def test_python_comment_stays_on_its_line(text: str) -> None:
    assert len(ast.parse(f"# {python_comment(text)}\nx = 1\n").body) == 1


@given(st.text())
def test_python_string_is_the_text(text: str) -> None:
    assert ast.literal_eval(python_string(text)) == text


@pytest.mark.parametrize("title", NASTY)
@needs_compiler
def test_titles_of_any_kind(title: str, tmp_path: Path) -> None:
    schedule = planar_2r(title=title)
    schedule = replace(
        schedule,
        table=(*schedule.table, title),
        inverse=(Note(level=0, text=f"{title} {title}"), *schedule.inverse, Note(level=1, text=title)),
    )
    assert title == numpy_module(schedule).TITLE
    for name, text in TARGETS["c"](schedule).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert compile_shared(tmp_path, "planar", tmp_path).is_file()


def test_nothing_that_nobody_reads_is_computed() -> None:
    source = "\n".join(text for target in TARGETS.values() for text in target(puma()).values())
    assert "unread" not in source
    assert "solve_quadratic" not in source
    assert "_quotient" not in source
    assert "theta6 = q[5];" not in TARGETS["c"](puma())["puma.c"].partition("puma_jacobian")[2]


def test_same_bytes() -> None:
    for target in TARGETS.values():
        assert target(puma()) == target(puma())


def test_lines_are_no_longer_than_a_page() -> None:
    for target in TARGETS.values():
        for text in target(puma()).values():
            assert max(map(len, text.splitlines())) <= 120
            assert text.endswith("\n")
            assert not any(line != line.rstrip() for line in text.splitlines())


def test_operations_of_the_planar_arm() -> None:
    schedule = planar_2r()
    # 4 products and 2 sums for p; theta1 + theta2 is printed twice, for the sine and for the cosine.
    assert str(line_operations(schedule, schedule.forward)) == "4 + -, 4 *, 2 sincos"
    # The second elbow has the opposite angle of the first.
    assert (inverse_operations(schedule).atan2, inverse_operations(schedule, shared=False).atan2) == (3, 4)
    assert "4 + -, 4 *, 2 sincos" in TARGETS["c"](schedule)["planar.c"]


def test_a_level_that_is_not_open_is_an_error() -> None:
    schedule = planar_2r()
    for inverse in (
        [*schedule.inverse, *assign(0, "theta1 = 0")],
        [solve(1, "quadratic", "theta1", 2, b="p_x", c="p_y", t="tau"), *assign(2, "theta2 = 0")],
    ):
        with pytest.raises(ValueError, match="levels"):
            inverse_needs(_with(schedule, inverse))


def _with(schedule: Schedule, inverse: list) -> Schedule:
    return replace(schedule, inverse=tuple(inverse))
