"""One section of the chapter: tables of its arms, derivations, remarks, and what else stands on the slides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

from kinsym.emit.latex.article import rendered
from kinsym.emit.latex.layout import Relation, aligned
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.method_document import solutions_section
from kinsym.emit.latex.methods import MethodPage
from kinsym.emit.latex.sentences import capital, escape
from kinsym.emit.latex.tables import convention_of, table_of
from kinsym.lecture.latex.places import Stated, place_of, stated_in
from kinsym.lecture.latex.remarks import Remarks
from kinsym.lecture.latex.shown import Shown
from kinsym.lecture.verdict import Truth, Verdict
from kinsym.robot.model import Robot

_WIDEST_INLINE = 200.0
_WIDEST_PRODUCT = 330.0


@dataclass(frozen=True)
class Printed:
    """A derivation that stands on the page."""

    shown: Shown
    equations: tuple[Stated, ...]
    page: MethodPage


@dataclass
class Chapter:
    """What has been printed so far: tables by robot, derivations with their equations, remarks."""

    remarks: Remarks = field(default_factory=Remarks)
    tables: list[str] = field(default_factory=list)
    printed: list[Printed] = field(default_factory=list)

    def derivation(self, one: Shown, verdicts: Sequence[Verdict], *, heading: str) -> tuple[str, list[Verdict]]:
        """A derivation as LaTeX, and the entries of the lecture that it states."""
        equations = stated_in(one)
        places = {verdict.entry.id: place_of(verdict, one, equations) for verdict in verdicts}
        placed = [verdict for verdict in verdicts if places[verdict.entry.id]]
        numbers: dict[str, dict[str, None]] = {}
        remarks: dict[str, list[Verdict]] = {}
        for verdict in placed:
            name = places[verdict.entry.id]
            if verdict.entry.number:
                numbers.setdefault(name, {})[verdict.entry.number] = None
            if self.remarks.calls_for_one(verdict):
                remarks.setdefault(name, []).append(verdict)
        page = MethodPage(
            one.derivation,
            lecture={name: ", ".join(found) for name, found in numbers.items()},
            remarks={name: partial(self._remarks_on, found) for name, found in remarks.items()},
            elsewhere=dict(one.elsewhere),
        )
        parts = [f"\\subsection*{{{heading}}}"] if heading else []
        parts += [*self._table(one.robot, page), *page.lines()]
        self.printed.append(Printed(one, equations, page))
        if solutions := solutions_section(page):
            parts.append(solutions)
        return "\n".join(parts), placed

    def _remarks_on(self, verdicts: Sequence[Verdict], label: str) -> str:
        return "\n".join(self.remarks.on(verdict, label) for verdict in verdicts)

    def _table(self, robot: Robot | None, page: MethodPage) -> Iterator[str]:
        """The table of an arm where it is new, otherwise a reference to it."""
        if robot is None:
            return
        label = f"table:{robot.name}"
        title = escape(robot.title) or escape(robot.name)
        if robot.name in self.tables:
            yield f"The table of the arm is Table~\\ref{{{label}}}."
            return
        self.tables.append(robot.name)
        caption = title if "convention" in title else f"{title}. {convention_of(robot)}"
        yield rendered("captioned", {"table": table_of(robot, page.formula), "caption": caption, "label": label})

    def rest(self, verdicts: Sequence[Verdict], *, heading: str) -> str:
        """The entries of a section that its derivations do not state in the lecture's form."""
        again: list[str] = []
        told: list[str] = []
        short: list[str] = []
        long: dict[str, list[str]] = {}
        remarks: list[str] = []
        for verdict in verdicts:
            entry = verdict.entry
            if self.remarks.calls_for_one(verdict):
                remarks.append(self.remarks.on(verdict))
            if verdict.truth is Truth.ERRATUM or not (entry.printed.members or entry.printed.claim):
                continue
            if place := self._before(verdict):
                number = f"~{{\\footnotesize[{entry.number}]}}" if entry.number else ""
                again.append(f"\\eqref{{{place}}}{number}")
            elif entry.printed.claim:
                told.append(capital(self.remarks.printer.told(entry.printed.claim)) + ".")
            else:
                self._formula(verdict, short, long)
        again, told, short = (list(dict.fromkeys(texts)) for texts in (again, told, short))
        long = {why: list(dict.fromkeys(rows)) for why, rows in sorted(long.items(), key=lambda item: bool(item[0]))}
        found = {"again": again, "told": told, "short": short, "long": long, "remarks": remarks}
        return rendered("slides", found | {"heading": heading}) if any(found.values()) else ""

    def _formula(self, verdict: Verdict, short: list[str], long: dict[str, list[str]]) -> None:
        """An equation in its own form: among others in a line if it is short, else set apart with its number.

        Those that are set apart stand under the sentence that says why kinsym has another form.
        """
        printer = self.remarks.printer
        first, *others = map(printer, verdict.entry.printed.members)
        right = " = ".join(others)
        why = self.remarks.printer.told(verdict.entry.instead)
        number = verdict.entry.number
        if not (why or number) and "bmatrix" not in right and width(first) + width(right) <= _WIDEST_INLINE:
            short.append(f"${first} = {right}$")
            return
        if "bmatrix" in right:
            lines = [
                f"{first} &= {line}" if not k else f"& \\quad {{}} {line}"
                for k, line in enumerate(self._products(verdict))
            ]
        else:
            lines = [line for block in aligned([Relation(left=first, right=right)]) for row in block for line in row]
        mark = f" \\lecture{{{number}}}" if number else ""
        shown = " \\notag \\\\\n".join(f"  {line}" for line in lines)
        long.setdefault(why and f"{_sentence(why)}.", []).append(f"{shown}{mark}")

    def _products(self, verdict: Verdict) -> Iterator[str]:
        """The right sides of an equation of matrices, in lines as long as fit; a product may break between factors."""
        line, used = "", 0.0
        for k, member in enumerate(verdict.entry.printed.members[1:]):
            for n, (text, wide) in enumerate(self.remarks.printer.factors(member)):
                sign = " = " if k and not n else " \\, " if n else ""
                if line and used + wide > _WIDEST_PRODUCT:
                    yield line
                    line, used = "", 0.0
                line += sign + text
                used += wide
        yield line

    def _before(self, verdict: Verdict) -> str:
        """The label of an equation of an earlier section that says what an entry says of the same arm."""
        for before in self.printed:
            if before.shown.arm.robot.name == verdict.chapter.robot:
                name = place_of(verdict, before.shown, before.equations)
                if name:
                    return before.page.label(name)
        return ""


def _sentence(text: str) -> str:
    """A capital at the beginning, unless the first word is written without one."""
    return text if text.startswith("kinsym ") else capital(text)
