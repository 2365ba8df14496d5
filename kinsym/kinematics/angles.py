"""Joints with parallel axes and the angles that are natural for them.

A run of joints whose revolute axes are parallel is a *group*. Its rotation depends on the sum of its angles and its
translation is linear in the cosines and sines of the partial sums, so those sums are the generators: theta2,
theta23, theta234, with a minus where a twist of pi reverses an axis (theta1 + theta2 - theta4 of the SCARA arm).

The partial sums are the *nodes* 0..k of a group; an interval between two nodes is an angle that can be named.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from kinsym.algebra.ring import Generator, Kind


@dataclass(frozen=True)
class Angle:
    """The signed sum of the joint angles between two nodes of a group, first sign positive.

    ``sign`` is +1 or -1: node ``high`` minus node ``low`` equals ``sign`` times this angle.
    """

    group: int
    low: int
    high: int
    label: str
    sign: int
    terms: tuple[tuple[str, int], ...]

    @property
    def name(self) -> str:
        """The angle itself: theta23."""
        return "theta" + self.label if len(self.terms) > 1 else self.terms[0][0]

    @property
    def cosine(self) -> str:
        """The name of its cosine: c23."""
        return "c" + self.label

    @property
    def sine(self) -> str:
        """The name of its sine: s23."""
        return "s" + self.label


def shorthand(variables: tuple[str, ...]) -> dict[str, str]:
    """The digits that stand for each joint variable: its own number if all have one, else its position.

    >>> shorthand(("theta1", "theta2", "d3"))
    {'theta1': '1', 'theta2': '2', 'd3': '3'}
    """
    numbers = [re.search(r"([0-9]+)$", variable) for variable in variables]
    digits = [match.group(1) if match else "" for match in numbers]
    if "" in digits or len(set(digits)) < len(digits):
        digits = [str(i + 1) for i in range(len(variables))]
    return dict(zip(variables, digits, strict=True))


def interval(group: int, low: int, signed: tuple[tuple[str, int], ...], digits: dict[str, str]) -> Angle:
    """The angle between node ``low`` and the node after ``signed`` joint angles."""
    sign = signed[0][1]
    terms = tuple((variable, s * sign) for variable, s in signed)
    wide = any(len(digits[variable]) > 1 for variable, _ in terms)
    label = ""
    for variable, s in terms:
        label += ("m" if s < 0 else "_" if wide and label else "") + digits[variable]
    return Angle(group, low, low + len(signed), label, sign, terms)


def angle_generators(angles: list[Angle]) -> list[Generator]:
    """Cosine and sine of every angle."""
    result: list[Generator] = []
    for angle in angles:
        result.append(Generator(angle.cosine, Kind.COSINE))
        result.append(Generator(angle.sine, Kind.SINE, angle.cosine))
    return result
