"""Does kinsym print an equation of the lecture in the lecture's form?"""

from __future__ import annotations

from enum import Enum
from typing import Any

from kinsym.lecture.case import Case
from kinsym.lecture.chapter import Chapter, Entry
from kinsym.lecture.notation import Apply, Binary, Grid, Name, Node, parse
from kinsym.lecture.printed import Printed, Shapes, row_factors, row_names
from kinsym.lecture.stated import Lecture, equation, special, stated

COUNTED = ("link_transform", "link_transform_inverse", "product", "fk_element", "ik_solution")
"""The kinds of which a share in the printed form is told."""

COMPARED = (
    *COUNTED,
    "screw",
    "loop_closure",
    "ik_intermediate",
    "polynomial_reduction",
    "pieper",
    "frame_terminology",
)
"""The kinds of entries that are compared with kinsym's output where they are equations."""


class Likeness(Enum):
    """How kinsym's output compares with an equation that it reproduces."""

    SAME = "same form"
    OTHER = "other form"
    NONE = "not compared"


def likeness(chapter: Chapter, entry: Entry) -> Likeness:
    """Whether kinsym's output has the form that the lecture prints or, where that is a mistake, means."""
    case = Case(chapter, entry, entry.mended or entry.printed)
    if entry.kind not in COMPARED:
        return Likeness.NONE
    if not case.form.members and entry.kind not in COUNTED:
        return Likeness.NONE
    if chapter.methods and _stated(case):
        return Likeness.SAME
    system = case.system()
    if system is not None and _alike(case, Printed(chapter, system)):
        return Likeness.SAME
    return Likeness.OTHER


def _stated(case: Case) -> bool:
    """Whether one of the lecture's methods, applied to the arm, states the equation: each member with the first."""
    chapter = case.chapter
    arm = special(chapter.shown_by, case.option("given") or {})
    lecture = Lecture(chapter, arm, chapter.aliases)
    known = stated(arm, chapter.methods)
    if not case.form.members:
        return False
    first, *others = (list(lecture.sides(member)) for member in case.form.members)
    if all(any(equation(x, y) in known for x in first for y in other) for other in others):
        return True
    return _stated_by_row(case, lecture, known)


def _stated_by_row(case: Case, lecture: Lecture, known: frozenset[Any]) -> bool:
    """Whether an equation of vectors is stated row by row."""
    left, right = case.form.texts[0], case.form.texts[-1]
    if "_vec" not in left or "_vec" not in right:
        return False
    for row in "xyz":
        sides = [list(lecture.sides(parse(text.replace("_vec", f"_{row}")))) for text in (left, right)]
        if not any(equation(x, y) in known for x in sides[0] for y in sides[1]):
            return False
    return True


def _alike(case: Case, printed: Printed) -> bool:
    members = case.form.members
    for member in members:
        shown = printed.find(member)
        if shown is None:
            continue
        others = [other for other in members if other is not member]
        if all(_same(case, printed, member, shown, other) for other in others):
            return True
    return False


def _same(case: Case, printed: Printed, member: Node, shown: Shapes, other: Node) -> bool:
    if shown == printed.find(other) or _same_cells(printed, shown, other):
        return True
    links = printed.links_of(member)
    if links is not None and printed.links_of(other) == links:
        return True
    if case.form.factors and other is case.form.members[-1]:
        return _same_factors(case, printed, links)
    one = links is not None and len(links) == 1
    return one and _applied(case.chapter, other) in row_names(printed.system, links[0] if links else 0)


def _same_cells(printed: Printed, shown: Shapes, other: Node) -> bool:
    """Cell by cell what is printed; a cell may be the name that the lecture gives this entry."""
    written = printed.written(other)
    if written is None or [len(row) for row in written] != [len(row) for row in shown]:
        return False
    rows = other.rows if isinstance(other, Grid) else ((other,),)
    return all(
        cell == entry or printed.find(node) == ((entry,),)
        for nodes, cells, entries in zip(rows, written, shown, strict=True)
        for node, cell, entry in zip(nodes, cells, entries, strict=True)
    )


def _same_factors(case: Case, printed: Printed, links: tuple[int, ...] | None) -> bool:
    """Every printed factor is the link it stands for or, of one link, the elementary transform."""
    factors = [printed.written(factor) for factor in case.form.factors]
    names = case.option("each")
    if names:
        return factors == [printed.find(Name(text)) for text in names]
    return links is not None and len(links) == 1 and tuple(factors) in row_factors(printed.system, links[0])


def _applied(chapter: Chapter, node: Node) -> tuple[tuple[str, ...], ...] | None:
    """A product of elementary transforms as their names, each with its arguments; None for any other formula."""
    match node:
        case Name(text) if text in chapter.names:
            return _applied(chapter, chapter.names[text])
        case Apply(function, arguments):
            names = tuple(cell.name for cell in arguments if isinstance(cell, Name))
            return ((function, *names),)
        case Binary("*", left, right):
            before, after = _applied(chapter, left), _applied(chapter, right)
            return None if before is None or after is None else before + after
        case _:
            return None
