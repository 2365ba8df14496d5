"""A chapter of the lecture read at one posture: what every name of it stands for."""

from __future__ import annotations

import random
import re
from collections.abc import Mapping
from types import MappingProxyType

from kinsym.algebra.convert import tree_of
from kinsym.algebra.residues import residue_of
from kinsym.errors import KinsymError
from kinsym.lecture.chapter import Chapter
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.frames import Frames
from kinsym.lecture.notation import Node, parse
from kinsym.lecture.posture import Posture, random_number, random_turn, random_values
from kinsym.lecture.quantities import Matrix, Turn, Value
from kinsym.lecture.residue import Residue, Undefined
from kinsym.lecture.system import System
from kinsym.robot.model import Vector

_SHORTHAND = re.compile(r"([cs])([1-9]+)")
_AXIS = re.compile(r"S0_([1-9])")
_NOTHING: Mapping[str, Value] = MappingProxyType({})


class Reading:
    """Values modulo the prime for the names of a chapter.

    ``values`` are those of joint variables, parameters and free symbols, ``given`` go before everything else. A name
    of which nothing is known is a random number, so that no equation about it holds by chance.
    """

    def __init__(
        self,
        chapter: Chapter,
        system: System | None,
        values: Mapping[str, Value],
        given: Mapping[str, Value] = _NOTHING,
        elsewhere: Evaluator | None = None,
    ) -> None:
        self.chapter = chapter
        self.system = system
        self.values = values
        self.given = given
        self.evaluate = Evaluator(self.value_of, elsewhere=elsewhere)
        self._frames = Frames.of(chapter, system) if system else None
        self._found: dict[str, Value] = {}

    def text(self, formula: str) -> Value:
        """The value of a formula that is written as text."""
        return self.evaluate(parse(formula))

    def value_of(self, name: str) -> Value:
        """The value of a name."""
        if name not in self._found:
            self._found[name] = self._value(name)
        return self._found[name]

    def _value(self, name: str) -> Value:
        for known in (self.given, self.values, self.system.fixed if self.system else {}):
            if name in known:
                return known[name]
        if name in self.chapter.names:
            return self.evaluate(self.chapter.names[name])
        definitions = self.chapter.definitions
        if name in definitions:
            return self.evaluate(definitions[name].members[-1])
        if found := _SHORTHAND.fullmatch(name):
            return self._shorthand(found[1], found[2])
        matrix = self._matrix(name)
        return self.unknown(name) if matrix is None else matrix

    def unknown(self, name: str) -> Value:
        """The value of a name of which nothing is known."""
        return random_number(random.Random(f"{self.chapter.file} {name}"))

    def _shorthand(self, letter: str, digits: str) -> Value:
        """``c23``: the cosine of the sum of the joint angles 2 and 3, or of one angle of that name."""
        together = self.chapter.shorthand + digits
        if together in self.given or together in self.values or together in self.chapter.names:
            total = self.turn(together)
        else:
            first, *rest = (self.turn(self.chapter.shorthand + digit) for digit in digits)
            total = first
            for angle in rest:
                total = total.plus(angle)
        return total.cosine if letter == "c" else total.sine

    def turn(self, name: str) -> Turn:
        """The value of a name that is an angle."""
        value = self.value_of(name)
        if not isinstance(value, Turn):
            raise Undefined(f"{name} is no angle")
        return value

    def _matrix(self, name: str) -> Matrix | None:
        if self.system is None or self._frames is None:
            return None
        named = self._frames.find(name)
        if named is not None:
            try:
                matrix = Posture(self.system, self.values).matrix(named.derived)
            except KeyError as missing:
                raise Undefined(f"{name} needs {missing}") from None
            if named.part == "R":
                return tuple(row[:3] for row in matrix[:3])
            return matrix if named.part is None else tuple((row[int(named.part)],) for row in matrix[:3])
        return self._of_the_table(name) if self.system.screws else None

    def _of_the_table(self, name: str) -> Matrix | None:
        """What a table of screws gives: the home pose and the points of the axes."""
        assert self.system is not None
        home, joints = self.system.robot.home, self.system.robot.joints
        if home is None:
            return None
        vectors = {"u0": home.u0, "v0": home.v0, "w0": home.w0, "q0": home.q0}
        if name in vectors:
            return self.column(vectors[name])
        if name == "T_home":
            rows = zip(*(self.column(vectors[key]) for key in vectors), strict=True)
            return (*(tuple(cell[0] for cell in row) for row in rows), (Residue(0),) * 3 + (Residue(1),))
        if found := _AXIS.fullmatch(name):
            point = joints[int(found[1]) - 1].s0
            return None if point is None else self.column(point)
        return None

    def column(self, vector: Vector) -> Matrix:
        """A vector of a table."""
        numbers = {name: value.value for name, value in self.values.items() if isinstance(value, Residue)}
        cells = [residue_of(tree_of(cell), numbers) for cell in vector]
        return tuple((Residue(cell or 0),) for cell in cells)


class Known(Reading):
    """A reading while joints are being solved for: a name of which nothing is known has no value."""

    def unknown(self, name: str) -> Value:
        raise Undefined(f"nothing is known of {name}")


def read(
    chapter: Chapter,
    system: System | None,
    generator: random.Random,
    given: Mapping[str, str] = MappingProxyType({}),
    moved: Mapping[str, str] = MappingProxyType({}),
) -> Reading:
    """A chapter read at a random posture.

    ``given`` fixes names by formulas, one after the other; ``moved`` says where ``moved(...)`` is evaluated.
    """
    values = random_values(system, generator) if system else {}
    for name, kind in chapter.free.items():
        values[name] = _free(kind, generator)
    plain = Reading(chapter, system, values)
    special: dict[str, Value] = {}
    for name, formula in given.items():
        special[name] = _like(plain, name, Reading(chapter, system, values | special, special), formula)
    here = {name: special.get(name, value) for name, value in values.items()}
    reading = Reading(chapter, system, here, special)
    if not moved:
        return reading
    there = here | {name: _like(reading, name, reading, formula) for name, formula in moved.items()}
    return Reading(chapter, system, here, special, Reading(chapter, system, there, special).evaluate)


def _like(reading: Reading, name: str, source: Reading, formula: str) -> Value:
    """The value of a formula, an angle where the name is one."""
    node: Node = parse(formula)
    if isinstance(reading.values.get(name), Turn):
        return source.evaluate.angle(node)
    return source.evaluate(node)


def _free(kind: str, generator: random.Random) -> Value:
    if kind == "number":
        return random_number(generator)
    if kind == "angle":
        return random_turn(generator)
    if kind != "transform":
        raise KinsymError(f"a free symbol cannot be a {kind!r}: it is a number, an angle or a transform.")
    return _random_transform(generator)


def _random_transform(generator: random.Random) -> Matrix:
    names: dict[str, Value] = {axis: random_turn(generator) for axis in "abc"}
    names |= {axis: random_number(generator) for axis in "xyz"}
    value = Evaluator(names.__getitem__)(parse("block(rot(R_X(a)*R_Y(b)*R_Z(c)), vec(x, y, z))"))
    assert isinstance(value, tuple)
    return value


def without(reading: Reading, *names: str) -> Mapping[str, Value]:
    """The values of a reading but those of some names."""
    return {name: value for name, value in reading.values.items() if name not in names}
