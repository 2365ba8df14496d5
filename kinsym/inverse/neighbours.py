"""Arms next to one without a closed form: which cells of its table would have to be zero.

Three consecutive axes i, i+1, i+2 meet in a point if a_i = a_i+1 = d_i+1 = 0 in Paul's table, and are parallel if
alpha_i and alpha_i+1 are multiples of pi (Pieper 1968). The triples that need the fewest changes are worth naming.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from sympy import Expr, Integer, Symbol, pi

from kinsym.errors import RobotError
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.links import held_at
from kinsym.robot.model import Convention, Joint, Robot

ZERO = Integer(0)
MEET, PARALLEL = "meet", "be parallel"


@dataclass(frozen=True)
class Miss:
    """Two axes that miss each other: the cell ``name`` of Paul's table is not zero but ``value``."""

    first: int
    second: int
    cell: str
    row: int
    value: Expr

    @property
    def name(self) -> str:
        """What the table calls it: its symbol, or its place where a number stands."""
        return f"{self.cell}{self.row}" if self.value.is_number else str(self.value)

    def __str__(self) -> str:
        amount = f"{self.name} = {self.value}" if self.value.is_number else self.name
        verb = "are turned" if self.cell == "alpha" else "miss"
        return f"axes {self.first} and {self.second} {verb} by {amount}"


@dataclass(frozen=True)
class Change:
    """What would make three consecutive axes meet or be parallel."""

    axes: tuple[int, int, int]
    effect: str
    misses: tuple[Miss, ...]

    def __str__(self) -> str:
        zeros = " = ".join(dict.fromkeys(miss.name for miss in self.misses))
        return f"with {zeros} = 0 axes {', '.join(map(str, self.axes))} would {self.effect}"

    def made(self, table: Robot) -> Robot:
        """The arm of Paul's table with the cells set to zero."""
        joints = list(table.joints)
        for miss in self.misses:
            place = miss.row - 1
            cells: dict[str, Expr] = {miss.cell: ZERO}
            joints[place] = replace(joints[place], **cells)
        return replace(table, joints=tuple(joints))


def paul_table(chain: Chain) -> Robot | None:
    """The arm as a table of Paul's, what lies before the first axis left out; None where no exact one exists."""
    robot = _held(chain.robot)
    if robot is None:
        return None
    plain = all(joint.variable is not None for joint in robot.joints)
    if robot.convention is Convention.PAUL and plain:
        return robot
    if robot.convention is Convention.CRAIG and plain:
        after = [*robot.joints[1:], Joint(kind="fixed", variable=None, alpha=ZERO, a=ZERO)]
        joints = [replace(j, alpha=k.alpha, a=k.a) for j, k in zip(robot.joints, after, strict=True)]
        return replace(robot, convention=Convention.PAUL, joints=tuple(joints))
    try:
        return convert(robot, Convention.PAUL)
    except RobotError:
        return None


def _held(robot: Robot) -> Robot | None:
    """The arm whose locked joints are constant rows; an input is a parameter. None for locked screws."""
    if not robot.locks:
        return robot
    if robot.convention is Convention.SCREW:
        return None
    joints = list(robot.joints)
    for place, joint in enumerate(joints):
        if joint.variable in robot.locks:
            at = {Symbol(joint.variable, real=True): held_at(robot, joint.variable)}
            cells = {name: (getattr(joint, name) or ZERO).subs(at) for name in ("d", "theta")}
            joints[place] = replace(joint, kind="fixed", variable=None, limits=None, **cells)
    inputs = {name: None for name, value in robot.locks.items() if value is None}
    return replace(robot, joints=tuple(joints), parameters={**robot.parameters, **inputs}, locks={})


def changes(table: Robot, numbers: Sequence[int]) -> list[Change]:
    """For each consecutive triple of revolute axes what it lacks, the least first; none that lacks nothing.

    ``numbers`` are those of the axes in the whole arm, of which locked joints are no part here.
    """
    rows = table.joints
    found: list[Change] = []
    for i in reversed(range(len(rows) - 2)):
        if any(row.kind != "R" for row in rows[i : i + 3]):
            continue
        first, second, third = axes = (numbers[i], numbers[i + 1], numbers[i + 2])
        meet = [
            Miss(first, second, "a", i + 1, rows[i].a or ZERO),
            Miss(second, third, "a", i + 2, rows[i + 1].a or ZERO),
            Miss(first, third, "d", i + 2, rows[i + 1].d or ZERO),
        ]
        turns = [Miss(numbers[j], numbers[j + 1], "alpha", j + 1, rows[j].alpha or ZERO) for j in (i, i + 1)]
        found.append(Change(axes, MEET, tuple(miss for miss in meet if miss.value != 0)))
        found.append(Change(axes, PARALLEL, tuple(miss for miss in turns if not (miss.value / pi).is_integer)))
    return sorted((change for change in found if change.misses), key=lambda c: (len(c.misses), c.effect != MEET))
