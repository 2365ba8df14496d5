"""Where formulas stand on the page: aligned equations with broken lines, matrices that fit, tables that fit.

The page is A4 with margins of 25 mm at 10 pt. Nothing here knows robots.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from kinsym.emit.latex.measure import width
from kinsym.emit.prose.breaking import LATEX, broken

#: 160 mm in points.
PAGE = 455.0
_TAG = 30.0
_QUAD = 10.0
_TABLE_SPACE = 6.0
_WORD = 36.0
_ARRAY_SPACE = 5.0
_BRACKETS = 12.0
#: The size of TeX's footnotesize beside the type of the document.
SMALL = 0.8
#: The width of a relation with the space around it.
RELATION = 14.0
_WIDEST_LEFT = 0.35 * PAGE
_LONGEST_TABLE = 32


@dataclass(frozen=True, kw_only=True)
class Relation:
    """``left sign right``, not yet laid out."""

    left: str
    right: str
    sign: str = "="


#: The lines of one numbered equation, without the ``\\`` at their ends.
Row = tuple[str, ...]
#: The equations of one ``align`` environment.
Block = tuple[Row, ...]


def _continued(depth: int, text: str, inside_product: bool) -> str:
    start = r"{}\cdot " if inside_product else "{}"
    return r"\quad" * (depth + 1) + " " + start + text


def _lines(text: str, room: float) -> list[str]:
    parts = broken(text, room - _QUAD, syntax=LATEX, measure=width, indent=_QUAD)
    return [parts[0].text, *(_continued(part.depth, part.text, part.inside_product) for part in parts[1:])]


def _stacked(relation: Relation) -> Row:
    """An equation whose left side is too wide to stand beside its right side."""
    room = PAGE - _TAG - RELATION - _QUAD
    right = _lines(relation.right, room)
    return (
        *(f"& {line}" for line in _lines(relation.left, room)),
        f"& \\quad {relation.sign} {right[0]}",
        *(f"& \\quad {line}" for line in right[1:]),
    )


def aligned(relations: Iterable[Relation]) -> tuple[Block, ...]:
    """Equations aligned at their relation, long right sides broken, as blocks that fit the page."""
    blocks: list[Block] = []
    plain: list[Relation] = []

    def flush() -> None:
        if plain:
            room = PAGE - _TAG - RELATION - max(width(relation.left) for relation in plain)
            rows = []
            for relation in plain:
                first, *others = _lines(relation.right, room)
                rows.append((f"{relation.left} &{relation.sign} {first}", *(f"&{line}" for line in others)))
            blocks.append(tuple(rows))
            plain.clear()

    for relation in relations:
        fits = width(relation.left) + width(relation.right) <= PAGE - _TAG - RELATION
        if width(relation.left) > _WIDEST_LEFT and (plain or not fits):
            flush()
        if width(relation.left) > _WIDEST_LEFT and not fits:
            blocks.append((_stacked(relation),))
        else:
            plain.append(relation)
            if width(relation.left) > _WIDEST_LEFT:
                flush()
    flush()
    return tuple(blocks)


def bracketed_width(cells: Sequence[Sequence[str]]) -> float:
    """The width of a matrix between its brackets, these included."""
    columns = list(zip(*cells, strict=True))
    return sum(max(map(width, column)) for column in columns) + 2 * _ARRAY_SPACE * (len(columns) - 1) + _BRACKETS


@dataclass(frozen=True, kw_only=True)
class Matrix:
    """``name = [cells]``."""

    name: str
    cells: tuple[tuple[str, ...], ...]

    @property
    def width(self) -> float:
        """The width of the whole equation."""
        return width(self.name) + RELATION + bracketed_width(self.cells)

    @property
    def fits(self) -> bool:
        """Whether it can stand on a line of its own."""
        return self.width <= PAGE - _TAG

    def entries(self) -> tuple[Relation, ...]:
        """The entries that are not zero, one by one, for a matrix that is too wide."""
        return tuple(
            Relation(left=f"({self.name})_{{{i},{j}}}", right=cell)
            for i, row in enumerate(self.cells, start=1)
            for j, cell in enumerate(row, start=1)
            if cell != "0"
        )


@dataclass(frozen=True, kw_only=True)
class Display:
    """Either a line of matrices or, where a matrix is too wide, its entries."""

    matrices: tuple[Matrix, ...] = ()
    blocks: tuple[Block, ...] = ()


def matrices(all_matrices: Sequence[Matrix]) -> tuple[Display, ...]:
    """Matrices side by side as far as they fit."""
    displays: list[Display] = []
    line: list[Matrix] = []
    used = 0.0
    for matrix in all_matrices:
        if line and (not matrix.fits or used + 2 * _QUAD + matrix.width > PAGE - _TAG):
            displays.append(Display(matrices=tuple(line)))
            line, used = [], 0.0
        if not matrix.fits:
            displays.append(Display(blocks=aligned(matrix.entries())))
            continue
        used += matrix.width + (2 * _QUAD if line else 0.0)
        line.append(matrix)
    if line:
        displays.append(Display(matrices=tuple(line)))
    return tuple(displays)


def table_fits(rows: Sequence[Sequence[str]], scale: float = 1.0) -> bool:
    """Whether a table of formulas, and a last column of one short word, stands on the page at a scale of the type."""
    columns = zip(*rows, strict=True)
    return sum(scale * max(map(width, column)) + 2 * _TABLE_SPACE for column in columns) + _WORD <= PAGE


def chunks(rows: Sequence[tuple[str, ...]]) -> Iterator[Sequence[tuple[str, ...]]]:
    """A long table in parts that stand on a page."""
    for start in range(0, len(rows), _LONGEST_TABLE):
        yield rows[start : start + _LONGEST_TABLE]
