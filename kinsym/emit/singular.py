"""What a generated file says of singular poses, and what the checks need to hold it to that."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from kinsym.algebra.tree import Tree, symbols
from kinsym.emit.schedule import SingularPoses
from kinsym.emit.straight import angle_functions

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


def singular_poses(derivation: Derivation) -> SingularPoses:
    """The singular poses of a derivation."""
    used = {name for tree in singular_trees(derivation) for name in symbols(tree)}
    angles = [definition for definition in angle_functions(derivation.solved) if definition.name in used]
    return SingularPoses(set=derivation.singular, families=derivation.families, angles=tuple(angles))


def singular_trees(derivation: Derivation) -> Iterator[Tree]:
    """Every expression that is printed of the singular poses."""
    yield derivation.singular.constant
    for condition in derivation.singular.listed:
        yield from condition.values
    for family in derivation.families:
        for left, _, right in family.conditions:
            yield left
            yield right
        yield from family.constant
