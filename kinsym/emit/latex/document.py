"""The LaTeX document of a derivation: table, forward kinematics, Jacobian and the numbered inverse derivation.

This module says what stands in the document, in which order, as formulas; ``templates/latex/derivation.tex.j2`` says
it in sentences and TeX.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from kinsym.algebra.convert import tree_of
from kinsym.emit.latex.article import LEVELS, Frame, framed, rendered
from kinsym.emit.latex.general import general_passages
from kinsym.emit.latex.layout import Block, Display, Matrix, Relation, aligned, chunks, matrices
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.names import link, pose
from kinsym.emit.latex.nominal import about
from kinsym.emit.latex.passages import Formulas, Passages, Sentence
from kinsym.emit.latex.sentences import Words, capital, escape, prose
from kinsym.emit.latex.singular import singular_section
from kinsym.emit.latex.tables import convention_of, row_vector, table_of
from kinsym.emit.prose.nominal import IN_DOUBT
from kinsym.emit.prose.vocabulary import angle_sums, joint_angles
from kinsym.emit.prose.wording import (
    INPUT,
    POSE,
    TASKS,
    axis_definitions,
    branch_rows,
    branchings,
    decimal,
    found_by_sum,
    given_joints,
    loops,
    marks_explained,
    sifting,
)
from kinsym.general.plan import GeneralPlan
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Plan
from kinsym.inverse.state import span
from kinsym.robot.model import Convention, Robot

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

_BASE, _TOOL = r"T_{\mathrm{base}}", r"T_{\mathrm{tool}}"
#: A table of parameters with a longer name than this is set in a smaller type.
_LONGEST_NAME = 24
_WORDS = {2: "two", 4: "four"}
#: A formula wider than this (points) is set apart: inside a sentence it would leave its line half empty.
_WIDEST_INLINE = 110.0


class Writer(Formulas):
    """Turns what is not the inverse derivation into formulas."""

    def notation(self) -> tuple[Block, ...]:
        """The sums of angles that occur, with their shorthand."""
        relations = []
        for angle, total in angle_sums(self.derivation):
            name = self.names[angle.name]
            right = f"{self.formula(total)}, \\quad {self.names[angle.cosine]} = \\cos {name}"
            relations.append(Relation(left=name, right=f"{right}, \\quad {self.names[angle.sine]} = \\sin {name}"))
        return aligned(relations)

    def turns(self) -> tuple[str, ...]:
        """What c_i and s_i mean for the joints of this robot."""
        named = [
            f"{self.names[angle.cosine]} = \\cos {self.names[angle.name]}, "
            f"{self.names[angle.sine]} = \\sin {self.names[angle.name]}"
            for angle in joint_angles(self.derivation)
        ]
        return tuple(named) or (r"c_i = \cos\theta_i, s_i = \sin\theta_i",)

    def home(self) -> tuple[Block, ...]:
        """The home pose of a screw table."""
        home = self.derivation.robot.home
        if home is None:
            return ()
        vectors = (("u_{0}", home.u0), ("v_{0}", home.v0), ("w_{0}", home.w0), ("q_{0}", home.q0))
        return aligned(Relation(left=name, right=row_vector(vector, self.formula)) for name, vector in vectors)

    def fixed(self) -> tuple[Display, ...]:
        """The base and the tool transform."""
        robot = self.derivation.robot
        given = ((_BASE, robot.base), (_TOOL, robot.tool))
        return matrices(
            [
                Matrix(name=name, cells=tuple(tuple(self.formula(tree_of(cell)) for cell in row) for row in matrix))
                for name, matrix in given
                if matrix is not None
            ]
        )

    def given(self) -> tuple[str, ...]:
        """A sentence for each locked joint."""
        return tuple(
            f"${self.names[name]}$ is given, {INPUT}."
            if value is None
            else f"${self.names[name]} = {self.formula(value)}$ is given."
            for name, value in given_joints(self.derivation.robot)
        )

    def assumed(self, plan: Plan | GeneralPlan) -> Sentence:
        """What must not vanish for the inverse kinematics to be right."""
        relations = [Relation(left=self.formula(item.value), right="0", sign=r"\neq") for item in plan.nonzero]
        formulas = [f"{relation.left} {relation.sign} {relation.right}" for relation in relations]
        if max(map(width, formulas), default=0.0) > _WIDEST_INLINE:
            return Sentence(inline="", blocks=aligned(relations))
        return Sentence(inline=", ".join(f"${formula}$" for formula in formulas), blocks=())

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
        """The links, with the home pose behind those of a screw table."""
        factors = [link(item.name) for item in self.derivation.forward.links]
        if self.derivation.robot.home is not None:
            factors.append(r"\, [\,u_{0}\; v_{0}\; w_{0}\; q_{0}\,]")
        return " ".join(factors)

    def framed(self) -> str:
        """T between base and tool, empty where the robot has neither."""
        robot = self.derivation.robot
        if robot.base is None and robot.tool is None:
            return ""
        around = [*([_BASE] if robot.base else []), "T'", *([_TOOL] if robot.tool else [])]
        return r" \, ".join(around)

    def entries(self) -> tuple[Block, ...]:
        """The twelve entries of the pose."""
        matrix = self.derivation.forward.pose
        prime = "'" if self.framed() else ""
        return aligned(
            Relation(left=self.names[name].replace("_", f"{prime}_", 1), right=self.formula(matrix[row][column]))
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

    def values(self, plan: Plan) -> tuple[Block, ...]:
        """The joint variables that are sums of angles found."""
        found = [value for value in plan.values if found_by_sum(value)]
        return aligned(self.relation(value.variable, value.value) for value in found)

    def open_parameters(self) -> tuple[str, ...]:
        """The parameters where none of them has a value."""
        parameters = self.derivation.robot.parameters
        return () if any(value is not None for value in parameters.values()) else tuple(map(self._inline, parameters))

    def parameters(self) -> tuple[Sequence[tuple[str, ...]], ...]:
        """Each parameter where some have values: as it is written here, as it stands in the table, its value."""
        if self.open_parameters():
            return ()
        rows = [
            (self._inline(name), self.words(name), "open" if value is None else f"${decimal(value)}$")
            for name, value in self.derivation.robot.parameters.items()
        ]
        return tuple(chunks(rows))

    def _inline(self, name: str) -> str:
        return f"${self.names[name]}$"

    def branch_table(self, plan: Plan) -> tuple[Sequence[tuple[str, ...]], ...]:
        """Which branch every solution takes at every branching step, and how it is called."""
        named = zip(branch_rows(plan), self.derivation.branches.names, strict=True)
        return tuple(chunks([(str(number), *marks, self.words(name)) for (number, marks), name in named]))

    def meanings(self) -> tuple[tuple[str, str], ...]:
        """What the words of the branches mean: each word and its explanation."""
        parts = (meaning.partition(": ") for meaning in self.derivation.branches.meanings)
        return tuple((self.words(word), self.words(explanation)) for word, _, explanation in parts)

    def closed_form(self, plan: Plan) -> dict[str, Any]:
        """What the document says of an inverse kinematics in closed form."""
        forks = branchings(plan)
        robot = self.derivation.robot
        first, last = span(robot, plan.task)
        return {
            "start": "" if (first, last) in loops(plan, robot) else pose(first, last),
            "passages": tuple(Passages(self.derivation, self.words)),
            "values": self.values(plan),
            "wrapped": any(value.wrapped for value in plan.values if found_by_sum(value)),
            "forks": [(fork.number, self.names[fork.unknown], _WORDS[fork.width]) for fork in forks],
            "signs": marks_explained(plan)[0],
            "numbers": marks_explained(plan)[1],
            "branches": self.branch_table(plan) if forks else (),
            "meanings": self.meanings() if forks else (),
            "gate": sifting(plan),
        }

    def without_closed_form(self, plan: GeneralPlan) -> dict[str, Any]:
        """What it says of one without."""
        return {
            "start": "",
            "why": capital(prose(plan.why, self.names, self.words)),
            "steps": general_passages(self.derivation, plan, self.names, self.words),
        }


def document(derivation: Derivation) -> str:
    """A standalone article with every equation of a derivation, ready for pdflatex."""
    return _page(derivation, "article")


def fragment(derivation: Derivation) -> str:
    """The same as a section, ready for ``\\input`` into another document."""
    return _page(derivation, "fragment")


def _page(derivation: Derivation, frame: Frame) -> str:
    levels = asdict(LEVELS[frame])
    context = context_of(derivation) | levels | {"nominal": "", "in_doubt": IN_DOUBT}
    if derivation.nominal is not None:
        context["nominal"] = rendered(
            "nominal", context_of(derivation.nominal.derivation) | levels | about(derivation.nominal)
        )
    robot = derivation.robot
    return framed(
        frame,
        rendered("derivation", context),
        title=escape(robot.title) or escape(robot.name),
        about=f"{robot.name}: equations derived by kinsym.",
    )


def context_of(derivation: Derivation, words: Words = escape) -> dict[str, Any]:
    """What the templates read of one derivation; ``words`` escapes what is no formula."""
    writer = Writer(derivation, words)
    robot: Robot = derivation.robot
    plan = derivation.plan or derivation.general
    if plan is None:
        raise ValueError(f"{robot.name} has no inverse kinematics")
    held = [item for item in derivation.held if item.name not in robot.locks]
    context: dict[str, Any] = {
        "convention": convention_of(robot),
        "task": TASKS[plan.task],
        "screw": robot.convention is Convention.SCREW,
        "table": table_of(robot, writer.formula),
        "open": writer.open_parameters(),
        "parameters": writer.parameters(),
        "small": any(len(name) > _LONGEST_NAME for name in robot.parameters),
        "constants": writer.definitions(derivation.constants),
        "home": writer.home(),
        "fixed": writer.fixed(),
        "turns": writer.turns(),
        "notation": writer.notation(),
        "given": writer.given(),
        "held": writer.definitions(held),
        "assumed": writer.assumed(plan),
        "letter": link_letter(robot),
        "links": writer.links(),
        "product": writer.product(),
        "framed": writer.framed(),
        "prime": "'" if writer.framed() else "",
        "long": derivation.long,
        "entries": () if derivation.long else writer.entries(),
        "axes": ()
        if derivation.long
        else writer.definitions(axis_definitions(derivation.forward, derivation.jacobian)),
        "jacobian": () if derivation.long else writer.jacobian(),
        "singular_title": "Singular poses",
        "maximum": plan.maximum,
        "poses": singular_section(writer),
        "general": isinstance(plan, GeneralPlan),
    }
    context |= writer.closed_form(plan) if isinstance(plan, Plan) else writer.without_closed_form(plan)
    return context
