"""The parts of a derivation as Markdown: forward and inverse kinematics, single steps, Jacobian, singular poses.

What stands in them, as formulas, is said by the LaTeX document; ``templates/markdown`` says it in sentences.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from kinsym.emit.environment import render
from kinsym.emit.latex.document import Writer, context_of
from kinsym.emit.latex.nominal import about
from kinsym.emit.latex.passages import Passages
from kinsym.emit.latex.singular import singular_section
from kinsym.emit.markdown.robot import robot
from kinsym.emit.markdown.words import table, words
from kinsym.emit.prose.nominal import IN_DOUBT
from kinsym.emit.prose.singular import listed
from kinsym.emit.prose.wording import axis_definitions
from kinsym.inverse.plan import Step
from kinsym.robot.model import Convention

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

Fork = tuple[int, str, str]
"""A step with several solutions: its number, its unknown as mathematics, and how many in words."""


def forward(derivation: Derivation) -> str:
    """The link transforms, their product and the entries of the pose."""
    writer = Writer(derivation, words)
    return _rendered(
        "forward",
        {
            "screw": derivation.robot.convention is Convention.SCREW,
            "links": writer.links(),
            "product": writer.product(),
            "framed": writer.framed(),
            "long": derivation.long,
            "entries": () if derivation.long else writer.entries(),
            "turns": writer.turns(),
            "notation": writer.notation(),
            "constants": writer.definitions(derivation.constants),
        },
    )


def jacobian(derivation: Derivation) -> str:
    """The geometric Jacobian, and the names that it is written in."""
    writer = Writer(derivation, words)
    axes = () if derivation.long else axis_definitions(derivation.forward, derivation.jacobian)
    return _rendered(
        "jacobian",
        {
            "long": derivation.long,
            "axes": writer.definitions(axes),
            "jacobian": () if derivation.long else writer.jacobian(),
        },
    )


def inverse(derivation: Derivation) -> str:
    """The numbered derivation and its solutions; that of the nominal arm first, if there is one."""
    context = context_of(derivation, words) | _TABLES | {"nominal": "", "in_doubt": IN_DOUBT}
    if derivation.nominal is not None:
        arm = derivation.nominal.derivation
        said = context_of(arm, words) | _TABLES | about(derivation.nominal, words) | {"robot": robot(arm.robot)}
        context["nominal"] = _rendered("nominal", said)
    return _rendered("inverse", context)


def step(derivation: Derivation, of: Step, before: Step | None) -> str:
    """One step; ``before`` is the one before it, whose equations are not shown twice."""
    return _rendered("step", {"item": Passages(derivation, words).step(of, before)})


def singular(derivation: Derivation) -> str:
    """det J in factors, what each of them means, and where a joint is free."""
    return _rendered("singular", {"poses": singular_section(Writer(derivation, words))})


def whole(derivation: Derivation) -> str:
    """Everything in the order of the lecture."""
    parts = (
        robot(derivation.robot),
        "#### Forward kinematics",
        forward(derivation),
        "#### Inverse kinematics",
        inverse(derivation),
        "#### Singular poses",
        singular(derivation),
    )
    return "\n\n".join(parts)


def _counted_by(forks: Sequence[Fork], maximum: int) -> str:
    r"""How many solutions there are, and which steps part them.

    >>> _counted_by([(1, r"\theta_1", "two"), (3, r"\theta_3", "two")], 4)
    'There are at most $4$ solutions: two at step 1 ($\\theta_1$) and two at step 3 ($\\theta_3$).'
    """
    places = listed([f"{word} at step {number} (${unknown}$)" for number, unknown, word in forks])
    return f"There are at most ${maximum}$ solutions: {places}."


def _branch_table(forks: Sequence[Fork], rows: Iterable[Sequence[str]]) -> str:
    """Which root every solution takes at each step that has several, and its name."""
    head = ("solution", *(f"${unknown}$" for _, unknown, _ in forks), "branch")
    return table(head, ((number, *(f"${mark}$" for mark in marks), name) for number, *marks, name in rows))


_TABLES: dict[str, Any] = {"table": table, "counted_by": _counted_by, "branch_table": _branch_table}


def _rendered(template: str, context: dict[str, Any]) -> str:
    """A template filled in, with one blank line between its paragraphs."""
    lines: list[str] = []
    for line in render(f"markdown/{template}.md.jinja", **context).splitlines():
        if line.strip() or (lines and lines[-1]):
            lines.append(line.rstrip())
    return "\n".join(lines).strip("\n")
