"""Is an entry of the lecture true? Printed and mended forms are decided by the same tests."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from enum import Enum

from kinsym.lecture import identities, solutions, structure, tables, workspaces
from kinsym.lecture.case import Case
from kinsym.lecture.chapter import Chapter, Entry, Form, chapters
from kinsym.lecture.form import Likeness, likeness
from kinsym.lecture.notation import Name
from kinsym.lecture.residue import Undefined

Test = Callable[[Case], bool]

WHOLE: dict[str, Test] = {
    "identity": identities.identity,
    "joint_vector": tables.joint_vector,
    "task_vector": tables.task_vector,
    "table": tables.table,
    "solution": solutions.solution,
}
"""What decides the equation of an entry, by its ``check``."""

ASKED: dict[str, Test] = {
    "each": identities.each,
    "multiple_of": identities.multiple_of,
    "free_of": identities.free_of,
    "moved_by": identities.moved_by,
    "degree": identities.degree,
    "closes": identities.closes,
    "same_pose": identities.same_pose,
    "equals": identities.special_value,
    "varying": structure.varying,
    "rank": structure.rank,
    "solves": structure.solves,
    "divides": structure.divides,
    "variables": tables.variables,
    "twists": tables.twists,
    "unknowns": tables.unknowns,
    "ways": solutions.ways,
    "reach": workspaces.reach,
    "reachable": workspaces.reachable,
    "dexterous": workspaces.dexterous,
    "dexterous_none": workspaces.dexterous_none,
    "exists": workspaces.exists,
}
"""What else an entry's data asks for."""


class Truth(Enum):
    """What was found of an entry."""

    TRUE = "true"
    ERRATUM = "erratum"
    FALSE = "false"


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was found of one entry: whether it is true, and whether kinsym prints it so.

    ``why`` says what is wrong where the entry is not accounted for.
    """

    chapter: Chapter
    entry: Entry
    truth: Truth
    likeness: Likeness
    why: str = ""

    @property
    def accounted(self) -> bool:
        """Whether the entry is true, or an erratum whose mended form is."""
        return self.truth is not Truth.FALSE


def verdicts(chosen: Iterable[Chapter] | None = None) -> Iterator[Verdict]:
    """The verdicts on all entries of some chapters (default: of all), in order."""
    for chapter in chapters() if chosen is None else chosen:
        for entry in chapter.entries:
            yield verdict(chapter, entry)


def verdict(chapter: Chapter, entry: Entry) -> Verdict:
    """Decide one entry: the printed form first, then the mended one where there is one."""
    printed = is_true(Case(chapter, entry, entry.printed))
    if entry.mended is None:
        truth, why = (Truth.TRUE, "") if printed else (Truth.FALSE, "the printed form is false")
    elif printed:
        truth, why = Truth.FALSE, "the printed form is true, and another stands beside it"
    elif is_true(Case(chapter, entry, entry.mended)):
        truth, why = Truth.ERRATUM, ""
    else:
        truth, why = Truth.FALSE, "the printed form is false, and so is the mended one"
    like = Likeness.NONE if truth is Truth.FALSE else likeness(chapter, entry)
    return Verdict(chapter=chapter, entry=entry, truth=truth, likeness=like, why=why)


def failed_ways(chapter: Chapter) -> list[str]:
    """The ways from a pose to all joint values that miss the pose or have another number of solutions than claimed."""
    failed = []
    for way in chapter.ways:
        first = chapter.entry(str(way["steps"][0]))
        try:
            held = solutions.way_holds(Case(chapter, first, first.printed), way)
        except Undefined:
            held = False
        if not held:
            failed.append(str(way["id"]))
    return failed


def is_true(case: Case) -> bool:
    """Whether a form passes every test that its data asks for."""
    tests = list(_tests(case))
    if not tests:
        return False
    try:
        return all(test(case) for test in tests)
    except Undefined:
        return False


def _tests(case: Case) -> Iterator[Test]:
    form, check = case.form, case.entry.check
    asked = [name for name in ASKED if name in form.options]
    if check == "definition":
        yield _used_in_true_equations
    elif check != "identity":
        yield WHOLE[check]
    elif form.members and not form.means and "closes" not in form.options and not case.option("rows_of"):
        yield identities.identity
    if form.means or case.option("rows_of"):
        yield identities.means
    for name in asked:
        yield ASKED[name]


def _used_in_true_equations(case: Case) -> bool:
    """A name that the lecture gives something is right where the equations that use it hold.

    Those equations are read in a chapter that has this form of the definition.
    """
    for name in case.option("used") or ():
        other = case.chapter.entry(name)
        if not _holds(case.chapter, other, other.printed):
            return False
    named = isinstance(case.form.members[0], Name)
    return named and bool(case.option("used") or "equals" in case.form.options)


def _holds(chapter: Chapter, entry: Entry, form: Form) -> bool:
    return identities.identity(Case(chapter, entry, form))
