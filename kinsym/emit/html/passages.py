"""The numbered inverse derivation as passages of a page: what moves, what is named, what each step solves."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from markupsafe import Markup, escape

from kinsym.algebra.tree import Definition
from kinsym.emit.html.sentences import capital
from kinsym.emit.html.writer import Writer
from kinsym.emit.latex.names import pose
from kinsym.emit.prose.wording import Loop, branch_marks, loops, origins, rule_title, shown_items
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Plan, Step, Window

_COUNTS = {1: "one solution", 2: "two solutions", 4: "at most four solutions"}


NOTHING = Markup("")


@dataclass(frozen=True, kw_only=True)
class Passage:
    """One item of the derivation; ``kind`` is ``"constants"``, ``"window"``, ``"names"`` or ``"step"``.

    ``sources`` are the places that the equations of a step come from, each with its equations.
    """

    kind: str
    equations: Markup = NOTHING
    number: int = 0
    unknown: Markup = NOTHING
    rule: Markup = NOTHING
    why: Markup = NOTHING
    branches: str = ""
    sources: tuple[tuple[Markup, Markup], ...] = ()
    coefficients: Markup = NOTHING
    solution: Markup = NOTHING
    condition: Markup = NOTHING
    degenerate: Markup = NOTHING


def passages(writer: Writer, plan: Plan) -> Iterator[Passage]:
    """The derivation in order; definitions that follow each other stand together."""
    pending: list[Definition] = []
    before: Step | None = None
    windows = loops(plan, writer.derivation.robot)
    for item in (*shown_items(plan), None):
        if isinstance(item, Definition):
            pending.append(item)
            continue
        if pending:
            yield Passage(kind="names", equations=writer.definitions(pending))
            pending = []
        if isinstance(item, Window):
            yield _window(writer, windows[item.left, item.right])
        elif isinstance(item, Step):
            yield _step(writer, item, before)
            before = item


def _window(writer: Writer, loop: Loop) -> Passage:
    """What is left of the loop closure when solved joints have moved to its other side."""
    window = loop.window
    name = pose(window.left, window.right)
    definitions = writer.definitions(window.definitions)
    if loop.whole:
        return Passage(kind="constants", unknown=writer.tex(name), equations=definitions)
    letter = link_letter(writer.derivation.robot)
    factors = [f"{letter}_{{{k}}}^{{-1}}" for k in loop.left]
    factors += [pose(*loop.before), *(f"{letter}_{{{k}}}^{{-1}}" for k in loop.right)]
    head = writer.equation(writer.row(name), writer.row(r" \, ".join(factors)))
    return Passage(
        kind="window",
        unknown=writer.tex(name),
        number=window.right if loop.right else 0,
        equations=head + definitions,
    )


def _step(writer: Writer, step: Step, before: Step | None) -> Passage:
    """One step with all that a reader needs to repeat it."""
    marked = zip(step.solution, branch_marks(step), strict=True)
    return Passage(
        kind="step",
        number=step.number,
        unknown=writer.name(step.unknown),
        rule=_rule(writer, rule_title(step.rule)),
        why=capital(writer.sentence(step.why)),
        branches=_COUNTS[step.branches],
        sources=tuple(
            (
                writer.sentence(origin.text),
                Markup("").join(writer.equation(writer.formula(part.lhs), part.rhs) for part in origin.equations),
            )
            for origin in origins(step, before)
        ),
        coefficients=writer.definitions(step.coefficients),
        solution=Markup("").join(
            writer.definition(name, value, note=f"(branch {mark.replace('-', '−')})" if mark else "")
            for (name, value), mark in marked
        ),
        condition=writer.relation(step.condition) if step.condition else NOTHING,
        degenerate=writer.relation(step.degenerate) if step.degenerate else NOTHING,
    )


def _rule(writer: Writer, title: str) -> Markup:
    """The name of a rule, the equation in it as mathematics."""
    parts = re.split(r"(a c \+ b s = [0e])", title)
    pieces = (writer.tex(part.replace(" ", r"\,")) if k % 2 else escape(part) for k, part in enumerate(parts))
    return Markup("").join(pieces)
