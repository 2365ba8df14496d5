"""The part of a plan that one unknown needs: the steps that lead to it, and of the poses between them those entries."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from kinsym.algebra.tree import Definition, symbols
from kinsym.errors import RobotError
from kinsym.inverse.plan import Item, Plan, Step, Window
from kinsym.robot.model import Robot
from kinsym.robot.names import nearest, shown


def solvable(plan: Plan) -> tuple[str, ...]:
    """What can be asked for: the joints that are solved for, then the sums of angles that a step finds."""
    joints = tuple(value.variable for value in plan.values)
    return tuple(dict.fromkeys((*joints, *(step.unknown for step in plan.steps))))


def check_unknown(name: str, robot: Robot, known: tuple[str, ...]) -> None:
    """RobotError if ``name`` is none of the unknowns ``known``, with the nearest one."""
    if name in robot.locks:
        raise RobotError(
            f"{name} is locked: it is given, not solved for",
            where=robot.name,
            remedy=f"Ask for one of {', '.join(known)}.",
        )
    if name not in known:
        raise RobotError(
            f"no step finds {shown(name)}", where=robot.name, remedy=f"{nearest(name, known)}It has {', '.join(known)}."
        )


def needed(plan: Plan, unknown: str) -> tuple[Item, ...]:
    """The items of a plan that a joint variable, or the unknown of a step, depends on, in their order.

    A window stays as long as a step follows it, with those of its entries that are read.
    """
    wanted = {unknown}
    wanted.update(name for value in plan.values if value.variable == unknown for name in symbols(value.value))
    kept: list[Item] = []
    for item in reversed(plan.items):
        if isinstance(item, Window):
            entries = []
            for entry in reversed(item.definitions):
                if entry.name in wanted:
                    entries.append(entry)
                    wanted.update(symbols(entry.value))
            if any(isinstance(later, Step) for later in kept):
                kept.append(replace(item, definitions=tuple(reversed(entries))))
        elif wanted.intersection(_found(item)):
            kept.append(item)
            wanted.update(_read(item))
    return tuple(reversed(kept))


def _found(item: Definition | Step) -> tuple[str, ...]:
    if isinstance(item, Definition):
        return (item.name,)
    return (item.unknown, *item.outputs, *(definition.name for definition in item.coefficients))


def _read(item: Definition | Step) -> Iterator[str]:
    """The names that an item reads, those of its equations among them: what is printed has to be explained."""
    if isinstance(item, Definition):
        yield from symbols(item.value)
        return
    trees = [tree for equation in item.equations for tree in (equation.lhs, equation.rhs)]
    trees += [definition.value for definition in item.coefficients]
    trees += [*item.inputs.values(), *(value for _, value in item.solution)]
    for tree in trees:
        yield from symbols(tree)
