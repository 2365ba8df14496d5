"""A robot's table as Markdown."""

from __future__ import annotations

from collections.abc import Iterator

from kinsym.algebra.convert import tree_of
from kinsym.emit.latex.formula import LatexPrinter
from kinsym.emit.latex.names import Names
from kinsym.emit.latex.tables import row_vector, table_of
from kinsym.emit.markdown.words import table, words
from kinsym.emit.prose.wording import CONVENTIONS, INPUT, decimal
from kinsym.robot.model import Matrix, Robot


def robot(of: Robot) -> str:
    """Title, table and what belongs to it: home pose, base, tool, locked joints, parameters."""
    return _Robot(of).page()


class _Robot:
    def __init__(self, of: Robot) -> None:
        self.robot = of
        self.names = Names([*of.variables, *of.parameters])
        self.formula = LatexPrinter(self.names)

    def page(self) -> str:
        robot = self.robot
        parts = [
            f"**{words(robot.title) or words(robot.name)}**",
            f"{words(CONVENTIONS[robot.convention])}:",
            self._table(),
            *self._home(),
            *(self._fixed(name, matrix) for name, matrix in (("base", robot.base), ("tool", robot.tool)) if matrix),
        ]
        if robot.locks:
            parts.append(f"Locked: {', '.join(self._locks())}.")
        if robot.parameters:
            parts.append(f"Parameters: {', '.join(self._parameters())}.")
        return "\n\n".join(parts)

    def _table(self) -> str:
        found = table_of(self.robot, self.formula)
        number, *heads = found.head
        rows = (
            (row[0], kind, *(f"${cell}$" if cell else "" for cell in row[1:]))
            for row, kind in zip(found.rows, found.kinds, strict=True)
        )
        return table((f"${number}$", "joint", *(f"${head}$" for head in heads)), rows)

    def _home(self) -> Iterator[str]:
        home = self.robot.home
        if home is not None:
            vectors = (("u_0", home.u0), ("v_0", home.v0), ("w_0", home.w0), ("q_0", home.q0))
            formulas = (f"${name} = {row_vector(vector, self.formula)}$" for name, vector in vectors)
            yield f"Home pose: {', '.join(formulas)}."

    def _fixed(self, name: str, matrix: Matrix) -> str:
        rows = r" \\ ".join(" & ".join(self.formula(tree_of(cell)) for cell in row) for row in matrix)
        return f"$$T_{{\\mathrm{{{name}}}}} = \\begin{{bmatrix}} {rows} \\end{{bmatrix}}$$"

    def _locks(self) -> Iterator[str]:
        for name, value in self.robot.locks.items():
            held = f"${self.names[name]} = {'' if value is None else self.formula(tree_of(value))}$"
            yield f"${self.names[name]}$, {INPUT}" if value is None else held

    def _parameters(self) -> Iterator[str]:
        for name, value in self.robot.parameters.items():
            yield f"${self.names[name]}$" if value is None else f"${self.names[name]} = {decimal(value)}$"
