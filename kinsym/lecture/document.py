"""``docs/lecture.md``: the lecture's sections beside kinsym's functions, and its mistakes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kinsym.lecture import told
from kinsym.lecture.form import COUNTED, Likeness
from kinsym.lecture.report import difference, mended_text, reason
from kinsym.lecture.sections import sections
from kinsym.lecture.verdict import Truth, Verdict

HEAD = """\
# The lecture, equation by equation

H. D. Taghirad, *Robotics: Mechanics & Control*, chapter 3, *Kinematic Analysis*: {entries} equations, tables and
sentences over {systems} systems. `kinsym lecture` holds each of them against what kinsym derives. {true} are true as
printed, {errata} are mistakes whose mended form is true, {open} are open. {restored} lines that cannot be read in the
scan, or that the lecture leaves to its reader, are given as they must have been.

A verdict is found, not looked up. An equation is evaluated at random postures modulo a prime of 61 bits, where every
name stands for what kinsym prints for it; a solution of an inverse kinematics must satisfy the equations it solves and
lead back to the pose with every branch; how often a goal is reached is asked of kinsym's own conditions in rational
numbers. A mistake is an entry whose printed form fails and whose mended form passes the same tests.

Of the {counted} link transforms, products, elements of forward kinematics and solutions kinsym prints {alike} in the
lecture's form: the same expression up to the order of terms and factors and the place of a minus sign.

`kinsym latex --lecture` writes the chapter itself: the derivations of every section, the lecture's numbers beside
kinsym's, and its mistakes as remarks where they occur.

This page is written by `kinsym lecture --markdown`. The notebooks in [`notebooks/`](../notebooks) show
one part of the lecture each, derived and drawn.
"""


def markdown(verdicts: Sequence[Verdict]) -> str:
    """The page, from the verdicts on the whole lecture."""
    counted = [v for v in verdicts if v.entry.kind in COUNTED and v.likeness is not Likeness.NONE]
    head = HEAD.format(
        entries=len(verdicts),
        systems=len({v.chapter.robot for v in verdicts if v.chapter.robot}),
        true=_count(verdicts, Truth.TRUE),
        errata=_count(verdicts, Truth.ERRATUM),
        open=_count(verdicts, Truth.FALSE),
        restored=sum(bool(v.entry.restored) for v in verdicts),
        counted=len(counted),
        alike=sum(v.likeness is Likeness.SAME for v in counted),
    )
    parts = [head, "## Sections\n", *_sections(verdicts), "\n## Mistakes\n", *_mistakes(verdicts)]
    parts += ["\n## Conditions that the lecture needs and does not print\n", *_conditions(verdicts)]
    parts += ["\n## Where kinsym writes it in another form\n", *_other_forms(verdicts)]
    return "\n".join(parts) + "\n"


def _count(verdicts: Sequence[Verdict], truth: Truth) -> int:
    return sum(v.truth is truth for v in verdicts)


def _sections(verdicts: Sequence[Verdict]) -> Iterator[str]:
    yield "| slides | section | entries | mistakes | in kinsym |"
    yield "|---|---|--:|--:|---|"
    for section in sections():
        own = [v for v in verdicts if section.holds(v.entry.slide)]
        names = ", ".join(f"`{name}`" for name in section.kinsym)
        yield f"| {section.place} | {section.title} | {len(own)} | {_count(own, Truth.ERRATUM) or ''} | {names} |"


def _mistakes(verdicts: Sequence[Verdict]) -> Iterator[str]:
    yield "| slide | system | printed | mended | because |"
    yield "|--:|---|---|---|---|"
    for verdict in sorted((v for v in verdicts if v.truth is Truth.ERRATUM), key=lambda v: v.entry.slide):
        entry = verdict.entry
        if entry.mended is None:
            continue
        forms = (difference(entry.mended, entry.printed), mended_text(verdict))
        cells = [told.markdown(form) if entry.printed.claim else f"`{form}`" for form in forms]
        row = (str(entry.slide), verdict.chapter.system, *cells, told.markdown(reason(verdict)))
        yield f"| {' | '.join(row)} |"


def _conditions(verdicts: Sequence[Verdict]) -> Iterator[str]:
    yield "| slide | system | entry | condition |"
    yield "|--:|---|---|---|"
    for verdict in sorted(verdicts, key=lambda v: v.entry.slide):
        condition = verdict.entry.printed.options.get("unstated")
        if condition:
            entry = verdict.entry
            yield f"| {entry.slide} | {verdict.chapter.system} | `{entry.id}` | {told.markdown(condition)} |"


def _other_forms(verdicts: Sequence[Verdict]) -> Iterator[str]:
    yield "| slide | system | entry | why |"
    yield "|--:|---|---|---|"
    for verdict in sorted((v for v in verdicts if v.likeness is Likeness.OTHER), key=lambda v: v.entry.slide):
        entry = verdict.entry
        yield f"| {entry.slide} | {verdict.chapter.system} | `{entry.id}` | {told.markdown(entry.instead)} |"
