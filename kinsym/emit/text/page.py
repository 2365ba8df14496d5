"""A page of plain text: equations broken under their sign, sentences filled, cells in columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from kinsym.algebra.tree import Tree
from kinsym.emit.prose.breaking import TEXT, broken
from kinsym.emit.source.wrapping import fill
from kinsym.emit.text.formula import TextPrinter


@dataclass(frozen=True, kw_only=True)
class Page:
    """How wide and in which letters to write."""

    width: int = 80
    ascii: bool = False

    @property
    def formula(self) -> TextPrinter:
        """The printer of formulas."""
        return TextPrinter(ascii=self.ascii)

    def equation(self, left: str, right: Tree | str, *, indent: int = 2, relation: str = "=") -> str:
        """``left = right``, broken under the relation where it is too long."""
        text = right if isinstance(right, str) else self.formula(right)
        head = f"{' ' * indent}{left} {relation} "
        room = self.width - len(head)
        if room < self.width // 3:
            lines = [
                f"{' ' * (indent + 2 * line.depth)}{line.text}"
                for line in broken(left, self.width - indent, syntax=TEXT)
            ]
            head = f"{' ' * (indent + 4)}{relation} "
            room = self.width - len(head)
        else:
            lines = []
        for k, line in enumerate(broken(text, room, syntax=TEXT)):
            lines.append(f"{' ' * (len(head) + 2 * line.depth) if k else head}{line.text}")
        return "\n".join(lines)

    def prose(self, text: str, *, indent: int = 2) -> str:
        """A sentence, filled."""
        return "\n".join(" " * indent + line for line in fill(text, self.width - indent))

    def listed(self, head: str, items: Sequence[str], *, indent: int = 2) -> str:
        """Items behind a head, parted by commas; a line is broken between two of them."""
        lines = [" " * indent + head]
        for number, item in enumerate(items):
            word = item if number == len(items) - 1 else f"{item},"
            if len(lines[-1]) + 1 + len(word) <= self.width or lines[-1].endswith(":"):
                lines[-1] += f" {word}"
            else:
                lines.append(" " * (indent + 2) + word)
        return "\n".join(lines)

    def columns(self, rows: Iterable[Sequence[str]], *, indent: int = 2) -> str:
        """Rows of cells in aligned columns."""
        table = [list(row) for row in rows]
        widths = [max(map(len, column)) for column in zip(*table, strict=True)]
        lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in table)
        return "\n".join(" " * indent + line.rstrip() for line in lines)
