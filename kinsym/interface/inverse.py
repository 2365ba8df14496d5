"""The inverse kinematics as a user of Python meets it: steps to read, a function to call."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.emit.markdown import derivation as markdown
from kinsym.emit.prose.wording import rule_title
from kinsym.emit.text.equations import inverse_sections, step_text
from kinsym.interface.formulas import Formulas, Module
from kinsym.inverse.plan import Step

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats


@dataclass(frozen=True, eq=False, repr=False)
class InverseStep(Formulas):
    """One step of the derivation: one unknown, found by one rule."""

    step: Step
    before: Step | None

    @property
    def unknown(self) -> str:
        """What it finds: ``"theta1"``, ``"theta234"`` (a sum), ``"d3"``."""
        return self.step.unknown

    @property
    def rule(self) -> str:
        """The rule in a reader's words."""
        return rule_title(self.step.rule)

    @property
    def why(self) -> str:
        """Why this rule and these equations."""
        return self.step.why

    @property
    def branches(self) -> int:
        """How many values the unknown takes at most."""
        return self.step.branches

    def text(self) -> str:
        """The step for a terminal."""
        return step_text(self.step, self.before)

    def markdown(self) -> str:
        """The step as Markdown."""
        return markdown.step(self.derivation, self.step, self.before)

    def __repr__(self) -> str:
        return f"<step {self.step.number} of {self.derivation.robot.name}: {self.unknown}>"


@dataclass(frozen=True, eq=False, repr=False)
class InverseKinematics(Formulas):
    """The derivation step by step; called with a pose it returns all solutions.

    As a sequence it holds its steps, and ``ik["theta3"]`` is the step that finds theta3. An arm without a closed form
    has no steps of this kind; its page shows the polynomial and what follows from its roots.
    """

    module: Module

    def __call__(self, pose: ArrayLike, *, reference: ArrayLike | None = None, **parameters: float) -> Floats:
        """All solutions (m, n) of one pose (4, 4), angles in radians; m = 0 if it is out of reach.

        A joint that is free takes its value in ``reference`` (n,), default 0. Parameters without a value and locked
        joints that are inputs are given by their names. Raises TypeError where one is missing, ValueError for what is
        no pose.
        """
        result: Floats = self.module().ik(pose, reference=reference, **parameters)
        return result

    def text(self) -> str:
        """The derivation and its solutions for a terminal."""
        return "\n\n".join(inverse_sections(self.derivation))

    def markdown(self) -> str:
        """The same as Markdown."""
        return markdown.inverse(self.derivation)

    @property
    def closed_form(self) -> bool:
        """Whether every unknown has a formula; otherwise one angle is the root of a polynomial."""
        return self.derivation.plan is not None

    @property
    def maximum(self) -> int:
        """How many solutions a pose has at most."""
        plan = self.derivation.plan or self.derivation.general
        return plan.maximum if plan else 0

    @property
    def branches(self) -> tuple[str, ...]:
        """The names of the branches, in the order of the generated code; empty where there is no closed form."""
        return self.derivation.branches.names

    @property
    def steps(self) -> tuple[InverseStep, ...]:
        """The steps in order."""
        steps = self.derivation.plan.steps if self.derivation.plan else ()
        return tuple(
            InverseStep(self.derivation, step, before) for step, before in zip(steps, (None, *steps), strict=False)
        )

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[InverseStep]:
        return iter(self.steps)

    def __getitem__(self, unknown: str | int) -> InverseStep:
        """The step that finds an unknown, or the step at a place; KeyError with the unknowns there are."""
        if isinstance(unknown, int):
            return self.steps[unknown]
        for step in self.steps:
            if step.unknown == unknown:
                return step
        found = ", ".join(step.unknown for step in self.steps)
        raise KeyError(f"no step finds {unknown!r}; the steps find {found or 'nothing: there is no closed form'}")
