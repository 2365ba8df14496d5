"""The way to one unknown of an arm without a closed form, for a student: why no rule applies, then the elimination."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from kinsym.emit.prose.general import Stage, stages
from kinsym.emit.prose.wording import TASKS, counted
from kinsym.emit.text.equations import heading
from kinsym.emit.text.explain import title
from kinsym.emit.text.general import stage_head, stage_text
from kinsym.emit.text.given import assumed, given, held
from kinsym.emit.text.page import Page
from kinsym.general.plan import GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

#: How the stage is called that gives the first of all values.
_ROOT = "the root of"


def elimination(derivation: Derivation, plan: GeneralPlan, unknowns: Sequence[str], page: Page) -> str:
    """The stages up to the last that holds one of the unknowns; with all of them, every stage."""
    robot = derivation.robot
    one = unknowns[0] if len(unknowns) == 1 else ""
    found = stages(derivation, plan, str)
    last = known_after(found, one) if one else len(found)
    parts = [
        title(derivation, unknowns),
        "\n".join(
            [
                page.prose(f"Given: {TASKS[plan.task]}, as entries of the pose T = [u v w p]."),
                *given(robot, page),
                *held(derivation, page),
                *assumed(plan, page),
            ]
        ),
        "\n".join(
            [
                heading("Why there is no closed form"),
                page.prose(f"{plan.why}."),
                page.prose(
                    "Where the rules end, every equation that is left holds several unknowns. They have to be"
                    " eliminated all at once, until one unknown is left in one polynomial. There are up to"
                    f" {counted(plan.maximum, 'solution')}, found by numbers: the roots of the polynomial, and the"
                    " other unknowns from linear equations at each of them."
                ),
            ]
        ),
        "\n".join(
            [heading("The way"), *(f"  {stage_head(number, stage)}" for number, stage in enumerate(found, start=1))]
        ),
    ]
    if last < len(found):
        parts.append(page.prose(f"{one} is known after step {last}; what comes later is left out here."))
    parts.append(heading("Step by step"))
    parts[-1] += "\n" + "\n\n".join(stage_text(number, found[number - 1], page) for number in range(1, last + 1))
    return "\n\n".join(parts) + "\n"


def known_after(found: Sequence[Stage], unknown: str) -> int:
    """The number of the stage after which an unknown has a value: its last one, and none before the root is found.

    >>> stages = [Stage(("b",), "from the orientation, for a value of a", ()), Stage(("a",), "the root of f", ())]
    >>> known_after(stages, "b")
    2
    """
    return max(
        number
        for number, stage in enumerate(found, start=1)
        if unknown in stage.unknowns or stage.title.startswith(_ROOT)
    )
