"""A random posture of a system, at which every quantity that kinsym derives has a value modulo the prime."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Symbol

from kinsym.algebra.field import PRIME, circle_point
from kinsym.algebra.residues import residue_of
from kinsym.kinematics.chain import Chain
from kinsym.lecture.quantities import Matrix, Turn, Value
from kinsym.lecture.residue import Residue, Undefined
from kinsym.lecture.system import Derived, System


@dataclass(frozen=True)
class Posture:
    """Values for the joint variables and the parameters of a system: angles as turns, lengths as residues."""

    system: System
    values: Mapping[str, Value]

    def matrix(self, derived: Derived) -> Matrix:
        """A printed matrix at this posture."""
        names = self._names(derived.chain)
        rows = tuple(tuple(residue_of(cell, names) for cell in row) for row in derived.matrix)
        if any(cell is None for row in rows for cell in row):
            raise Undefined("an entry of a printed matrix has no value here")
        return tuple(tuple(Residue(cell or 0) for cell in row) for row in rows)

    def _names(self, chain: Chain) -> dict[str, int]:
        """What the names of a chain's ring stand for."""
        names = {name: value.value for name, value in self.values.items() if isinstance(value, Residue)}
        for angle in chain.angles.values():
            total = Turn(Residue(1), Residue(0))
            for variable, sign in angle.terms:
                total = total.plus(self._turn(variable).times(sign))
            names |= _pair(angle.label, total)
        for cell, label in chain.constants.angles.items():
            if not isinstance(cell, Symbol):
                raise Undefined(f"the twist {cell} is no symbol")
            names |= _pair(label, self._turn(cell.name))
        return names

    def _turn(self, name: str) -> Turn:
        value = self.values[name]
        if not isinstance(value, Turn):
            raise Undefined(f"{name} is no angle")
        return value


def _pair(label: str, turn: Turn) -> dict[str, int]:
    assert isinstance(turn.cosine, Residue)
    assert isinstance(turn.sine, Residue)
    return {"c" + label: turn.cosine.value, "s" + label: turn.sine.value}


def random_values(system: System, generator: random.Random) -> dict[str, Value]:
    """A value for every joint variable and every parameter."""
    twists = {str(cell) for cell in system.chain.constants.angles}
    slides = {joint.variable for joint in system.robot.moving if joint.kind == "P"}
    names = (*system.robot.variables, *system.robot.parameters)
    return {
        name: random_number(generator) if name in slides or _length(system, name, twists) else random_turn(generator)
        for name in names
    }


def _length(system: System, name: str, twists: set[str]) -> bool:
    return name in system.robot.parameters and name not in twists


def random_number(generator: random.Random) -> Residue:
    """A number that is not zero."""
    return Residue(generator.randrange(1, PRIME))


def random_turn(generator: random.Random) -> Turn:
    """An angle whose half has a tangent."""
    c, s = circle_point(generator)
    return Turn(Residue(c), Residue(s))
