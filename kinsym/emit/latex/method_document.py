"""A method of the lecture applied to one robot, as a document of its own or as a fragment."""

from __future__ import annotations

from kinsym.emit.latex.article import LEVELS, Frame, framed, rendered
from kinsym.emit.latex.branch_tree import Fork, branch_tree
from kinsym.emit.latex.methods import MethodPage
from kinsym.emit.latex.sentences import escape
from kinsym.emit.latex.tables import convention_of, table_of
from kinsym.methods.document import MethodDerivation, Solution
from kinsym.robot.model import Robot

_SEVERAL = 2


def method_document(robot: Robot, derivation: MethodDerivation, frame: Frame = "article") -> str:
    """A derivation by a method under the table of its robot."""
    page = MethodPage(derivation)
    body = rendered(
        "method",
        {
            "section": LEVELS[frame].section,
            "convention": convention_of(robot),
            "table": table_of(robot, page.formula),
            "heading": escape(derivation.title),
            "lines": page.lines(),
            "solutions": solutions_section(page),
        },
    )
    return framed(
        frame,
        body,
        title=escape(robot.title) or escape(robot.name),
        about=f"{robot.name}, {derivation.title}: derived by kinsym.",
        referring=True,
    )


def solutions_section(page: MethodPage) -> str:
    """The unknowns with their equations, and the tree of their values; empty where that is less than two unknowns."""
    solutions = page.derivation.solutions
    if len(solutions) < _SEVERAL:
        return ""
    rows = []
    for solution in solutions:
        equations = ", ".join(f"\\eqref{{{page.label(equation.name)}}}" for equation in solution.equations)
        conditions = ", ".join(f"\\eqref{{{page.label(equation.name)}}}" for equation in solution.conditions)
        rows.append((f"${page.names[solution.unknown]}$", equations, str(solution.branches), conditions))
    forks = [Fork(unknown=page.names[solution.unknown], marks=_marks(page, solution)) for solution in solutions]
    return rendered("solutions", {"rows": rows, "tree": branch_tree(forks)})


def _marks(page: MethodPage, solution: Solution) -> tuple[str, ...]:
    """How the values of an unknown are told apart: by equations, by the signs of ±, by the numbers of roots."""
    if solution.branches == 1:
        return ("",)
    if len(solution.equations) == solution.branches:
        return tuple(f"\\text{{\\eqref{{{page.label(equation.name)}}}}}" for equation in solution.equations)
    if solution.branches == 2:
        return ("+", "-")
    return tuple(str(number) for number in range(1, solution.branches + 1))
