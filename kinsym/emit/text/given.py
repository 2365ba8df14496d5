"""What the inverse kinematics is given of locked joints, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.emit.prose.wording import INPUT, given_joints
from kinsym.emit.text.page import Page
from kinsym.general.plan import GeneralPlan
from kinsym.inverse.plan import Plan
from kinsym.robot.model import Robot

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


def given(robot: Robot, page: Page) -> list[str]:
    """A line for each locked joint."""
    return [
        page.prose(f"{name} is given, {INPUT}" if value is None else f"{name} = {page.formula(value)} is given")
        for name, value in given_joints(robot)
    ]


def assumed(plan: Plan | GeneralPlan, page: Page) -> list[str]:
    """A line for what must not vanish, if there is anything."""
    conditions = [f"{page.formula(item.value)} != 0" for item in plan.nonzero]
    return [page.prose(f"for {', '.join(conditions)}")] if conditions else []


def held(derivation: Derivation, page: Page) -> list[str]:
    """A line for each constant that a locked joint makes: its cosine and sine, entries of what it holds together."""
    locks = derivation.robot.locks
    return [page.equation(item.name, item.value) for item in derivation.held if item.name not in locks]
