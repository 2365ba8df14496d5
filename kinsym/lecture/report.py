"""The verdicts on the lecture as lines of text: one an equation, a table by system, the list of mistakes."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from kinsym.emit.text.page import Page
from kinsym.errors import KinsymError
from kinsym.lecture.chapter import KINDS, Chapter, Form, chapters
from kinsym.lecture.form import COUNTED, Likeness
from kinsym.lecture.told import plain
from kinsym.lecture.verdict import Truth, Verdict
from kinsym.robot import load
from kinsym.robot.names import nearest, shown

WIDTH = 80
PAGE = Page(width=WIDTH)


def filled(text: str, *, indent: int = 2) -> str:
    """A sentence in lines of the page's width."""
    margin = " " * indent
    return textwrap.fill(plain(text), WIDTH, initial_indent=margin, subsequent_indent=margin, break_on_hyphens=False)


def systems() -> tuple[str, ...]:
    """The systems of the lecture in its order."""
    return tuple(dict.fromkeys(chapter.system for chapter in chapters()))


def chosen(system: str | None) -> tuple[Chapter, ...]:
    """The chapters of one system, or all.

    Raises KinsymError with the nearest name where the lecture has no such system.
    """
    if system is None:
        return chapters()
    if system not in systems():
        raise KinsymError(
            f"the lecture has no system {shown(system)}. {nearest(system, systems())}"
            f"Its systems: {', '.join(systems())}."
        )
    return tuple(chapter for chapter in chapters() if chapter.system == system)


def lines(verdicts: Iterable[Verdict]) -> Iterator[str]:
    """One line an entry, with the mended form below it, and why kinsym writes it otherwise unless it was just said."""
    said = ""
    for verdict in verdicts:
        yield line(verdict)
        entry = verdict.entry
        if verdict.truth is Truth.ERRATUM:
            yield filled(f"mended: {mended_text(verdict)}", indent=9)
        if verdict.likeness is Likeness.OTHER and entry.instead and entry.instead != said:
            said = entry.instead
            yield filled(said, indent=9)


def line(verdict: Verdict) -> str:
    """One entry: its number, system, name and verdict.

    >>> from kinsym.lecture.verdict import verdict
    >>> line(verdict(*next((c, c.entry("2.82")) for c in chapters() if c.system == "fanuc_s900w")))
    '  2.82   fanuc_s900w           2.82              in the printed form'
    """
    entry = verdict.entry
    return f"  {entry.number:<6} {verdict.chapter.system:<21} {entry.id:<17} {_word(verdict)}"


def _word(verdict: Verdict) -> str:
    if verdict.truth is Truth.FALSE:
        return f"NOT ACCOUNTED FOR\n         {verdict.why}"
    if verdict.truth is Truth.ERRATUM:
        return "erratum"
    return {
        Likeness.SAME: "in the printed form",
        Likeness.OTHER: "true, in another form",
        Likeness.NONE: "true",
    }[verdict.likeness]


def mended_text(verdict: Verdict) -> str:
    """What an erratum should say, without the entries of a matrix that are right."""
    mended = verdict.entry.mended
    return "" if mended is None else difference(verdict.entry.printed, mended)


def difference(one: Form, other: Form) -> str:
    """The other form as far as it differs from the one: its sentence, its equation, or some entries of its matrix."""
    if one.claim or len(one.texts) != len(other.texts):
        return other.text
    if not any(text.startswith("[") for text in other.texts):
        return other.text
    parts = []
    for before, after in zip(one.texts, other.texts, strict=True):
        if before == after:
            continue
        if not after.startswith("[") or not before.startswith("["):
            parts.append(f"{after} = ..." if after == other.texts[0] else after)
            continue
        old, new = (_cells(text) for text in (before, after))
        parts += [
            f"entry ({i + 1},{k + 1}) = {cell}"
            for i, row in enumerate(new)
            for k, cell in enumerate(row)
            if old[i][k] != cell
        ]
    return ", ".join(parts)


def _cells(text: str) -> list[list[str]]:
    return [row.split(", ") for row in text.strip("[]").split("; ")]


def summary(verdicts: Sequence[Verdict]) -> str:
    """How many entries of each system are true, printed alike, mended and not accounted for."""
    head = ("system", "entries", "true", "errata", "open", "printed alike")
    rows: list[tuple[str, ...]] = [head]
    names = list(dict.fromkeys(v.chapter.system for v in verdicts))
    for name in [*names, "total"]:
        own = [v for v in verdicts if name in (v.chapter.system, "total")]
        truth = Counter(v.truth for v in own)
        compared = [v for v in own if v.likeness is not Likeness.NONE]
        alike = sum(v.likeness is Likeness.SAME for v in compared)
        counts = (len(own), truth[Truth.TRUE], truth[Truth.ERRATUM], truth[Truth.FALSE])
        rows.append((name, *map(str, counts), f"{alike} of {len(compared)}"))
    return PAGE.columns(rows)


def forms(verdicts: Iterable[Verdict]) -> str:
    """How many entries of each kind kinsym prints in the lecture's form."""
    found: dict[str, list[Verdict]] = {}
    for verdict in verdicts:
        if verdict.likeness is not Likeness.NONE:
            found.setdefault(verdict.entry.kind, []).append(verdict)
    rows = [("kind", "compared", "in the printed form")]
    for kind in (kind for kind in KINDS if kind in found):
        alike = sum(v.likeness is Likeness.SAME for v in found[kind])
        rows.append((KINDS[kind], str(len(found[kind])), str(alike)))
    counted = [v for kind in COUNTED for v in found.get(kind, [])]
    if not counted:
        return ""
    alike = sum(v.likeness is Likeness.SAME for v in counted)
    share = f"Transforms, products, forward kinematics and solutions: {alike} of {len(counted)} in the printed form"
    return PAGE.columns(rows) + "\n\n" + filled(f"{share}, {100 * alike // len(counted)} %; all of them in value.")


def errata(verdicts: Iterable[Verdict]) -> Iterator[str]:
    """Every mistake of the lecture with its place, both forms and the reason."""
    for verdict in verdicts:
        entry = verdict.entry
        if verdict.truth is not Truth.ERRATUM or entry.mended is None:
            continue
        number = f" ({entry.number})" if entry.number else ""
        yield "\n".join(
            (
                f"  slide {entry.slide}{number}, {verdict.chapter.system}: {entry.id}",
                filled(f"printed: {difference(entry.mended, entry.printed)}", indent=6),
                filled(f"mended:  {mended_text(verdict)}", indent=6),
                filled(f"because: {reason(verdict)}", indent=6),
            )
        )


def reason(verdict: Verdict) -> str:
    """Why a printed form is a mistake."""
    doubt = " (the slip may be the scan's)" if verdict.entry.doubtful else ""
    return verdict.entry.reason.rstrip(".") + doubt


def ways(chapter: Chapter, failed: Sequence[str]) -> Iterator[str]:
    """The ways from a pose to the joint values that were walked, with all their branches."""
    for way in chapter.ways:
        if way["id"] not in failed:
            text = (
                f"{way['total']} solutions in all branches of {', '.join(way['steps'])}; each leads back to the pose."
            )
            yield filled(text, indent=9)


def missing(chapter: Chapter) -> str:
    """What the lecture leaves open of a system, so that nothing can be derived; empty for all others."""
    text = left_open(chapter)
    return text and filled(f"{text[:-1]} (kinsym show {chapter.robot}).")


def left_open(chapter: Chapter) -> str:
    """The same as a sentence of words and formulas."""
    if not chapter.without_dimensions:
        return ""
    robot = load(chapter.robot)
    names = ", ".join(f"`{name}`" for name in robot.parameters)
    return (
        f"The lecture names the joints of this arm and gives no table: `alpha`, `a` and `d` of {len(robot.joints)} "
        f"rows are missing, so that nothing but its variables can be compared. kinsym's own {robot.name} has {names} "
        f"in their places."
    )
