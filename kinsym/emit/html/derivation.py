"""The derivation as HTML: table, forward kinematics, Jacobian, the numbered inverse derivation, singular poses.

This module says what stands there, as formulas; ``templates/html/derivation.html.jinja`` says it in sentences.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from markupsafe import Markup, escape

from kinsym.emit.environment import environment
from kinsym.emit.html.general import general_steps
from kinsym.emit.html.passages import passages
from kinsym.emit.html.singular import singular_section
from kinsym.emit.html.writer import Writer
from kinsym.emit.prose.nominal import (
    BESIDE,
    GUARANTEE,
    HEAD,
    IN_DOUBT,
    NOMINAL,
    SINGULAR,
    TITLE,
    changes,
    difference,
    doubts,
    offsets,
)
from kinsym.emit.prose.wording import (
    CONVENTIONS,
    POSE,
    TASKS,
    axis_definitions,
    decimal,
    found_by_sum,
    loops,
    sifting,
)
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Plan
from kinsym.inverse.state import span
from kinsym.robot.model import Convention

if TYPE_CHECKING:
    from kinsym.derivation import Derivation, Nominal


def derivation_html(derivation: Derivation) -> Markup:
    """The sections of a derivation, from the table to the singular poses; the same bytes for the same derivation."""
    nominal = None if derivation.nominal is None else _nominal(derivation.nominal)
    template = environment(autoescape=True).get_template("html/derivation.html.jinja")
    title = IN_DOUBT if nominal else "Inverse kinematics"
    return Markup(template.render(arm=_context(derivation), nominal=nominal, inverse_title=title))


def _nominal(nominal: Nominal) -> dict[str, Any]:
    """The nominal arm, whose closed form is asked first."""
    found = nominal.stand_in
    return _context(nominal.derivation) | {
        "heading": TITLE,
        "inverse_title": NOMINAL,
        "singular_title": SINGULAR,
        "sentences": (BESIDE, doubts(found.band), GUARANTEE, difference(found.deviation)),
        "head": HEAD,
        "changes": changes(found.deviation),
        "offsets": offsets(found.offsets),
    }


def _context(derivation: Derivation) -> dict[str, Any]:
    """What the template reads of one derivation."""
    writer = Writer(derivation)
    robot, plan = derivation.robot, derivation.plan or derivation.general
    if plan is None:
        raise ValueError(f"{robot.name} has no inverse kinematics")
    held = [item for item in derivation.held if item.name not in robot.locks]
    return {
        "convention": CONVENTIONS[robot.convention],
        "screw": robot.convention is Convention.SCREW,
        "table": writer.table(),
        "parameters": [
            (writer.name(name), name, None if value is None else decimal(value))
            for name, value in robot.parameters.items()
        ],
        "constants": writer.definitions(derivation.constants),
        "home": writer.home(),
        "fixed": writer.fixed(),
        "notation": writer.notation(),
        "given": writer.given(),
        "held": writer.definitions(held),
        "assumed": writer.assumed(plan),
        "links": [writer.matrix(item.name, item.matrix) for item in derivation.forward.links],
        "product": writer.product(),
        "framed": robot.base is not None or robot.tool is not None,
        "long": derivation.long,
        "entries": Markup("") if derivation.long else _entries(writer),
        "axes": Markup("")
        if derivation.long
        else writer.definitions(axis_definitions(derivation.forward, derivation.jacobian)),
        "jacobian": () if derivation.long else writer.jacobian(),
        "singular_title": "Singular poses",
        "singular": singular_section(writer),
        "task": TASKS[plan.task],
        "maximum": plan.maximum,
        "letter": writer.tex(f"{link_letter(robot)}_{{i}}") if link_letter(robot) != "A" else "",
        "closed": isinstance(plan, Plan),
        **(_closed_form(writer, plan) if isinstance(plan, Plan) else general_steps(writer, plan)),
    }


def _entries(writer: Writer) -> Markup:
    """The twelve entries of the pose, primed where base and tool stand around it."""
    robot, matrix = writer.derivation.robot, writer.derivation.forward.pose
    prime = "'" if robot.base is not None or robot.tool is not None else ""
    return Markup("").join(
        writer.equation(writer.row(writer.names[name].replace("_", f"{prime}_", 1)), matrix[row][column])
        for column, names in enumerate(POSE)
        for row, name in names
    )


def _closed_form(writer: Writer, plan: Plan) -> dict[str, Any]:
    """What is said of an inverse kinematics in closed form."""
    derivation = writer.derivation
    whole = span(derivation.robot, plan.task)
    found = [value for value in plan.values if found_by_sum(value)]
    return {
        "start": ""
        if whole in loops(plan, derivation.robot)
        else writer.tex(f"{{}}^{{{whole[0]}}}T_{{{whole[1]}}} = T"),
        "passages": tuple(passages(writer, plan)),
        "joint_values": Markup("").join(writer.definition(value.variable, value.value) for value in found),
        "wrapped": any(value.wrapped for value in found),
        "meanings": [escape(meaning) for meaning in derivation.branches.meanings],
        "gate": sifting(plan),
    }
