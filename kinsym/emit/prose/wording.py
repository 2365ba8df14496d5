"""The words around the equations, the same in the terminal and on paper.

One place says what a rule is called, how a number reads, which branch a solution takes and what a task asks for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Call, Definition, Sym, Tree
from kinsym.inverse.plan import Equation, Item, JointValue, Plan, Step, Window
from kinsym.inverse.rules import TITLES
from kinsym.inverse.state import span
from kinsym.kinematics.elementary import FACTORS
from kinsym.robot.model import Convention, Robot, Task

if TYPE_CHECKING:
    from kinsym.kinematics.forward import Forward
    from kinsym.kinematics.jacobian import Jacobian

TASKS = {
    Task.POSE: "position and orientation",
    Task.POSITION: "position",
    Task.ORIENTATION: "orientation",
    Task.PLANAR: "position and angle in the plane",
    Task.SCARA: "position and angle about the vertical",
    Task.POSITION_AXIS: "position and the direction of one axis",
}

CONVENTIONS = {
    Convention.PAUL: "Denavit-Hartenberg table, Paul's convention",
    Convention.CRAIG: "Denavit-Hartenberg table, Craig's convention",
    Convention.SCREW: "Table of joint screws at the home pose",
}


def row_product(convention: Convention) -> str:
    """The elementary transforms of a Denavit-Hartenberg row in their order; empty for a table of screws.

    >>> row_product(Convention.CRAIG)
    'R_X(alpha_i-1) D_X(a_i-1) R_Z(theta_i) D_Z(d_i)'
    """
    before = "-1" if convention is Convention.CRAIG else ""
    factors = FACTORS.get(convention, ())
    return " ".join(f"{name}({cell}_i{before if name[-1] == 'X' else ''})" for name, cell in factors)


#: A binary fraction with a larger denominator than this is written with decimals.
_LARGEST_DENOMINATOR = 64

#: The names of the pose's entries, column by column; beside each name its row.
POSE = tuple(tuple((row, f"{column}_{axis}") for row, axis in enumerate("xyz")) for column in "uvwp")


#: What the gate of a plan means to a reader.
_SIFTED = "a solution counts only if its forward kinematics reaches the pose."


def sifting(plan: Plan) -> str:
    """Why solutions are sifted at the end; empty where every solution counts."""
    if not plan.gate:
        return ""
    if plan.task in (Task.PLANAR, Task.SCARA):
        return f"The pose must lie in the plane of the arm: {_SIFTED}"
    return f"The pose holds more than the joints can choose: {_SIFTED}"


#: What a derivation says of a locked joint whose value is not in the table.
INPUT = "an input of the inverse kinematics"


def given_joints(robot: Robot) -> Iterator[tuple[str, Tree | None]]:
    """The locked joints, which a derivation takes for given beside the pose, each with its value, None for an input."""
    for name, value in robot.locks.items():
        yield name, None if value is None else tree_of(value)


_PLACE = re.compile(r"row (\w), column (\w)( of the inverse)?")


def rule_title(rule: str) -> str:
    """The reader's words for a rule; a rule that has none is called by its key."""
    return TITLES.get(rule, rule.replace("_", " "))


def one_line(text: str) -> str:
    """A user's text as one line without control characters.

    >>> one_line("two\\nlines \\x1b[31m")
    'two lines [31m'
    """
    return " ".join("".join(letter for letter in word if letter.isprintable()) for word in text.split())


def counted(number: int, noun: str) -> str:
    """``1 solution``, ``2 solutions``."""
    plural = "es" if noun.endswith("ch") else "s"
    return f"{number} {noun}{'' if number == 1 else plural}"


def terminating(value: Fraction) -> bool:
    """Whether a number has a finite decimal expansion."""
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return rest == 1


def decimal(value: Fraction) -> str:
    """A number as its user would type it: exact decimals where there are finitely many, else a fraction.

    >>> decimal(Fraction(2159, 5000)), decimal(Fraction(-1, 3)), decimal(Fraction(3))
    ('0.4318', '-1/3', '3')
    """
    if value.denominator == 1:
        return str(value.numerator)
    if not terminating(value):
        return f"{value.numerator}/{value.denominator}"
    places = 1
    while (value * 10**places).denominator != 1:
        places += 1
    digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
    return f"{'-' if value < 0 else ''}{digits[:-places]}.{digits[-places:]}"


def as_fraction(value: Fraction) -> bool:
    """Whether a number inside a formula reads better as a fraction (one half) than as decimals (0.4318)."""
    return not terminating(value) or (value.denominator % 5 != 0 and value.denominator <= _LARGEST_DENOMINATOR)


@dataclass(frozen=True)
class Branching:
    """A step with several solutions: its number, its unknown, how many solutions share each of its marks in a row."""

    number: int
    unknown: str
    run: int
    marks: str

    @property
    def width(self) -> int:
        """How many solutions the step has at most."""
        return len(self.marks)


def branchings(plan: Plan) -> tuple[Branching, ...]:
    """The branching steps in order, outermost first."""
    found: list[Branching] = []
    run = plan.maximum
    for step in plan.steps:
        if step.branches > 1:
            run //= step.branches
            found.append(Branching(step.number, step.unknown, run, _marks(step)))
    return tuple(found)


def _marks(step: Step) -> str:
    """The marks of a step's branches in order: signs for two, numbers for more."""
    return "+-" if step.branches == 2 else "".join(str(root) for root in range(1, step.branches + 1))


def branch_rows(plan: Plan) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Every solution's number and the mark of its branch at each branching step, upper sign first."""
    yield from enumerate(product(*(fork.marks for fork in branchings(plan))), start=1)


def marks_explained(plan: Plan) -> tuple[bool, bool]:
    """Whether the table of branches shows signs, and whether it shows numbers."""
    widths = {fork.width for fork in branchings(plan)}
    return 2 in widths, bool(widths - {2})


def _plain_angle(value: Tree) -> bool:
    """Whether a value is only the angle of a cosine and a sine, or a name."""
    match value:
        case Sym() | Call("atan2", (Sym(), Sym())):
            return True
        case _:
            return False


def found_by_sum(value: JointValue) -> bool:
    """Whether a joint variable is a sum of angles; otherwise a step found it and a reader has seen it."""
    return not _plain_angle(value.value)


def shown_items(plan: Plan) -> Iterator[Item]:
    """The items a reader needs: no definition that only says what the step before it has said."""
    said: set[tuple[str, Tree]] = set()
    for item in plan.items:
        if isinstance(item, Step):
            said.update(item.solution)
        elif isinstance(item, Definition) and (_plain_angle(item.value) or (item.name, item.value) in said):
            continue
        yield item


@dataclass(frozen=True)
class Origin:
    """Equations of a step that come from one matrix equation; ``text`` says from which entries of which."""

    text: str
    equations: tuple[Equation, ...]


def origins(step: Step, before: Step | None) -> tuple[Origin, ...]:
    """Where the equations of a step come from; those of the step before are not shown twice."""
    if before is not None and step.equations == before.equations:
        return (Origin(f"the equations of step {before.number}", ()),)
    found: dict[str, list[Equation]] = {}
    for equation in step.equations:
        found.setdefault(equation.source.rpartition(" of ")[2], []).append(equation)
    return tuple(
        Origin(f"{_places([equation.source.rpartition(' of ')[0] for equation in group])} of {label}", tuple(group))
        for label, group in found.items()
    )


def _places(places: list[str]) -> str:
    """Entries of a matrix in words.

    >>> _places(["row x, column p", "row y, column p"])
    'rows x and y, column p'
    """
    if len(places) > 1 and all(match := [_PLACE.fullmatch(place) for place in places]):
        parts = [found.groups() for found in match if found]
        rows, columns, ends = ([*dict.fromkeys(part[k] or "" for part in parts)] for k in range(3))
        if len(columns) == len(ends) == 1:
            return f"rows {' and '.join(rows)}, column {columns[0]}{ends[0]}"
        if len(rows) == len(ends) == 1:
            return f"row {rows[0]}, columns {' and '.join(columns)}{ends[0]}"
    return " and ".join(dict.fromkeys(places))


def branch_marks(step: Step) -> tuple[str, ...]:
    """The sign of the branch for every formula of a solution that states its two values one by one, else nothing."""
    names = [name for name, _ in step.solution]
    marks = []
    for k, name in enumerate(names):
        single = names.count(name) == 1 or step.branches != 2
        marks.append("" if single else "+" if name not in names[:k] else "-")
    return tuple(marks)


def axis_definitions(forward: Forward, jacobian: Jacobian) -> Iterator[Definition]:
    """The definitions of the Jacobian but those of the end effector's origin: it is the last column of the pose."""
    origin = {forward.pose[row][3] for row in range(3)}
    for item in jacobian.definitions:
        if not (item.name.startswith("oE_") and item.value in origin):
            yield item


@dataclass(frozen=True)
class Loop:
    """How the pose of a window comes about: links moved to its left and right side, nearest first.

    ``before`` are the joints between which the pose it is made from reaches; ``whole`` tells that nothing moved but
    the constants before the first and after the last joint.
    """

    window: Window
    before: tuple[int, int]
    left: tuple[int, ...]
    right: tuple[int, ...]

    @property
    def whole(self) -> bool:
        """Whether only constants moved."""
        return not self.left and not self.right


def loops(plan: Plan, robot: Robot) -> dict[tuple[int, int], Loop]:
    """The windows of a plan, each with what moved since the one before."""
    found: dict[tuple[int, int], Loop] = {}
    here = span(robot, plan.task)
    for item in plan.items:
        if isinstance(item, Window):
            left = tuple(range(item.left, here[0], -1))
            right = tuple(range(here[1], item.right, -1))
            found[item.left, item.right] = Loop(item, here, left, right)
            here = (item.left, item.right)
    return found
