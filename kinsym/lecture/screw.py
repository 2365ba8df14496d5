"""The general screw displacement: a turn about and a slide along one axis.

An axis with three components that are symbols has no exact frame, so the lecture's formula is held against the
displacements that kinsym derives for random axes with rational components, about a point that is a symbol.
"""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

from sympy import Rational

from kinsym.lecture.quantities import Value
from kinsym.lecture.residue import residue_of_fraction
from kinsym.lecture.system import Derived, System, base_frame
from kinsym.methods.screws import general_displacement
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Convention, Joint, Robot

LARGEST = 9


class GeneralScrew(System):
    """The displacement of one axis as an arm of two joints that share it: theta turns and d slides."""

    NAME = "screw_link"

    def __init__(self, generator: random.Random) -> None:
        self.axis = random_axis(generator)
        direction = tuple(Rational(part.numerator, part.denominator) for part in self.axis)
        point = tuple(symbol(f"so_{row}") for row in "xyz")
        common = {"s": direction, "s0": point}
        super().__init__(
            Robot(
                name=self.NAME,
                title="One general screw displacement",
                convention=Convention.SCREW,
                joints=(Joint(kind="R", variable="theta", **common), Joint(kind="P", variable="d", **common)),
                home=base_frame(),
                parameters={f"so_{row}": None for row in "xyz"},
            )
        )

    def link(self, number: int) -> Derived:
        """A1 is the whole displacement."""
        words = ("theta", "d", *(f"{letter}_{row}" for letter in ("s", "so") for row in "xyz"))
        general = general_displacement({word: word for word in words}).rows
        return replace(self.part(0, 2), general=general, links=(1,))

    @property
    def fixed(self) -> dict[str, Value]:
        """The components of the axis."""
        return {f"s_{row}": residue_of_fraction(part) for row, part in zip("xyz", self.axis, strict=True)}


def random_axis(generator: random.Random) -> tuple[Fraction, Fraction, Fraction]:
    """A unit vector with rational components, none of them zero: a stereographic image of a point of the plane.

    >>> x, y, z = random_axis(random.Random(1))
    >>> x * x + y * y + z * z
    Fraction(1, 1)
    """
    while True:
        a, b = (Fraction(generator.randrange(1, LARGEST), generator.randrange(1, LARGEST)) for _ in range(2))
        scale = 1 / (1 + a * a + b * b)
        if a * a + b * b != 1:
            return 2 * a * scale, 2 * b * scale, (1 - a * a - b * b) * scale
