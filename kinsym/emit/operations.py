"""How many operations a generated function takes, counted in the schedule.

The figures stand in the banner of every file. A minus sign is free, a power is its multiplications, a sine and a
cosine of one angle are one. The inverse kinematics is counted with every branch taken; a statement runs
once for each branch of the steps before it. In C angles are taken at the end, one for branches that share it, and what
has mirror images is computed once; in NumPy every branch has its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import prod

from kinsym.algebra.tree import Call, Pow, Prod, Quot, Sum, Tree, children
from kinsym.emit.ending import HEADING, Ending, ending, summands
from kinsym.emit.printer import split_sign
from kinsym.emit.schedule import Assign, Note, Schedule, StraightLine
from kinsym.emit.source.needs import inverse_needs, line_needs


@dataclass(frozen=True)
class Operations:
    """Counts by kind."""

    additions: int = 0
    multiplications: int = 0
    divisions: int = 0
    roots: int = 0
    sincos: int = 0
    atan2: int = 0

    def __add__(self, other: Operations) -> Operations:
        return Operations(*(a + b for a, b in zip(self._counts, other._counts, strict=True)))

    def __mul__(self, times: int) -> Operations:
        return Operations(*(a * times for a in self._counts))

    def __str__(self) -> str:
        kinds = ("+ -", "*", "/", "sqrt", "sincos", "atan2")
        return ", ".join(f"{count} {kind}" for count, kind in zip(self._counts, kinds, strict=True) if count) or "none"

    @property
    def _counts(self) -> tuple[int, ...]:
        return self.additions, self.multiplications, self.divisions, self.roots, self.sincos, self.atan2


#: What a kernel of C computes besides its inputs on its ordinary path, all roots together: reciprocals once.
_SHARED = {
    "quotient": Operations(1, 4, 1, 1),
    "homogeneous": Operations(1, 4, 1, 1),
    "homogeneous2": Operations(2, 8, 1, 2),
    "linear": Operations(7, 9, 1, 2),
    "linear_pole": Operations(8, 13, 2, 1),
    "triangle": Operations(12, 14, 1, 1),
    "direction": Operations(4, 11, 1, 1),
    HEADING: Operations(3, 7),
}
#: The same of the other kernels, and of those of NumPy.
_KERNELS = {
    "direct": Operations(),
    "length": Operations(),
    "quotient": Operations(1, 4, 2, 1),
    "quotient_length": Operations(0, 0, 1),
    "homogeneous": Operations(1, 2, 2, 1),
    "homogeneous2": Operations(2, 6, 2, 2),
    "linear": Operations(7, 8, 4, 2),
    "linear_pole": Operations(8, 11, 7, 1),
    "triangle": Operations(12, 14, 3, 1),
    "direction": Operations(4, 9, 2, 1),
    "quadratic": Operations(3, 1, 0, 1),
    # Seven roots, of the polynomial and of its derivative, by about six Newton steps each.
    "quartic": Operations(520, 540, 60, 1, 0, 4),
}


def _count(tree: Tree) -> Operations:
    _, body = split_sign(tree)
    match body:
        case Sum(terms):
            here = Operations(additions=len(terms) - 1)
        case Prod(factors):
            here = Operations(multiplications=len(factors) - 1)
        case Pow(base, exponent):
            return _count(base) * exponent + Operations(multiplications=exponent - 1)
        case Quot():
            here = Operations(divisions=1)
        case Call("sqrt"):
            here = Operations(roots=1)
        case Call("hypot"):
            here = Operations(additions=1, multiplications=2, roots=1)
        case Call("atan2"):
            here = Operations(atan2=1)
        case Call("wrap"):
            here = Operations(additions=2, multiplications=2)
        case _:
            here = Operations()
    return sum(map(_count, children(body)), here)


def _angles(tree: Tree) -> set[Tree]:
    """The angles whose sine or cosine a tree takes."""
    found = {angle for child in children(tree) for angle in _angles(child)}
    return found | {tree.arguments[0]} if isinstance(tree, Call) and tree.function in ("sin", "cos") else found


def _together(trees: Iterable[Tree]) -> Operations:
    trees = list(trees)
    angles = {angle for tree in trees for angle in _angles(tree)}
    return sum(map(_count, trees), Operations(sincos=len(angles)))


def line_operations(schedule: Schedule, line: StraightLine) -> Operations:
    """The cost of forward kinematics or of the Jacobian, constants included."""
    needs = line_needs(schedule, line)
    return _together([*(item.value for item in (*needs.constants, *needs.definitions)), *line.outputs])


def inverse_operations(schedule: Schedule, *, shared: bool = True) -> Operations:
    """The cost of all solutions of one pose, without the test that it is a pose; ``shared`` as it is done in C."""
    needs = inverse_needs(schedule)
    end = ending(schedule, needs.statements) if shared else None
    total = _together(item.value for item in needs.constants)
    if needs.size:
        total += _together([schedule.size])
    for statement in needs.statements:
        if isinstance(statement, Note):
            continue
        runs = prod(schedule.widths[: statement.level])
        if end and end.mirrored and statement.level == schedule.depth:
            runs //= 2
        if end and isinstance(statement, Assign) and statement.name in end.names:
            continue
        if isinstance(statement, Assign):
            total += _together([statement.value]) * runs
        else:
            rule = HEADING if end and end.headings.issuperset(statement.step.outputs) else statement.step.rule
            kernel = _SHARED[rule] if shared and rule in _SHARED else _KERNELS[rule]
            total += (_together(statement.step.inputs.values()) + kernel) * runs
    if end:
        total += _ending_operations(schedule, end)
    if schedule.gate:
        total += (line_operations(schedule, schedule.forward) + Operations(additions=12)) * schedule.maximum
    return total


def _ending_operations(schedule: Schedule, end: Ending) -> Operations:
    """The angles of all branches, and what the solutions take of them: half turns, and sums with their whole turn."""
    total = Operations()
    for angle in end.angles:
        runs = prod(schedule.widths[level - 1] for level in angle.levels)
        total += _together([angle.sine, angle.cosine]) * runs + Operations(atan2=angle.count)
        turned = [change for _, change in angle.changes if change in ("half_turn", "supplement")]
        total += Operations(additions=len(turned) * schedule.maximum // 2)
    for item in end.sums:
        few = summands(item.value, end.names)
        total += (_count(item.value) if few is None else Operations(additions=few)) * schedule.maximum
    return total


def operation_lines(schedule: Schedule, *, shared: bool) -> tuple[str, ...]:
    """The figures as the banner shows them; a solver that searches for roots has none."""
    lines = [f"fk        {line_operations(schedule, schedule.forward)}"]
    if schedule.general is None:
        lines.append(f"ik        {inverse_operations(schedule, shared=shared)} (for all solutions)")
    return (*lines, f"jacobian  {line_operations(schedule, schedule.jacobian)}")
