"""What is to be said of the lecture's own lines: its mistakes, the conditions that it leaves out, other forms."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kinsym.emit.latex.layout import Relation, aligned
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.sentences import capital, wrapped
from kinsym.lecture.chapter import Form
from kinsym.lecture.latex.notation import LecturePrinter
from kinsym.lecture.notation import Grid, Node
from kinsym.lecture.report import reason
from kinsym.lecture.verdict import Truth, Verdict

_WIDEST_INLINE = 250.0


@dataclass(frozen=True)
class Erratum:
    """A mistake as it stands in the table: both forms in LaTeX."""

    label: str
    slide: int
    printed: str
    mended: str


class Remarks:
    """Remarks on entries, each said once; ``errata`` lists the mistakes in the order in which they were said."""

    def __init__(self) -> None:
        self.printer = LecturePrinter()
        self.errata: list[Erratum] = []

    def calls_for_one(self, verdict: Verdict) -> bool:
        """Whether there is anything to be said of an entry."""
        return verdict.truth is Truth.ERRATUM or "unstated" in verdict.entry.printed.options

    def on(self, verdict: Verdict, equation: str = "") -> str:
        """All that is to be said of an entry, as environments of the chapter.

        ``equation`` is the label of the equation that says what the entry should.
        """
        place = f"slide {verdict.entry.slide}" + (f", \\eqref{{{equation}}}" if equation else "")
        return "\n".join(self._about(verdict, place))

    def _about(self, verdict: Verdict, place: str) -> Iterator[str]:
        entry = verdict.entry
        if verdict.truth is Truth.ERRATUM and entry.mended is not None:
            yield self._erratum(verdict, entry.printed, entry.mended, place)
        condition = entry.printed.options.get("unstated")
        if condition:
            said = f"The lecture does not print what must hold here: {self.printer.told(condition)}."
            yield f"\\begin{{condition}}[{place}]\n{said}\n\\end{{condition}}"

    def _erratum(self, verdict: Verdict, printed: Form, mended: Form, place: str) -> str:
        """One mistake."""
        one, other = self.difference(mended, printed), self.difference(printed, mended)
        in_table = [self.difference(*pair, inline=True) for pair in ((mended, printed), (printed, mended))]
        why = self.printer.told(reason(verdict))
        label = f"erratum:{verdict.chapter.file.removesuffix('.toml')}:{verdict.entry.id}"
        self.errata.append(Erratum(label, verdict.entry.slide, *in_table))
        if "\n" in one + other:
            said = f"The lecture has {one}\nIt must be {other}\n{capital(why)}"
        else:
            said = wrapped(f"The lecture has {one}; it must be {other}: {why}")
        end = "" if said.endswith(".)") else "."
        return f"\\begin{{erratum}}[{place}]\\label{{{label}}}\n{said}{end}\n\\end{{erratum}}"

    def difference(self, one: Form, other: Form, *, inline: bool = False) -> str:
        """The other form as far as it differs from the one; set apart if it is long, unless it must be ``inline``."""
        if other.claim:
            return f"``{self.printer.told(other.claim)}''"
        if not any(isinstance(member, Grid) for member in other.members):
            return self.formula(other.members, inline=inline)
        parts: list[str] = []
        for before, after in zip(one.members, other.members, strict=True):
            if before == after:
                continue
            if isinstance(before, Grid) and isinstance(after, Grid):
                parts += self._entries(before, after)
            else:
                text = self.printer(after)
                parts.append(f"${text} = \\cdots$" if after == other.members[0] else f"${text}$")
        return ", ".join(parts)

    def _entries(self, before: Grid, after: Grid) -> Iterator[str]:
        """The entries of a matrix, or the components of a column, that are not the same."""
        for i, (old, new) in enumerate(zip(before.rows, after.rows, strict=True), start=1):
            for k, (first, second) in enumerate(zip(old, new, strict=True), start=1):
                if first != second:
                    place = f"component {i}" if len(new) == 1 else f"entry ({i},{k})"
                    yield f"${self.printer(second)}$ as {place}"

    def formula(self, members: tuple[Node, ...], *, inline: bool) -> str:
        """An equation inside a sentence, or set apart if it is long."""
        first, *others = map(self.printer, members)
        text = " = ".join((first, *others))
        if inline or width(text) <= _WIDEST_INLINE:
            return f"${text}$"
        lines = [
            line for block in aligned([Relation(left=first, right=" = ".join(others))]) for row in block for line in row
        ]
        return "\n".join(["", "\\begin{align*}", " \\\\\n".join(f"  {line}" for line in lines), "\\end{align*}"])
