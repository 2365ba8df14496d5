"""The LaTeX document of a derivation: table, forward kinematics, Jacobian and the numbered inverse derivation.

This module says what stands in the document, in which order, as formulas; ``templates/latex/document.tex.j2`` says
it in sentences and TeX.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.algebra.tree import Definition, Sum, Sym, Tree, negated, symbols
from kinsym.emit.cells import cell_tree
from kinsym.emit.environment import Delimiters, environment
from kinsym.emit.latex_formula import LatexPrinter, relation_sign
from kinsym.emit.latex_layout import Block, Display, Matrix, Relation, aligned, chunks, matrices, table_fits
from kinsym.emit.latex_measure import width
from kinsym.emit.latex_names import Names, link, pose
from kinsym.emit.latex_prose import capital, escape, prose
from kinsym.emit.wording import (
    CONVENTIONS,
    GATE,
    POSE,
    TASKS,
    Loop,
    axis_definitions,
    branch_marks,
    branch_rows,
    branchings,
    decimal,
    found_by_sum,
    loops,
    origins,
    rule_title,
    shown_items,
)
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Equation, Plan, Step, Window
from kinsym.robot.model import Convention, Robot, Vector

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

_DELIMITERS = Delimiters(block=("<%", "%>"), variable=("<<", ">>"), comment=("<#", "#>"))
_BASE, _TOOL = r"T_{\mathrm{base}}", r"T_{\mathrm{tool}}"
_WIDEST_INLINE = 220.0
#: A table of parameters with a longer name than this is set in a smaller type.
_LONGEST_NAME = 24


@dataclass(frozen=True, kw_only=True)
class Sentence:
    """``left sign right`` inside a sentence if it is short, else set apart."""

    inline: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, kw_only=True)
class Source:
    """Equations of a step that come from one place."""

    text: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, kw_only=True)
class Passage:
    """One item of the derivation; ``kind`` is ``"constants"``, ``"window"``, ``"names"`` or ``"step"``."""

    kind: str
    blocks: tuple[Block, ...] = ()
    number: int = 0
    unknown: str = ""
    rule: str = ""
    why: str = ""
    branches: int = 1
    sources: tuple[Source, ...] = ()
    coefficients: tuple[Block, ...] = ()
    solution: tuple[Block, ...] = ()
    condition: Sentence | None = None
    degenerate: Sentence | None = None


def _all_names(derivation: Derivation) -> Iterator[str]:
    """Every name of a document; the user's come first, so that they keep the plainest form."""
    robot, plan = derivation.robot, derivation.plan
    yield from robot.variables
    yield from robot.parameters
    trees: list[Tree] = [entry for row in derivation.forward.pose for entry in row]
    trees += [entry for row in derivation.jacobian.entries for entry in row]
    definitions = [*derivation.schedule.constants, *derivation.jacobian.definitions]
    for item in plan.items:
        match item:
            case Window():
                definitions += item.definitions
            case Definition():
                definitions.append(item)
            case Step():
                yield item.unknown
                yield from item.outputs
                definitions += item.coefficients
                definitions += [Definition(name=name, value=value) for name, value in item.solution]
                trees += [side for equation in item.equations for side in (equation.lhs, equation.rhs)]
    for definition in definitions:
        yield definition.name
        trees.append(definition.value)
    for tree in trees:
        yield from symbols(tree)


class _Writer:
    """Turns the parts of one derivation into formulas over one table of names."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.names = Names(_all_names(derivation))
        self.formula = LatexPrinter(self.names)
        self.count = len(derivation.robot.moving)

    def relation(self, name: str, value: Tree) -> Relation:
        """A definition."""
        return Relation(left=self.names[name], right=self.formula(value))

    def definitions(self, items: Iterable[Definition]) -> tuple[Block, ...]:
        """Definitions one under the other."""
        return aligned(self.relation(item.name, item.value) for item in items)

    def vector(self, vector: Vector) -> str:
        """A vector of the table, as a row."""
        return f"({', '.join(self.formula(cell_tree(cell)) for cell in vector)})"

    def notation(self) -> tuple[Block, ...]:
        """The sums of angles that occur, with their shorthand."""
        used = set(_all_names(self.derivation))
        relations = []
        for angle in self.derivation.chain.angles.values():
            if len(angle.terms) == 1 or not used & {angle.name, angle.cosine, angle.sine}:
                continue
            terms = tuple(Sym(name) if sign > 0 else negated(Sym(name)) for name, sign in angle.terms)
            name = self.names[angle.name]
            right = f"{self.formula(Sum(terms))}, \\quad {self.names[angle.cosine]} = \\cos {name}"
            relations.append(Relation(left=name, right=f"{right}, \\quad {self.names[angle.sine]} = \\sin {name}"))
        return aligned(relations)

    def turns(self) -> str:
        """What c_i and s_i mean for the joints of this robot."""
        angles = [angle for angle in self.derivation.chain.angles.values() if len(angle.terms) == 1]
        if all(angle.terms[0][0] == f"theta{angle.label}" for angle in angles):
            return r"c_i = \cos\theta_i, s_i = \sin\theta_i" if angles else ""
        return ", ".join(
            f"{self.names[angle.cosine]} = \\cos {self.names[angle.name]}, "
            f"{self.names[angle.sine]} = \\sin {self.names[angle.name]}"
            for angle in angles
        )

    def table(self) -> tuple[tuple[str, ...], ...]:
        """The robot's table, its head first."""
        robot = self.derivation.robot
        heads = {
            Convention.SCREW: ("s_i", "s_{0i}"),
            Convention.CRAIG: (r"\alpha_{i-1}", "a_{i-1}", "d_i", r"\theta_i"),
            Convention.PAUL: (r"\alpha_i", "a_i", "d_i", r"\theta_i"),
        }
        rows: list[tuple[str, ...]] = [("i", *heads[robot.convention])]
        for number, joint in enumerate(robot.joints, start=1):
            if robot.convention is Convention.SCREW:
                cells = ["" if vector is None else self.vector(vector) for vector in (joint.s, joint.s0)]
            else:
                row = (joint.alpha, joint.a, joint.d, joint.theta)
                cells = ["" if cell is None else self.formula(cell_tree(cell)) for cell in row]
            rows.append((str(number), *cells))
        return tuple(rows)

    def home(self) -> tuple[Block, ...]:
        """The home pose of a screw table."""
        home = self.derivation.robot.home
        if home is None:
            return ()
        vectors = (("u_{0}", home.u0), ("v_{0}", home.v0), ("w_{0}", home.w0), ("q_{0}", home.q0))
        return aligned(Relation(left=name, right=self.vector(vector)) for name, vector in vectors)

    def fixed(self) -> tuple[Display, ...]:
        """The base and the tool transform."""
        robot = self.derivation.robot
        given = ((_BASE, robot.base), (_TOOL, robot.tool))
        return matrices(
            [
                Matrix(name=name, cells=tuple(tuple(self.formula(cell_tree(cell)) for cell in row) for row in matrix))
                for name, matrix in given
                if matrix is not None
            ]
        )

    def links(self) -> tuple[Display, ...]:
        """The link transforms."""
        return matrices(
            [
                Matrix(
                    name=link(item.name),
                    cells=tuple(tuple(self.formula(cell) for cell in row) for row in item.matrix),
                )
                for item in self.derivation.forward.links
            ]
        )

    def product(self) -> str:
        """The links with what stands before and behind them."""
        robot = self.derivation.robot
        factors = [link(item.name) for item in self.derivation.forward.links]
        if robot.home is not None:
            factors.append(r"\, [\,u_{0}\; v_{0}\; w_{0}\; q_{0}\,]")
        if robot.base is not None:
            factors.insert(0, _BASE + r" \,")
        if robot.tool is not None:
            factors.append(r"\, " + _TOOL)
        return " ".join(factors)

    def entries(self) -> tuple[Block, ...]:
        """The twelve entries of the pose."""
        matrix = self.derivation.forward.pose
        return aligned(
            Relation(left=self.names[name], right=self.formula(matrix[row][column]))
            for column, names in enumerate(POSE)
            for row, name in names
        )

    def jacobian(self) -> tuple[Display, ...]:
        """The Jacobian whole where it fits, else its columns."""
        cells = tuple(tuple(self.formula(cell) for cell in row) for row in self.derivation.jacobian.entries)
        whole = Matrix(name="J", cells=cells)
        if whole.fits:
            return matrices([whole])
        columns = enumerate(zip(*cells, strict=True), start=1)
        return matrices([Matrix(name=f"J_{{{k}}}", cells=tuple((cell,) for cell in column)) for k, column in columns])

    def window(self, loop: Loop) -> Passage:
        """What is left of the loop closure when solved joints have moved to its other side."""
        window = loop.window
        relations = [self.relation(item.name, item.value) for item in window.definitions]
        name = pose(window.left, window.right)
        if loop.whole:
            return Passage(kind="constants", unknown=name, blocks=aligned(relations))
        letter = link_letter(self.derivation.robot)
        factors = [f"{letter}_{{{k}}}^{{-1}}" for k in loop.left]
        factors += [pose(*loop.before), *(f"{letter}_{{{k}}}^{{-1}}" for k in loop.right)]
        head = Relation(left=name, right=r" \, ".join(factors))
        return Passage(
            kind="window", unknown=name, number=window.right if loop.right else 0, blocks=aligned([head, *relations])
        )

    def sentence(self, relation: tuple[Tree, str, Tree] | None) -> Sentence | None:
        """A condition."""
        if relation is None:
            return None
        left, sign, right = relation
        whole = Relation(left=self.formula(left), right=self.formula(right), sign=relation_sign(sign))
        inline = f"{whole.left} {whole.sign} {whole.right}"
        if width(inline) <= _WIDEST_INLINE:
            return Sentence(inline=inline, blocks=())
        return Sentence(inline="", blocks=aligned([whole]))

    def equations(self, equations: Iterable[Equation]) -> tuple[Block, ...]:
        """Equations of the pool."""
        return aligned(Relation(left=self.formula(part.lhs), right=self.formula(part.rhs)) for part in equations)

    def step(self, step: Step, before: Step | None) -> Passage:
        """One step with all that a reader needs to repeat it."""
        solution = []
        for (name, value), mark in zip(step.solution, branch_marks(step), strict=True):
            relation = self.relation(name, value)
            note = f" \\quad (\\text{{branch }}{mark})" if mark else ""
            solution.append(Relation(left=relation.left, right=relation.right + note))
        return Passage(
            kind="step",
            number=step.number,
            unknown=self.names[step.unknown],
            rule=re.sub(r"a c \+ b s = [0e]", r"$\g<0>$", rule_title(step.rule)),
            why=capital(prose(step.why, self.names)),
            branches=step.branches,
            sources=tuple(
                Source(text=prose(origin.text, self.names), blocks=self.equations(origin.equations))
                for origin in origins(step, before)
            ),
            coefficients=self.definitions(step.coefficients),
            solution=aligned(solution),
            condition=self.sentence(step.condition),
            degenerate=self.sentence(step.degenerate),
        )

    def passages(self) -> Iterator[Passage]:
        """The derivation in order; definitions that follow each other stand together."""
        pending: list[Definition] = []
        before: Step | None = None
        windows = loops(self.derivation.plan, self.count)
        for item in shown_items(self.derivation.plan):
            if isinstance(item, Definition):
                pending.append(item)
                continue
            if pending:
                yield Passage(kind="names", blocks=self.definitions(pending))
                pending = []
            if isinstance(item, Window):
                yield self.window(windows[item.left, item.right])
            else:
                yield self.step(item, before)
                before = item
        if pending:
            yield Passage(kind="names", blocks=self.definitions(pending))

    def values(self) -> tuple[Block, ...]:
        """The joint variables that are sums of angles found."""
        found = [value for value in self.derivation.plan.values if found_by_sum(value)]
        return aligned(self.relation(value.variable, value.value) for value in found)

    def parameters(self) -> tuple[Sequence[tuple[str, ...]], ...]:
        """Each parameter: as it is written here, as it stands in the table, its value."""
        rows = [
            (f"${self.names[name]}$", escape(name), "required argument" if value is None else f"${decimal(value)}$")
            for name, value in self.derivation.robot.parameters.items()
        ]
        return tuple(chunks(rows))

    def branch_table(self) -> tuple[Sequence[tuple[str, ...]], ...]:
        """Which sign every solution takes at every branching step."""
        return tuple(chunks([(str(number), *signs) for number, signs in branch_rows(self.derivation.plan)]))


def document(derivation: Derivation) -> str:
    """A standalone article with every equation of a derivation, ready for pdflatex.

    The same derivation gives the same bytes: no date, no path.
    """
    writer = _Writer(derivation)
    robot: Robot = derivation.robot
    plan: Plan = derivation.plan
    table = writer.table()
    forks = branchings(plan)
    context = {
        "name": robot.name,
        "title": escape(robot.title) or escape(robot.name),
        "convention": CONVENTIONS[robot.convention].replace("Denavit-Hartenberg", "Denavit--Hartenberg"),
        "task": TASKS[plan.task],
        "screw": robot.convention is Convention.SCREW,
        "joints": [joint.kind for joint in robot.joints],
        "table": table if table_fits(table) else None,
        "table_rows": [] if table_fits(table) else _listed(table),
        "parameters": writer.parameters(),
        "small": any(len(name) > _LONGEST_NAME for name in robot.parameters),
        "constants": writer.definitions(derivation.schedule.constants),
        "home": writer.home(),
        "fixed": writer.fixed(),
        "turns": writer.turns(),
        "notation": writer.notation(),
        "start": "" if (0, writer.count) in loops(plan, writer.count) else pose(0, writer.count),
        "letter": link_letter(robot),
        "links": writer.links(),
        "product": writer.product(),
        "entries": writer.entries(),
        "axes": writer.definitions(axis_definitions(derivation.forward, derivation.jacobian)),
        "jacobian": writer.jacobian(),
        "passages": tuple(writer.passages()),
        "values": writer.values(),
        "wrapped": any(value.wrapped for value in plan.values if found_by_sum(value)),
        "maximum": plan.maximum,
        "forks": [(fork.number, writer.names[fork.unknown], fork.run) for fork in forks],
        "branches": writer.branch_table() if forks else (),
        "gate": GATE if plan.gate else "",
    }
    text = environment(_DELIMITERS).get_template("latex/document.tex.j2").render(context)
    return re.sub(r"\n{3,}", "\n\n", re.sub(r" +\n", "\n", text))


def _listed(table: Sequence[Sequence[str]]) -> tuple[Block, ...]:
    """A table that is too wide for the page, cell by cell."""
    head, *rows = table
    relations = []
    for number, *cells in rows:
        for name, cell in zip(head[1:], cells, strict=True):
            relations.append(Relation(left=f"\\text{{row {number}: }} {name}", right=cell))
    return aligned(relations)
