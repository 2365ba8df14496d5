"""How a six-joint arm without a closed form is solved, in words and formulas, for the terminal and for paper."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.emit.prose.general.one_angle import OneAngle
from kinsym.emit.prose.general.stage import Formula, Naming, Stage
from kinsym.emit.prose.general.two_slides import TwoSlides
from kinsym.general.plan import GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

__all__ = ["Formula", "Stage", "stages"]


def stages(derivation: Derivation, plan: GeneralPlan, name: Naming) -> tuple[Stage, ...]:
    """The steps of a general plan in order; ``name`` writes names for LaTeX."""
    words = TwoSlides if plan.suppressed else OneAngle
    return tuple(words(derivation, plan, name).stages())
