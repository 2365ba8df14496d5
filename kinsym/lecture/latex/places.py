"""Where kinsym's derivation of a section states what the lecture does: the lecture's numbers beside ours.

An entry belongs to the equation that has both its sides. Where the lecture has another name for the left side (r11 for
u_x, A1 for T_0_1), one of its formulas is enough; and a formula may be an entry of a matrix.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from kinsym.lecture.latex.shown import Shown
from kinsym.lecture.shape import NoShape
from kinsym.lecture.stated import Form, Lecture, equation, side_form
from kinsym.lecture.verdict import Verdict
from kinsym.methods.document import TRANSPOSE, Equation, Factor, Matrix, Product, Side

_PLAIN = ("name", "number", "cos", "sin")


@dataclass(frozen=True)
class Stated:
    """An equation of a derivation with the forms of its sides, and of the entries of its matrices."""

    name: str
    both: object
    sides: tuple[Form, ...]
    cells: frozenset[Form]


def stated_in(one: Shown) -> tuple[Stated, ...]:
    """The equations of a derivation that can be compared."""
    result = []
    for item in one.derivation.equations:
        if item.sign != "=":
            continue
        left, right = _upright(item)
        try:
            forms = side_form(left, one.names), side_form(right, one.names)
        except NoShape:
            continue
        cells = (("scalar", cell) for form in forms if form[0] == "matrix" for row in form[1] for cell in row)
        result.append(Stated(item.name, equation(*forms), forms, frozenset(filter(_tells, cells))))
    return tuple(result)


def _upright(item: Equation) -> tuple[Side, Side]:
    """Both sides; a column that is printed as a row stands upright again."""
    match item.left, item.right:
        case Product((Factor(name, mark),)), Matrix((row,)) if mark == TRANSPOSE:
            return Product((Factor(name),)), Matrix(tuple((cell,) for cell in row))
    return item.left, item.right


def place_of(verdict: Verdict, one: Shown, equations: Sequence[Stated]) -> str:
    """The name of the equation that says what an entry of the lecture says; empty where none does."""
    form = verdict.entry.mended or verdict.entry.printed
    if form.claim:
        return ""
    lecture = Lecture(verdict.chapter, one.arm, verdict.chapter.aliases)
    sides = [list(lecture.sides(member)) for member in form.members]
    return next(_found(sides, equations), "")


def _found(sides: Sequence[Sequence[Form]], equations: Sequence[Stated]) -> Iterator[str]:
    """Equations with both sides of an entry, then those with one, then those with an entry of a matrix."""
    pairs = {equation(x, y) for one, other in combinations(sides, 2) for x in one for y in other}
    telling = {form for members in sides for form in members if _tells(form)}
    yield from (item.name for item in equations if item.both in pairs)
    yield from (item.name for item in equations if telling & {*item.sides})
    yield from (item.name for item in equations if telling & item.cells)


def _tells(form: Form) -> bool:
    """Whether a form is more than a name, a number or a single cosine."""
    if form[0] == "scalar":
        return form[1][1][0] not in _PLAIN
    return form[0] == "matrix" or len(form[1]) > 1
