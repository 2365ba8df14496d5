"""The plan: the one object that the terminal, LaTeX, NumPy, C and the exact walk all read.

A plan is an ordered list of items. A :class:`Definition` names a quantity, a :class:`Window` names the entries of
the pose that is left when solved joints have been moved to the other side of the loop closure, and a
:class:`Step` finds one unknown by one rule.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kinsym.algebra.tree import Definition, Tree
from kinsym.robot.model import Task

__all__ = ["Definition", "Equation", "Item", "JointValue", "Nonzero", "Plan", "Step", "Window"]


@dataclass(frozen=True, kw_only=True)
class Window:
    """The loop closure with solved joints moved to the left: T_left_right = (A_1..A_left)^-1 T (...)^-1.

    ``left`` and ``right`` are joint numbers: T_left_right is the product of the link transforms of joints
    left+1..right, without the constant part that follows joint ``right``. ``definitions`` holds only the
    entries that later items use.
    """

    left: int
    right: int
    definitions: tuple[Definition, ...]


@dataclass(frozen=True, kw_only=True)
class Equation:
    """One scalar equation of the pool: the pose is on the left, the joints between the cuts on the right.

    ``source`` says where it comes from, for example ``"row z, column p of A1^-1 T_0_6 = A2 A3 A4 A5 A6"``.
    """

    lhs: Tree
    rhs: Tree
    source: str


@dataclass(frozen=True, kw_only=True)
class Step:
    """One unknown found by one rule.

    unknown       ``"theta1"``, ``"theta234"`` (a sum), ``"d3"``.
    rule          key of the registry in :mod:`kinsym.inverse.rules`; it is also the name of the numerical kernel.
    equations     what it solves, in the lecture's form.
    coefficients  named quantities that the kernel reads, defined just before it runs (may be empty: see inputs).
    inputs        the kernel's arguments by name, each a tree over known names.
    outputs       ``("c1", "s1")`` for an angle, ``("d3",)`` for a length, plus what the kernel gives beside it.
    branches      how many values at most the unknown takes for each branch before it: 1, 2 or 4.
    reference     the joints whose reference values are added (with these signs) when the unknown is free.
    solution      the formula a reader sees, over the names in coefficients.
    condition     when there is a real solution, in words and symbols; empty if always.
    degenerate    when the unknown is free, in words and symbols; empty if never.
    why           why this rule and this equation, one sentence.
    """

    number: int
    unknown: str
    rule: str
    equations: tuple[Equation, ...]
    coefficients: tuple[Definition, ...]
    inputs: dict[str, Tree]
    outputs: tuple[str, ...]
    branches: int
    reference: tuple[tuple[str, int], ...]
    solution: tuple[tuple[str, Tree], ...]
    condition: tuple[Tree, str, Tree] | None
    degenerate: tuple[Tree, str, Tree] | None
    why: str


Item = Definition | Window | Step


@dataclass(frozen=True, kw_only=True)
class JointValue:
    """A joint variable in terms of what the steps found.

    An angle is either ``Atan2(s, c)`` of a solved pair or a signed sum of angles found before; sums are wrapped
    into (-pi, pi]. A prismatic joint is its own name.
    """

    variable: str
    value: Tree
    wrapped: bool


@dataclass(frozen=True, kw_only=True)
class Nonzero:
    """A constant of the table that must not vanish.

    value       a parameter, the cosine or sine of a twist, or a factor of a denominator.
    unit        1 for a length, which must exceed ``tau`` times the sum of the arm's lengths, 0 for a number, which must
                exceed ``tau``; None for what must exceed 0.
    parameters  the parameters that it depends on.
    """

    value: Tree
    unit: int | None
    parameters: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The inverse kinematics of one robot for one task.

    ``values`` has no entry for a locked joint.
    ``maximum`` is the product of the branches. ``gate`` tells that a pose may ask for more than the joints can choose,
    so that a solution counts only if its forward kinematics reaches it. ``size`` is the arm's length, the unit of
    tolerances, and ``tau`` the accuracy to which a pose is taken as given. ``nonzero`` is what must not vanish for the
    plan to be right; where it does another one is.
    """

    task: Task
    items: tuple[Item, ...]
    values: tuple[JointValue, ...]
    maximum: int
    gate: bool
    size: Tree
    tau: Fraction = Fraction(1, 2**46)
    nonzero: tuple[Nonzero, ...] = ()

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps alone, in order."""
        return tuple(item for item in self.items if isinstance(item, Step))
