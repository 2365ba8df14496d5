"""What each generated function needs, so that nothing is computed that nothing reads.

A schedule defines the constants, the parameters and the pose once for all functions; a function takes from them what
its own results depend on. Compilers are asked to complain about every unused variable, and a reader should not have
to wonder about one either.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypedDict

from kinsym.algebra.tree import Call, Tree, children, symbols
from kinsym.emit.schedule import Assign, Note, Parameter, Schedule, Solve, Statement, StraightLine
from kinsym.emit.source.gate import gate_entries
from kinsym.emit.source.kernels import KERNELS
from kinsym.inverse.plan import Definition

_COLUMNS, _ROWS = "uvwp", "xyz"
#: The pose's entries by name, each with its row and column.
ENTRIES = {f"{u}_{x}": (row, column) for row, x in enumerate(_ROWS) for column, u in enumerate(_COLUMNS)}


@dataclass(frozen=True, kw_only=True)
class Needs:
    """What one function reads: names in the order in which the schedule gives them; ``inputs`` are locked joints."""

    joints: tuple[tuple[int, str], ...]
    parameters: tuple[Parameter, ...]
    inputs: tuple[str, ...]
    constants: tuple[Definition, ...]
    names: frozenset[str]


@dataclass(frozen=True, kw_only=True)
class LineNeeds(Needs):
    """The needs of a straight line, and the definitions of it that count."""

    definitions: tuple[Definition, ...]


@dataclass(frozen=True, kw_only=True)
class InverseNeeds(Needs):
    """The needs of the inverse kinematics, and its statements that count."""

    entries: tuple[tuple[str, int, int], ...]
    statements: tuple[Statement, ...]

    @property
    def size(self) -> bool:
        """Whether a tolerance is relative to the arm's size."""
        return "size" in self.names

    @property
    def tau(self) -> bool:
        """Whether a tolerance is needed at all."""
        return "tau" in self.names

    @property
    def marked(self) -> bool:
        """Whether a step can mark a solution as special."""
        return _marks(self.statements)

    @property
    def reference(self) -> bool:
        """Whether a joint can be free."""
        return any(
            isinstance(statement, Solve) and KERNELS[statement.step.rule].free and bool(statement.step.reference)
            for statement in self.statements
        )


def line_needs(schedule: Schedule, line: StraightLine) -> LineNeeds:
    """The needs of forward kinematics or of the Jacobian."""
    names = _names(line.outputs)
    definitions = _live(line.definitions, names)
    return LineNeeds(definitions=definitions, inputs=(), **_common(schedule, schedule.constants, names))


def inverse_needs(schedule: Schedule) -> InverseNeeds:
    """The needs of the inverse kinematics; a gate and marked solutions read the tolerances as well."""
    names = set() if schedule.general else set(schedule.solution)
    if schedule.gate and not schedule.general:
        names |= {"tau", "size"} if gate_entries(schedule.task).position else {"tau"}
    if _marks(schedule.inverse):
        names |= {"tau", "size"}
    kept: list[Statement] = []
    for statement in reversed(schedule.inverse):
        if isinstance(statement, Assign):
            if statement.name not in names:
                continue
            names |= _names([statement.value])
        elif isinstance(statement, Solve):
            names |= _names(statement.step.inputs.values())
        kept.append(statement)
    statements = tuple(reversed(kept))
    if _depths(statements) != schedule.depth:
        raise ValueError(f"the schedule of {schedule.name} does not open {schedule.depth} levels in order")
    if schedule.general:
        names |= _names(entry for link in schedule.general.transforms for entry in link.entries)
    if "size" in names:
        names |= _names([schedule.size])
    common = _common(schedule, (*schedule.constants, *schedule.held), names)
    return InverseNeeds(
        entries=tuple((name, *place) for name, place in ENTRIES.items() if name in names),
        statements=statements,
        inputs=tuple(name for name in schedule.inputs if name in names),
        **common,
    )


def held_needs(schedule: Schedule) -> Needs:
    """What the values of the locked joints read."""
    names = set(schedule.locked)
    return Needs(inputs=schedule.inputs, **_common(schedule, (*schedule.constants, *schedule.held), names))


def nonzero_needs(schedule: Schedule) -> LineNeeds:
    """What the test that nothing vanishes reads."""
    trees = [item.value for item in schedule.nonzero]
    if any(item.unit == 1 for item in schedule.nonzero):
        trees.append(schedule.lengths)
    return line_needs(schedule, StraightLine(definitions=(), outputs=tuple(trees)))


def functions_used(schedule: Schedule) -> frozenset[str]:
    """The functions that the generated source calls in its expressions."""
    inverse = inverse_needs(schedule)
    trees = [*schedule.forward.outputs, *schedule.jacobian.outputs, *([schedule.size] if inverse.size else [])]
    for line in (schedule.forward, schedule.jacobian):
        needs = line_needs(schedule, line)
        trees += [item.value for item in (*needs.constants, *needs.definitions)]
    trees += [item.value for item in held_needs(schedule).constants]
    functions = {name for tree in trees for name in _functions(tree)} | inverse_functions(inverse)
    return frozenset(functions | {"wrap"} if inverse.marked else functions)


def inverse_functions(inverse: InverseNeeds) -> frozenset[str]:
    """The functions that the statements of the inverse kinematics call."""
    trees = [item.value for item in inverse.constants]
    for statement in inverse.statements:
        if isinstance(statement, Assign):
            trees.append(statement.value)
        elif isinstance(statement, Solve):
            trees += statement.step.inputs.values()
    return frozenset(name for tree in trees for name in _functions(tree))


def _marks(statements: Iterable[Statement]) -> bool:
    return any(isinstance(item, Solve) and not KERNELS[item.step.rule].plain for item in statements)


def _functions(tree: Tree) -> Iterator[str]:
    if isinstance(tree, Call):
        yield tree.function
    for child in children(tree):
        yield from _functions(child)


def _names(trees: Iterable[Tree]) -> set[str]:
    return {name for tree in trees for name in symbols(tree)}


def _live(definitions: tuple[Definition, ...], names: set[str]) -> tuple[Definition, ...]:
    """The definitions that ``names`` depend on; ``names`` grows by what those read."""
    kept = []
    for definition in reversed(definitions):
        if definition.name in names:
            names |= _names([definition.value])
            kept.append(definition)
    return tuple(reversed(kept))


class _Common(TypedDict):
    joints: tuple[tuple[int, str], ...]
    parameters: tuple[Parameter, ...]
    constants: tuple[Definition, ...]
    names: frozenset[str]


def _common(schedule: Schedule, constants: tuple[Definition, ...], names: set[str]) -> _Common:
    """The fields of Needs; ``names`` grows by what the constants read."""
    constants = _live(constants, names)
    return {
        "joints": tuple((number, joint.name) for number, joint in enumerate(schedule.joints) if joint.name in names),
        "parameters": tuple(parameter for parameter in schedule.parameters if parameter.name in names),
        "constants": constants,
        "names": frozenset(names),
    }


def _depths(statements: tuple[Statement, ...]) -> int:
    """How many levels the statements open; -1 if one stands at another level than the one that is open."""
    depth = 0
    for statement in statements:
        if isinstance(statement, Note):
            continue
        if statement.level != depth:
            return -1
        if isinstance(statement, Solve) and statement.step.branches > 1:
            depth += 1
    return depth
