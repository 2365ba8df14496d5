"""The names that occur in a derivation, and what the shorthand of angles among them stands for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from kinsym.algebra.tree import Definition, Sum, Sym, Tree, negated, symbols
from kinsym.emit.singular import singular_trees
from kinsym.inverse.plan import Step, Window
from kinsym.kinematics.angles import Angle

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


def all_names(derivation: Derivation) -> Iterator[str]:
    """Every name, repeats included; the user's come first."""
    robot, plan = derivation.robot, derivation.plan
    yield from robot.variables
    yield from robot.parameters
    trees: list[Tree] = [entry for row in derivation.forward.pose for entry in row]
    trees += [entry for row in derivation.jacobian.entries for entry in row]
    trees += singular_trees(derivation)
    definitions = [*derivation.constants, *derivation.held, *derivation.jacobian.definitions]
    if derivation.general is not None:
        for angle in derivation.solved.angles.values():
            if len(angle.terms) == 1:
                yield from (angle.name, angle.cosine, angle.sine)
    for item in plan.items if plan else ():
        match item:
            case Window():
                definitions += item.definitions
            case Definition():
                definitions.append(item)
            case Step():
                yield item.unknown
                yield from item.outputs
                definitions += item.coefficients
                definitions += [Definition(name=name, value=value) for name, value in item.solution]
                trees += [side for equation in item.equations for side in (equation.lhs, equation.rhs)]
    for definition in definitions:
        yield definition.name
        trees.append(definition.value)
    for tree in trees:
        yield from symbols(tree)


def joint_angles(derivation: Derivation) -> tuple[Angle, ...]:
    """The angles of single joints whose shorthand a reader cannot guess: c1 is cos(q1), c2 is cos(elbow)."""
    angles = tuple(angle for angle in derivation.angles if len(angle.terms) == 1)
    return () if all(angle.name == f"theta{angle.label}" for angle in angles) else angles


def angle_sums(derivation: Derivation) -> tuple[tuple[Angle, Tree], ...]:
    """The sums of angles that occur, each with the sum that it stands for."""
    used = set(all_names(derivation))
    return tuple(
        (angle, Sum(tuple(Sym(name) if sign > 0 else negated(Sym(name)) for name, sign in angle.terms)))
        for angle in derivation.angles
        if len(angle.terms) > 1 and used & {angle.name, angle.cosine, angle.sine}
    )
