"""Numbers modulo the prime that calculate with the operators of Python.

A formula evaluated with them is a test of identity (:mod:`kinsym.algebra.field`); evaluated with Fractions it is a
number. The evaluator is the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any, TypeAlias

from sympy.ntheory import sqrt_mod

from kinsym.algebra.field import PRIME, inverse, residue


class Undefined(ArithmeticError):
    """A formula has no value here: it divides by zero, or takes a root that is not there."""


@dataclass(frozen=True, slots=True)
class Residue:
    """A number modulo the prime.

    >>> Residue(1) / Residue(2) * Residue(2)
    Residue(value=1)
    """

    value: int

    def __add__(self, other: Residue) -> Residue:
        return Residue((self.value + other.value) % PRIME)

    def __sub__(self, other: Residue) -> Residue:
        return Residue((self.value - other.value) % PRIME)

    def __mul__(self, other: Residue) -> Residue:
        return Residue(self.value * other.value % PRIME)

    def __truediv__(self, other: Residue) -> Residue:
        if not other.value:
            raise Undefined("division by zero")
        return Residue(self.value * inverse(other.value) % PRIME)

    def __neg__(self) -> Residue:
        return Residue(-self.value % PRIME)

    def __bool__(self) -> bool:
        return self.value != 0


Scalar: TypeAlias = Any
"""A Residue or a Fraction: the same kind throughout one evaluation, which annotations cannot say."""


def residue_of_fraction(value: Fraction) -> Residue:
    """A rational number modulo the prime."""
    return Residue(residue(value))


def root(value: Scalar) -> Scalar:
    """A square root, the positive one of a Fraction; Undefined where there is none.

    >>> root(Fraction(9, 4))
    Fraction(3, 2)
    """
    if isinstance(value, Residue):
        found = sqrt_mod(value.value, PRIME)
        if found is None:
            raise Undefined("a root that the field does not hold")
        return Residue(int(found))
    if value < 0:
        raise Undefined("the root of a negative number")
    parts = [_whole_root(part) for part in (value.numerator, value.denominator)]
    return Fraction(*parts)


def _whole_root(value: int) -> int:
    found = isqrt(value)
    if found * found != value:
        raise Undefined(f"the root of {value} is no rational number")
    return found
