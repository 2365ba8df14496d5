"""Roots modulo the prime of polynomials in one unknown, found without chance (Cantor and Zassenhaus 1981).

A polynomial is a list of coefficients, the constant one first.
"""

from __future__ import annotations

from sympy.ntheory import sqrt_mod

from kinsym.algebra.field import PRIME, inverse

Coefficients = list[int]

_SHIFTS = 32


def roots(poly: Coefficients) -> list[int]:
    """The roots that lie in the field, in increasing order; of the zero polynomial none is listed.

    >>> roots([6, -5, 1])
    [2, 3]
    """
    poly = _trimmed([value % PRIME for value in poly])
    if len(poly) < 2:
        return []
    if len(poly) == 3:
        return _quadratic(*poly)
    power = _power([0, 1], PRIME, poly)
    linear = _divisor(poly, _minus(power, [0, 1]))
    return sorted(_split(linear))


def _quadratic(c: int, b: int, a: int) -> list[int]:
    """The roots of a x^2 + b x + c."""
    square = (b * b - 4 * a * c) % PRIME
    if square and pow(square, (PRIME - 1) // 2, PRIME) != 1:
        return []
    root, scale = sqrt_mod(square, PRIME), inverse(2 * a)
    return sorted({(-b + root) * scale % PRIME, (-b - root) * scale % PRIME})


def _split(poly: Coefficients) -> list[int]:
    """The roots of a product of different linear factors."""
    if len(poly) < 2:
        return []
    if len(poly) == 2:
        return [-poly[0] * inverse(poly[1]) % PRIME]
    for shift in range(_SHIFTS):
        square = _minus(_power([shift, 1], (PRIME - 1) // 2, poly), [1])
        part = _divisor(poly, square)
        if 1 < len(part) < len(poly):
            return _split(part) + _split(_divided(poly, part)[0])
    return []


def _trimmed(poly: Coefficients) -> Coefficients:
    while poly and not poly[-1]:
        poly = poly[:-1]
    return poly


def _minus(left: Coefficients, right: Coefficients) -> Coefficients:
    size = max(len(left), len(right))
    left, right = left + [0] * (size - len(left)), right + [0] * (size - len(right))
    return _trimmed([(a - b) % PRIME for a, b in zip(left, right, strict=True)])


def _divided(poly: Coefficients, by: Coefficients) -> tuple[Coefficients, Coefficients]:
    """Quotient and remainder."""
    rest, scale = list(poly), inverse(by[-1])
    quotient = [0] * max(0, len(poly) - len(by) + 1)
    for place in reversed(range(len(quotient))):
        factor = quotient[place] = rest[place + len(by) - 1] * scale % PRIME
        for k, value in enumerate(by):
            rest[place + k] = (rest[place + k] - factor * value) % PRIME
    return quotient, _trimmed(rest[: len(by) - 1])


def _divisor(left: Coefficients, right: Coefficients) -> Coefficients:
    """The greatest common divisor."""
    while right:
        left, right = right, _divided(left, right)[1]
    return left


def _power(base: Coefficients, exponent: int, modulus: Coefficients) -> Coefficients:
    result: Coefficients = [1]
    base = _divided(base, modulus)[1]
    while exponent:
        if exponent & 1:
            result = _product(result, base, modulus)
        base = _product(base, base, modulus)
        exponent >>= 1
    return result


def _product(left: Coefficients, right: Coefficients, modulus: Coefficients) -> Coefficients:
    if not left or not right:
        return []
    total = [0] * (len(left) + len(right) - 1)
    for i, a in enumerate(left):
        for j, b in enumerate(right):
            total[i + j] = (total[i + j] + a * b) % PRIME
    return _divided(_trimmed(total), modulus)[1]
