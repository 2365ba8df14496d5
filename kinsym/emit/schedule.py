"""One schedule for every language: what is computed, in which order, at which branch depth.

The printers of NumPy and C read this and nothing else. A statement of level k may use everything of levels 0..k;
level k starts after the k-th step that branches. In C a level is a loop, in NumPy it is an axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kinsym.algebra.tree import ONE, Tree
from kinsym.emit.real import DOUBLE, Real
from kinsym.general.plan import GeneralPlan
from kinsym.inverse.families import Family
from kinsym.inverse.plan import Definition, Nonzero, Step
from kinsym.kinematics.singular import SingularSet
from kinsym.robot.model import Deviation, Task


@dataclass(frozen=True, kw_only=True)
class StraightLine:
    """Assignments in order and the row-major values they lead to."""

    definitions: tuple[Definition, ...]
    outputs: tuple[Tree, ...]


@dataclass(frozen=True, kw_only=True)
class Note:
    """A comment before what follows: equation number, rule, the equation in text."""

    level: int
    text: str


@dataclass(frozen=True, kw_only=True)
class Assign:
    """``name = value`` at a branch depth."""

    level: int
    name: str
    value: Tree


@dataclass(frozen=True, kw_only=True)
class Solve:
    """A call of the numerical kernel ``step.rule``; opens level + 1 if ``step.branches`` is above 1."""

    level: int
    step: Step


Statement = Note | Assign | Solve


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A run-time parameter; ``value`` is the table's, None if the caller must give one."""

    name: str
    value: Fraction | None


@dataclass(frozen=True, kw_only=True)
class JointName:
    """A joint variable, its kind, ``"R"`` or ``"P"``, and its limits (low, high), None if it has none."""

    name: str
    kind: str
    limits: tuple[Fraction, Fraction] | None = None


@dataclass(frozen=True, kw_only=True)
class SingularPoses:
    """The singular set, the families of solutions on it and the cosines and sines that both are written in."""

    set: SingularSet
    families: tuple[Family, ...]
    angles: tuple[Definition, ...]


@dataclass(frozen=True, kw_only=True)
class NominalStarts:
    """The closed form of the nominal arm, whose solutions are where Newton's steps with the true arm start.

    ``offsets`` are what its joint values are ahead of the true arm's; ``band`` is how far beside a border of it a root
    is in doubt, as a share of its equation's unit; ``deviation`` says in what the two arms differ.
    """

    schedule: Schedule
    offsets: tuple[Tree, ...]
    band: Fraction
    deviation: Deviation


@dataclass(frozen=True, kw_only=True)
class Schedule:
    """All that a generated module computes.

    constants   derived constants (sqrt(2)*a, cos of a twist), from parameters alone, in order.
    inputs      the locked joints whose values the caller of the inverse kinematics gives.
    held        what the inverse kinematics knows of locked joints (c3, s3, theta5 = pi/4), after the constants.
    forward     12 outputs: rows x, y, z of T, each u, v, w, p.
    jacobian    6 n outputs, row-major: velocity rows first, then angular velocity rows.
    inverse     the statements of the inverse kinematics; the names u_x..p_z are the entries of the pose.
    solution    the names of the joint values, in the order of joints, known at level ``depth``.
    singular    what the comments say of singular poses and the checks try; nothing is computed from it.
    branches    the names of the branches by their number, empty where the solutions have only numbers.
    meanings    what the words in these names mean, one sentence each.
    nominal     the closed form that is asked before the general solver, None where there is none.
    maximum     the largest number of solutions, the product of ``widths``.
    lengths     the sum of the arm's constant lengths.
    nonzero     what must not vanish for the inverse kinematics to be right, over parameters and constants.
    general     the plan of an arm without a closed form; ``inverse`` is empty then.
    real        the type of the numbers in the C; every other language has double precision.
    """

    name: str
    title: str
    table: tuple[str, ...]
    digest: str
    joints: tuple[JointName, ...]
    parameters: tuple[Parameter, ...]
    constants: tuple[Definition, ...]
    forward: StraightLine
    jacobian: StraightLine
    inverse: tuple[Statement, ...]
    solution: tuple[str, ...]
    depth: int
    maximum: int
    task: Task
    gate: bool
    size: Tree
    tau: Fraction
    singular: SingularPoses | None = None
    inputs: tuple[str, ...] = ()
    held: tuple[Definition, ...] = ()
    general: GeneralPlan | None = None
    branches: tuple[str, ...] = ()
    meanings: tuple[str, ...] = ()
    nominal: NominalStarts | None = None
    lengths: Tree = ONE
    nonzero: tuple[Nonzero, ...] = ()
    real: Real = DOUBLE

    @property
    def widths(self) -> tuple[int, ...]:
        """The number of branches of each step that branches; step k opens level k."""
        steps = (statement.step for statement in self.inverse if isinstance(statement, Solve))
        return tuple(step.branches for step in steps if step.branches > 1)

    @property
    def locked(self) -> tuple[str, ...]:
        """The joints that the inverse kinematics does not solve for, in order."""
        held = {*self.inputs, *(item.name for item in self.held)}
        return tuple(joint.name for joint in self.joints if joint.name in held)
