"""The end of an inverse kinematics: which angles are taken of the pairs of sine and cosine, and the solutions of them.

The branches of a plan do algebra alone and leave pairs; all angles of a pose are taken together, which a compiler does
several at a time. An angle that differs between the roots of a step by half a turn or by its sign is taken once.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import prod

from kinsym.algebra.tree import Call, Prod, Sum, Sym, Tree, children, negated, symbols
from kinsym.emit.schedule import Assign, Note, Schedule, Solve, Statement
from kinsym.emit.symmetry import Sign, sign, signs

#: What the second root of a step makes of an angle, by the signs of its sine and its cosine.
CHANGES: dict[tuple[Sign, Sign], str] = {(1, 1): "", (-1, -1): "half_turn", (-1, 1): "opposite", (1, -1): "supplement"}
#: The rules whose second root is there wherever the first is, unless the unknown is free.
_HALF_TURN = ("homogeneous", "homogeneous2")
_LANES = 4
#: A sum of so many angles in (-pi, pi] needs one whole turn at most to be there again.
ONE_TURN = 3
#: The kernel that finds a direction and leaves it its length.
HEADING = "heading"


@dataclass(frozen=True, kw_only=True)
class Angle:
    """An angle with its pair, by names.

    levels   the levels whose roots it has one value for each of.
    changes  the other levels it depends on, each with what the second root makes of it.
    start    the place of its first value among the angles of a pose; ``count`` values follow each other.
    """

    name: str
    sine: Tree
    cosine: Tree
    level: int
    levels: tuple[int, ...]
    changes: tuple[tuple[int, str], ...]
    start: int
    count: int


@dataclass(frozen=True, kw_only=True)
class Length:
    """A joint value that the branches give, and how it changes with the root of the last branching step."""

    name: str
    level: int
    sign: Sign


@dataclass(frozen=True, kw_only=True)
class Ending:
    """How the solutions follow from what the branches leave.

    angles    what is taken of pairs, in order.
    sums      values that are sums of angles, in order.
    lengths   the other joint values that are solved for.
    mirrored  whether the last branching step has mirror images for roots: what follows it is computed for one alone.
    headings  pairs of the rule ``direction`` that their angles alone read: any multiple of them will do.
    """

    angles: tuple[Angle, ...]
    sums: tuple[Assign, ...]
    lengths: tuple[Length, ...]
    mirrored: bool
    headings: frozenset[str]

    @property
    def pairs(self) -> int:
        """The number of pairs of a pose."""
        return sum(angle.count for angle in self.angles)

    @property
    def room(self) -> int:
        """The same, filled up to a multiple of what a processor does at a time."""
        return -(-self.pairs // _LANES) * _LANES

    @property
    def names(self) -> frozenset[str]:
        """What is not computed in the branches."""
        return frozenset([*(angle.name for angle in self.angles), *(item.name for item in self.sums)])


def ending(schedule: Schedule, statements: tuple[Statement, ...]) -> Ending:
    """The end of a schedule, whose statements that count are given."""
    assigns = [item for item in statements if isinstance(item, Assign)]
    levels = _levels(statements)
    late = _late(statements, assigns, levels)
    found = {level: signs(statements, level) for level in range(1, schedule.depth + 1)}
    angles: list[Angle] = []
    for item in assigns:
        if item.name in late and _is_pair(item.value):
            angles.append(_angle(schedule, item, found, sum(angle.count for angle in angles)))
    last = found.get(schedule.depth, {})
    return Ending(
        angles=tuple(angles),
        sums=tuple(item for item in assigns if item.name in late and not _is_pair(item.value)),
        lengths=tuple(
            Length(name=name, level=levels[name], sign=last.get(name, 1))
            for name in schedule.solution
            if name in levels and name not in late
        ),
        mirrored=_is_mirrored(schedule, statements, late, last),
        headings=_headings(statements, angles),
    )


def _levels(statements: Iterable[Statement]) -> dict[str, int]:
    """The level at which each name is known."""
    levels: dict[str, int] = {}
    for statement in statements:
        if isinstance(statement, Assign):
            levels[statement.name] = statement.level
        elif isinstance(statement, Solve):
            levels |= dict.fromkeys(statement.step.outputs, statement.level + (statement.step.branches > 1))
    return levels


def summands(tree: Tree, names: Iterable[str]) -> int | None:
    """How many angles in (-pi, pi] a wrapped sum has, None if it is something else."""
    if not (isinstance(tree, Call) and tree.function == "wrap"):
        return None
    terms = tree.arguments[0].terms if isinstance(tree.arguments[0], Sum) else tree.arguments
    plain = [negated(term) if isinstance(term, Prod) else term for term in terms]
    return len(terms) if all(isinstance(term, Sym) and term.name in names for term in plain) else None


def _is_pair(tree: Tree) -> bool:
    return isinstance(tree, Call) and tree.function == "atan2"


def _late(statements: Iterable[Statement], assigns: list[Assign], levels: dict[str, int]) -> set[str]:
    """The assignments that nothing in the branches reads: pairs' angles and what is made of these and of constants."""
    early: set[str] = set()
    while True:
        late: set[str] = set()
        for item in assigns:
            names = set(symbols(item.value))
            of_late = bool(names & late) and all(name in late or levels.get(name, 0) == 0 for name in names)
            if item.name not in early and (_is_pair(item.value) or of_late):
                late.add(item.name)
        read = {
            name
            for statement in statements
            if not (isinstance(statement, Assign) and statement.name in late)
            for name in _read(statement)
        }
        if not read & late:
            return late
        early |= read & late


def _angle(schedule: Schedule, item: Assign, found: dict[int, dict[str, Sign]], start: int) -> Angle:
    sine, cosine = children(item.value)
    changes = {
        level: CHANGES.get((sign(sine, found[level]), sign(cosine, found[level]))) for level in range(1, item.level + 1)
    }
    levels = tuple(level for level, change in changes.items() if change is None)
    return Angle(
        name=item.name,
        sine=sine,
        cosine=cosine,
        level=item.level,
        levels=levels,
        changes=tuple((level, change) for level, change in changes.items() if change),
        start=start,
        count=prod(schedule.widths[level - 1] for level in levels),
    )


def _headings(statements: Iterable[Statement], angles: Iterable[Angle]) -> frozenset[str]:
    readers = Counter(name for item in statements for name in frozenset(_read(item)))
    plain = [(angle.sine, angle.cosine) for angle in angles]
    alone = [
        {sine.name, cosine.name}
        for sine, cosine in plain
        if isinstance(sine, Sym) and isinstance(cosine, Sym) and readers[sine.name] == readers[cosine.name] == 1
    ]
    steps = [item.step for item in statements if isinstance(item, Solve) and item.step.rule == "direction"]
    return frozenset(name for step in steps if set(step.outputs) in alone for name in step.outputs)


def _read(statement: Statement) -> Iterator[str]:
    """The names that a statement reads."""
    if isinstance(statement, Assign):
        yield from symbols(statement.value)
    elif isinstance(statement, Solve):
        for tree in statement.step.inputs.values():
            yield from symbols(tree)


def _is_mirrored(schedule: Schedule, statements: tuple[Statement, ...], late: set[str], last: dict[str, Sign]) -> bool:
    steps = [item.step for item in statements if isinstance(item, Solve) and item.step.branches > 1]
    if not steps or steps[-1].rule not in _HALF_TURN:
        return False
    inside = [item for item in statements if not isinstance(item, Note) and item.level == schedule.depth]
    names = [
        name
        for item in inside
        for name in ([item.name] if isinstance(item, Assign) else item.step.outputs)
        if name not in late
    ]
    pairs = [
        tuple(sign(part, last) for part in children(item.value))
        for item in inside
        if isinstance(item, Assign) and item.name in late and _is_pair(item.value)
    ]
    return all(last[name] is not None for name in names) and all(pair in CHANGES for pair in pairs)
