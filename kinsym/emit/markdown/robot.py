"""A robot's table as Markdown."""

from __future__ import annotations

from collections.abc import Iterator

from sympy import Expr

from kinsym.algebra.convert import tree_of
from kinsym.emit.latex.formula import LatexPrinter
from kinsym.emit.latex.names import Names
from kinsym.emit.markdown.words import table, words
from kinsym.emit.prose.wording import CONVENTIONS, INPUT, decimal
from kinsym.robot.model import Convention, Joint, Matrix, Robot, Vector

_HEADS = {
    Convention.SCREW: ("$s_i$", "$s_{0i}$"),
    Convention.CRAIG: (r"$\alpha_{i-1}$", "$a_{i-1}$", "$d_i$", r"$\theta_i$"),
    Convention.PAUL: (r"$\alpha_i$", "$a_i$", "$d_i$", r"$\theta_i$"),
}


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
        rows = [(str(i), joint.kind, *self._cells(joint)) for i, joint in enumerate(robot.joints, start=1)]
        parts = [
            f"**{words(robot.title) or words(robot.name)}**",
            f"{words(CONVENTIONS[robot.convention])}:",
            table(("$i$", "joint", *_HEADS[robot.convention]), rows),
            *self._home(),
            *(self._fixed(name, matrix) for name, matrix in (("base", robot.base), ("tool", robot.tool)) if matrix),
        ]
        if robot.locks:
            parts.append(f"Locked: {', '.join(self._locks())}.")
        if robot.parameters:
            parts.append(f"Parameters: {', '.join(self._parameters())}.")
        return "\n\n".join(parts)

    def _cell(self, cell: Expr | None) -> str:
        return "" if cell is None else f"${self.formula(tree_of(cell))}$"

    def _vector(self, vector: Vector | None) -> str:
        return "" if vector is None else f"$({', '.join(self.formula(tree_of(cell)) for cell in vector)})$"

    def _cells(self, joint: Joint) -> tuple[str, ...]:
        if self.robot.convention is Convention.SCREW:
            return self._vector(joint.s), self._vector(joint.s0)
        return tuple(self._cell(cell) for cell in (joint.alpha, joint.a, joint.d, joint.theta))

    def _home(self) -> Iterator[str]:
        home = self.robot.home
        if home is not None:
            vectors = (("u_0", home.u0), ("v_0", home.v0), ("w_0", home.w0), ("q_0", home.q0))
            yield f"Home pose: {', '.join(f'${name} = $ {self._vector(vector)}' for name, vector in vectors)}."

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
