"""The inverse kinematics of an arm without a closed form, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.emit.prose.general import Formula, Stage, stages
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
    parts += (stage_text(number, stage, page) for number, stage in enumerate(stages(derivation, plan, str), start=1))
    return "\n\n".join(parts)


def stage_head(number: int, stage: Stage) -> str:
    """The number of a step, its unknowns and what happens to them."""
    head = ", ".join(stage.unknowns)
    return f"{number}. {head}: {stage.title}" if head else f"{number}. {stage.title}"


def stage_text(number: int, stage: Stage, page: Page) -> str:
    """A step with its sentences and formulas."""
    lines = [f"  {stage_head(number, stage)}"]
    for piece in stage.body:
        if isinstance(piece, Formula):
            lines.append(page.equation(*piece.text, indent=8))
        else:
            lines.append(page.prose(piece.replace("{", "").replace("}", ""), indent=6))
    return "\n".join(lines)
