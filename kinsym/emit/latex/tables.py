"""The table of a robot as it stands on the page: its rows, or cell by cell where it is too wide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from kinsym.algebra.convert import tree_of
from kinsym.emit.latex.formula import LatexPrinter
from kinsym.emit.latex.layout import SMALL, Block, Relation, aligned, table_fits
from kinsym.emit.prose.wording import CONVENTIONS
from kinsym.robot.model import Convention, Robot, Vector

_HEADS = {
    Convention.SCREW: ("s_i", "s_{0i}"),
    Convention.CRAIG: (r"\alpha_{i-1}", "a_{i-1}", "d_i", r"\theta_i"),
    Convention.PAUL: (r"\alpha_i", "a_i", "d_i", r"\theta_i"),
}

Rows = Sequence[Sequence[str]]


@dataclass(frozen=True, kw_only=True)
class Table:
    """The head and the rows of a table with the kind of each joint, or its cells one by one as ``blocks``."""

    head: Sequence[str]
    rows: Rows
    kinds: Sequence[str]
    small: bool
    blocks: tuple[Block, ...]


def table_of(robot: Robot, formula: LatexPrinter) -> Table:
    """A robot's table, in smaller type where it would not fit and cell by cell where even that is too wide."""
    head = ("i", *_HEADS[robot.convention])
    rows = [(str(number), *_cells(robot, number - 1, formula)) for number in range(1, len(robot.joints) + 1)]
    fits = table_fits([head, *rows], SMALL)
    return Table(
        head=head,
        rows=rows,
        kinds=[joint.kind for joint in robot.joints],
        small=not table_fits([head, *rows]),
        blocks=() if fits else _listed(head, rows),
    )


def convention_of(robot: Robot) -> str:
    """What kind of table a robot has, as the beginning of a sentence."""
    return CONVENTIONS[robot.convention].replace("Denavit-Hartenberg", "Denavit--Hartenberg")


def row_vector(vector: Vector, formula: LatexPrinter) -> str:
    """A vector of a table, as a row."""
    return f"({', '.join(formula(tree_of(cell)) for cell in vector)})"


def _cells(robot: Robot, index: int, formula: LatexPrinter) -> list[str]:
    joint = robot.joints[index]
    if robot.convention is Convention.SCREW:
        return ["" if vector is None else row_vector(vector, formula) for vector in (joint.s, joint.s0)]
    row = (joint.alpha, joint.a, joint.d, joint.theta)
    return ["" if cell is None else formula(tree_of(cell)) for cell in row]


def _listed(head: Sequence[str], rows: Rows) -> tuple[Block, ...]:
    relations = []
    for number, *cells in rows:
        for name, cell in zip(head[1:], cells, strict=True):
            relations.append(Relation(left=f"\\text{{row {number}: }} {name}", right=cell))
    return aligned(relations)
