"""Is this identically zero? Evaluate instead of simplifying.

Every quantity of an arm is a polynomial in points of circles (cosine and sine of an angle), lengths and parameters.
At random points of a prime field a polynomial that is not zero on that variety vanishes with probability
degree / PRIME, about 1e-17 a point, and arithmetic there is exact (Schwartz 1980, Zippel 1979).

PRIME is the largest prime below 2^61 that is 1 modulo 5040: the field then holds the roots of unity of order 5040, so
that a twist of 30, 45, 36 or 7.5 degrees keeps its exact cosine and sine and every relation between them.
"""

from __future__ import annotations

import random
from fractions import Fraction

PRIME = 2305843009213690801
_ORDER = 5040


def inverse(value: int) -> int:
    """The multiplicative inverse."""
    return pow(value, -1, PRIME)


def residue(value: Fraction) -> int:
    """The residue of a rational number.

    >>> residue(Fraction(1, 2)) * 2 % PRIME
    1
    """
    return value.numerator * inverse(value.denominator) % PRIME


def _primitive_root_of_unity() -> int:
    candidate = 2
    while True:
        root = pow(candidate, (PRIME - 1) // _ORDER, PRIME)
        if all(pow(root, _ORDER // prime, PRIME) != 1 for prime in (2, 3, 5, 7)):
            return root
        candidate += 1


_ROOT = _primitive_root_of_unity()
_I = pow(_ROOT, _ORDER // 4, PRIME)

Point = tuple[int, int]


def circle_point(generator: random.Random) -> Point:
    """A random (cosine, sine): c = (1 - t^2)/(1 + t^2), s = 2t/(1 + t^2)."""
    while True:
        t = generator.randrange(2, PRIME)
        denominator = (1 + t * t) % PRIME
        if denominator:
            scale = inverse(denominator)
            return (1 - t * t) * scale % PRIME, 2 * t * scale % PRIME


def angle_point(turns_of_pi: Fraction) -> Point | None:
    """Cosine and sine of ``turns_of_pi * pi`` where the field holds them (multiples of pi/2520), else None.

    >>> angle_point(Fraction(1, 3))[0] * 2 % PRIME
    1
    """
    exponent = turns_of_pi * (_ORDER // 2)
    if exponent.denominator != 1:
        return None
    forward = pow(_ROOT, exponent.numerator % _ORDER, PRIME)
    backward = inverse(forward)
    half = inverse(2)
    return (forward + backward) * half % PRIME, (forward - backward) * half * inverse(_I) % PRIME


def turn(first: Point, second: Point, sign: int = 1) -> Point:
    """The point of the sum of two angles (of the difference for ``sign = -1``)."""
    (c1, s1), (c2, s2) = first, second
    s2 *= sign
    return (c1 * c2 - s1 * s2) % PRIME, (s1 * c2 + c1 * s2) % PRIME
