"""A serial robot as its user writes it: one table, and what belongs to it.

Cells are exact SymPy expressions (rationals, ``pi``, names); nothing here is a float but the default values of
parameters, and those are exact rationals as well. The lecture's three tables are Craig's and Paul's
Denavit-Hartenberg tables (sections 3.2.2, 3.2.3) and the table of joint screws (section 3.3).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from typing import TYPE_CHECKING

from kinsym.display import Displayed

if TYPE_CHECKING:
    from sympy import Expr

Vector = tuple["Expr", "Expr", "Expr"]
Matrix = tuple[tuple["Expr", ...], ...]


class Convention(str, Enum):
    """How a row of the table becomes a link transform."""

    PAUL = "paul"
    CRAIG = "craig"
    SCREW = "screw"


class Task(str, Enum):
    """The part of the pose that the inverse kinematics is asked to reach."""

    POSE = "pose"
    POSITION = "position"
    ORIENTATION = "orientation"
    PLANAR = "planar"
    SCARA = "scara"
    POSITION_AXIS = "position_axis"


@dataclass(frozen=True, kw_only=True)
class Joint:
    """One row of the table.

    ``kind`` is ``"R"``, ``"P"`` or ``"fixed"`` (a constant row without a variable). Denavit-Hartenberg rows fill
    ``alpha``, ``a``, ``d``, ``theta`` with the joint variable inside ``theta`` (R) or ``d`` (P); screw rows fill
    ``s`` (unit direction) and ``s0`` (a point of the axis) at the home pose. ``limits`` are (low, high).
    """

    kind: str
    variable: str | None
    alpha: Expr | None = None
    a: Expr | None = None
    d: Expr | None = None
    theta: Expr | None = None
    s: Vector | None = None
    s0: Vector | None = None
    limits: tuple[Fraction, Fraction] | None = None


@dataclass(frozen=True, kw_only=True)
class Home:
    """The end-effector frame at the home pose of a screw table: axes u0, v0, w0 and origin q0."""

    u0: Vector
    v0: Vector
    w0: Vector
    q0: Vector


@dataclass(frozen=True, kw_only=True)
class Change:
    """One number that is read as a special value: where it stands, both as text, and by how much they differ.

    ``difference`` is in radians for an angle and in the table's unit for a length.
    """

    where: str
    written: str
    read_as: str
    difference: float


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """How far the table is from the numbers it was read from.

    ``position`` and ``rotation`` are the largest difference of the forward kinematics over sampled joint vectors, in
    the table's unit of length and in radians. A conversion without changes still has one: cells are decimals.
    """

    changes: tuple[Change, ...]
    position: float
    rotation: float

    def sentence(self) -> str:
        """The deviation in words."""
        count = len(self.changes)
        values = "a special value" if count == 1 else "special values"
        numbers = f"{count} number{'s' * (count != 1)} read as {values}" if count else "no number changed"
        if self.position == self.rotation == 0:
            return f"{numbers}; the forward kinematics is that of the numbers as written."
        return (
            f"{numbers}; the forward kinematics differs from the numbers as written by at most "
            f"{self.position:.1e} in position and {self.rotation:.1e} rad."
        )


@dataclass(frozen=True, kw_only=True)
class Robot(Displayed):
    """A serial robot.

    ``parameters`` lists every free name of the table in order of first use, with its value or None.
    ``base`` and ``tool`` are 4x4 matrices or None. ``task`` is None when the user leaves the choice to kinsym.
    ``locks`` holds the joints that the inverse kinematics does not solve for, in their order: each with the value that
    it is held at (radians or length), or None where the caller of the solver gives it.
    ``nominal`` asks for the closed form of the special arm next to this one, corrected by its own forward kinematics.
    ``deviation`` says what was read otherwise than written, None if nothing was.
    """

    name: str
    title: str
    convention: Convention
    joints: tuple[Joint, ...]
    parameters: dict[str, Fraction | None] = field(default_factory=dict)
    task: Task | None = None
    home: Home | None = None
    base: Matrix | None = None
    tool: Matrix | None = None
    locks: dict[str, Expr | None] = field(default_factory=dict)
    nominal: bool = False
    source: str = ""
    notes: tuple[str, ...] = ()
    deviation: Deviation | None = None

    @property
    def moving(self) -> tuple[Joint, ...]:
        """The rows that carry a joint variable."""
        return tuple(joint for joint in self.joints if joint.variable is not None)

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables in order, for example ``("theta1", "theta2", "d3")``."""
        return tuple(joint.variable for joint in self.joints if joint.variable is not None)

    @property
    def unlocked(self) -> tuple[int, ...]:
        """The numbers, counted from 1 among the moving joints, of those that the inverse kinematics solves for."""
        return tuple(i for i, variable in enumerate(self.variables, start=1) if variable not in self.locks)
