"""The inverse kinematics of an arm without a closed form, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.emit.prose.general import Formula, stages
from kinsym.emit.prose.wording import TASKS
from kinsym.emit.text.given import assumed, given, held
from kinsym.emit.text.page import Page
from kinsym.general.plan import GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


def general_steps(derivation: Derivation, plan: GeneralPlan, page: Page) -> str:
    """Why there is no closed form, and the numbered steps that take its place."""
    parts = [
        "\n".join(
            [
                page.prose(f"given: {TASKS[plan.task]}, as entries of T = [u v w p]"),
                *given(derivation.robot, page),
                *held(derivation, page),
                *assumed(plan, page),
                page.prose(f"{plan.why}."),
                page.prose("So one angle is the root of a polynomial, and the others follow from linear equations:"),
            ]
        )
    ]
    for number, stage in enumerate(stages(derivation, plan, str), start=1):
        head = ", ".join(stage.unknowns)
        lines = [f"  {number}. {head}: {stage.title}" if head else f"  {number}. {stage.title}"]
        for piece in stage.body:
            if isinstance(piece, Formula):
                lines.append(page.equation(*piece.text, indent=8))
            else:
                lines.append(page.prose(piece.replace("{", "").replace("}", ""), indent=6))
        parts.append("\n".join(lines))
    return "\n\n".join(parts)
