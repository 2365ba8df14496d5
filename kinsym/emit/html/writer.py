"""Formulas of one derivation as HTML: names, equations, matrices and the robot's table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from markupsafe import Markup

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition, Tree
from kinsym.emit.html.formula import MathPrinter
from kinsym.emit.html.mathml import Row, fence, glued, math, matrix, operator
from kinsym.emit.html.sentences import sentence
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names, link
from kinsym.emit.prose.vocabulary import all_names, angle_sums, joint_angles
from kinsym.emit.prose.wording import INPUT, given_joints
from kinsym.robot.model import Convention, Vector

if TYPE_CHECKING:
    from kinsym.derivation import Derivation
    from kinsym.general.plan import GeneralPlan
    from kinsym.inverse.plan import Plan

_SIGNS = {"<=": "≤", ">=": "≥", "!=": "≠", "==": "="}
_HEADS = {
    Convention.SCREW: ("s_i", "s_{0i}"),
    Convention.CRAIG: (r"\alpha_{i-1}", "a_{i-1}", "d_i", r"\theta_i"),
    Convention.PAUL: (r"\alpha_i", "a_i", "d_i", r"\theta_i"),
}


class Writer:
    """Writes what belongs to one derivation, over one table of names."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.names = Names(all_names(derivation))
        self.formula = MathPrinter(self.names)

    def row(self, tex: str) -> Row:
        """TeX of kinsym's own."""
        return mathml(tex)

    def tex(self, tex: str) -> Markup:
        """TeX of kinsym's own, for the page."""
        return math(mathml(tex))

    def math(self, tree: Tree) -> Markup:
        """A formula inside a sentence."""
        return math(self.formula(tree))

    def name(self, name: str) -> Markup:
        """A name inside a sentence."""
        return math(self.formula.name(name))

    def sentence(self, text: str) -> Markup:
        """A sentence of the plan."""
        return sentence(text, self.names)

    def equation(self, left: Row, right: Tree | Row, sign: str = "=", note: str = "") -> Markup:
        """``left = right`` on a line of its own, with a few words behind it."""
        value = right if isinstance(right, tuple) else self.formula(right)
        row = (*left, *glued((operator(_SIGNS.get(sign, sign)),), value))
        return Markup('<p class="eq">{}{}</p>\n').format(
            math(row), Markup(' <span class="note">{}</span>').format(note) if note else ""
        )

    def relation(self, relation: tuple[Tree, str, Tree]) -> Markup:
        """A condition inside a sentence."""
        left, sign, right = relation
        return math(glued(self.formula(left), (operator(_SIGNS.get(sign, sign)),), self.formula(right)))

    def definition(self, name: str, value: Tree, note: str = "") -> Markup:
        """``name = value`` on a line of its own."""
        return self.equation(self.formula.name(name), value, note=note)

    def definitions(self, items: Iterable[Definition]) -> Markup:
        """Definitions one under the other."""
        return Markup("").join(self.definition(item.name, item.value) for item in items)

    def matrix(self, name: str, rows: Iterable[Iterable[Tree]]) -> Markup:
        """``name = [...]`` on a line of its own."""
        cells = [["".join(self.formula(cell)) for cell in row] for row in rows]
        return Markup('<p class="eq">{}</p>\n').format(
            Markup(f"<math>{''.join(mathml(link(name)))}{operator('=')}{matrix(cells)}</math>")
        )

    def table(self) -> tuple[tuple[Markup | str, ...], ...]:
        """The robot's table, its head first."""
        robot = self.derivation.robot
        rows: list[tuple[Markup | str, ...]] = [
            (self.tex("i"), "joint", *(self.tex(head) for head in _HEADS[robot.convention]))
        ]
        for number, joint in enumerate(robot.joints, start=1):
            if robot.convention is Convention.SCREW:
                cells = ["" if vector is None else self.vector(vector) for vector in (joint.s, joint.s0)]
            else:
                given = (joint.alpha, joint.a, joint.d, joint.theta)
                cells = ["" if cell is None else self.math(tree_of(cell)) for cell in given]
            rows.append((str(number), joint.kind, *cells))
        return tuple(rows)

    def vector(self, vector: Vector) -> Markup:
        """A vector of the table, as a row."""
        return math(self._vector(vector))

    def _vector(self, vector: Vector) -> Row:
        parts = [self.formula(tree_of(cell)) for cell in vector]
        comma = (operator(",", "postfix"),)
        return glued((fence("("),), parts[0], comma, parts[1], comma, parts[2], (fence(")"),))

    def home(self) -> Markup:
        """The home pose of a screw table."""
        home = self.derivation.robot.home
        if home is None:
            return Markup("")
        vectors = (("u_{0}", home.u0), ("v_{0}", home.v0), ("w_{0}", home.w0), ("q_{0}", home.q0))
        return Markup("").join(self.equation(mathml(name), self._vector(vector)) for name, vector in vectors)

    def fixed(self) -> tuple[Markup, ...]:
        """The base and the tool transform."""
        robot = self.derivation.robot
        return tuple(
            self.matrix(name, [[tree_of(cell) for cell in row] for row in given])
            for name, given in (("T_base", robot.base), ("T_tool", robot.tool))
            if given is not None
        )

    def notation(self) -> Markup:
        """The shorthand of angles, and the sums among them."""
        turns = [(a.name, a.cosine, a.sine) for a in joint_angles(self.derivation)] or [("theta_i", "c_i", "s_i")]
        lines = [self._turn(*turn) for turn in turns]
        for angle, total in angle_sums(self.derivation):
            lines += [self.definition(angle.name, total), self._turn(angle.name, angle.cosine, angle.sine)]
        return Markup("").join(lines)

    def _turn(self, name: str, cosine: str, sine: str) -> Markup:
        angle, c, s = self.names[name], self.names[cosine], self.names[sine]
        return self.equation(mathml(c), mathml(rf"\cos {angle} , \quad {s} = \sin {angle}"))

    def given(self) -> tuple[Markup, ...]:
        """A sentence for each locked joint."""
        return tuple(
            Markup("{} is given, {}.").format(self.name(name), INPUT)
            if value is None
            else Markup("{} is given.").format(
                math(glued(self.formula.name(name), (operator("="),), self.formula(value)))
            )
            for name, value in given_joints(self.derivation.robot)
        )

    def assumed(self, plan: Plan | GeneralPlan) -> Markup:
        """What must not vanish for the inverse kinematics to be right."""
        zero = ("<mn>0</mn>",)
        return Markup(", ").join(math(glued(self.formula(item.value), (operator("≠"),), zero)) for item in plan.nonzero)

    def product(self) -> Markup:
        """The links, with the home pose behind those of a screw table, base and tool around them."""
        robot = self.derivation.robot
        factors = [link(item.name) for item in self.derivation.forward.links]
        if robot.home is not None:
            factors.append(r"\, [u_{0}\; v_{0}\; w_{0}\; q_{0}]")
        framed = [
            *([r"T_{\mathrm{base}}"] if robot.base else []),
            "T'",
            *([r"T_{\mathrm{tool}}"] if robot.tool else []),
        ]
        if len(framed) == 1:
            return self.equation(("<mi>T</mi>",), mathml(rf"{' '.join(factors)} = [u\; v\; w\; p]"))
        return self.equation(("<mi>T</mi>",), mathml(r" \, ".join(framed))) + self.equation(
            mathml("T'"), mathml(rf"{' '.join(factors)} = [u'\; v'\; w'\; p']")
        )

    def jacobian(self) -> tuple[Markup, ...]:
        """The columns of the Jacobian."""
        columns: Sequence[Sequence[Tree]] = list(zip(*self.derivation.jacobian.entries, strict=True))
        return tuple(self.matrix(f"J{k}", [[cell] for cell in column]) for k, column in enumerate(columns, start=1))
