"""The inverse kinematics of an arm without a closed form, for a page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from kinsym.emit.html.sentences import braced, capital
from kinsym.emit.html.writer import Writer
from kinsym.emit.latex.general import tex_of
from kinsym.emit.prose.general import Formula, stages
from kinsym.general.plan import GeneralPlan


@dataclass(frozen=True, kw_only=True)
class Stage:
    """One numbered step: what it is about, its title, its sentences and equations."""

    unknowns: Markup
    title: str
    body: Markup


def general_steps(writer: Writer, plan: GeneralPlan) -> dict[str, Any]:
    """What the template reads of a general plan."""
    return {
        "why": capital(writer.sentence(plan.why)),
        "stages": [
            Stage(
                unknowns=Markup(", ").join(writer.name(name) for name in stage.unknowns),
                title=stage.title,
                body=Markup("").join(_piece(writer, piece) for piece in stage.body),
            )
            for stage in stages(writer.derivation, plan, writer.names.__getitem__)
        ],
    }


def _piece(writer: Writer, piece: str | Formula) -> Markup:
    if isinstance(piece, Formula):
        left, right = piece.tex
        return writer.equation(writer.row(left), writer.row(right))
    text = braced(piece, lambda part: writer.tex(tex_of(part, writer.names)))
    return Markup("<p>{}</p>\n").format(capital(text))
