"""What a formula of the lecture can stand for: a number, an angle, a matrix.

An angle is a point of the unit circle, so that sums of angles are exact and nothing is periodic. The inverse tangent
of one number knows an angle only up to half a turn: that is a :class:`Slope`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

from kinsym.algebra.field import angle_point
from kinsym.lecture.residue import Residue, Scalar, Undefined, root


@dataclass(frozen=True)
class Turn:
    """An angle by its cosine and sine."""

    cosine: Scalar
    sine: Scalar

    def plus(self, other: Turn) -> Turn:
        """The sum of two angles."""
        return Turn(
            self.cosine * other.cosine - self.sine * other.sine, self.sine * other.cosine + self.cosine * other.sine
        )

    def opposite(self) -> Turn:
        """The angle turned the other way."""
        return Turn(self.cosine, -self.sine)

    def times(self, count: int) -> Turn:
        """A whole multiple."""
        total = Turn(_one(self.cosine), _one(self.cosine) - _one(self.cosine))
        for _ in range(abs(count)):
            total = total.plus(self)
        return total if count >= 0 else total.opposite()

    def half(self) -> Slope:
        """Half the angle, by its tangent s / (1 + c)."""
        return Slope(self.sine / (_one(self.cosine) + self.cosine))


@dataclass(frozen=True)
class Slope:
    """An angle up to half a turn, by its tangent."""

    tangent: Scalar

    def twice(self) -> Turn:
        """The double angle, which is one angle: c = (1 - t^2)/(1 + t^2), s = 2 t/(1 + t^2)."""
        one, t = _one(self.tangent), self.tangent
        below = one + t * t
        return Turn((one - t * t) / below, (t + t) / below)

    def holds(self, turn: Turn) -> bool:
        """Whether an angle has this tangent."""
        return not turn.sine - self.tangent * turn.cosine


@dataclass(frozen=True)
class Pi:
    """A multiple of pi."""

    multiple: Fraction

    def turn(self) -> Turn:
        """The angle modulo the prime."""
        point = angle_point(self.multiple)
        if point is None:
            raise Undefined(f"{self.multiple}*pi is no angle of the field")
        return Turn(Residue(point[0]), Residue(point[1]))


Matrix = tuple[tuple[Scalar, ...], ...]
Value: TypeAlias = Any
"""A Scalar, a Turn, a Slope, a Pi or a Matrix."""


def is_scalar(value: Value) -> bool:
    """Whether a value is a number."""
    return isinstance(value, Residue | Fraction)


def direction(x: Scalar, y: Scalar) -> Turn:
    """The angle Atan2(y, x) of a point; of a point on the unit circle exactly, of another up to half a turn.

    The field has no positive numbers, so that of the two roots of x^2 + y^2 either may be taken. Where a formula
    lists Atan2(y, x) beside Atan2(-y, -x) both angles come out.
    """
    length = x * x + y * y
    if length == _one(x):
        return Turn(x, y)
    size = root(length)
    return Turn(x / size, y / size)


def _one(like: Scalar) -> Scalar:
    return Residue(1) if isinstance(like, Residue) else Fraction(1)


def matmul(left: Matrix, right: Matrix) -> Matrix:
    """The product of two matrices; Undefined where their sizes do not fit."""
    if len(left[0]) != len(right):
        raise Undefined(f"a matrix of {len(left[0])} columns times one of {len(right)} rows")
    columns = tuple(zip(*right, strict=True))
    return tuple(tuple(dot(row, column) for column in columns) for row in left)


def dot(left: tuple[Scalar, ...], right: tuple[Scalar, ...]) -> Scalar:
    """The sum of products."""
    first, *rest = (x * y for x, y in zip(left, right, strict=True))
    for product in rest:
        first = first + product
    return first


def transpose(matrix: Matrix) -> Matrix:
    """The transpose."""
    return tuple(zip(*matrix, strict=True))


def column(matrix: Matrix) -> tuple[Scalar, ...]:
    """The entries of a column; Undefined for anything wider."""
    if len(matrix[0]) != 1:
        raise Undefined("a vector is wanted where a matrix stands")
    return tuple(row[0] for row in matrix)


def entrywise(left: Matrix, right: Matrix, sign: int) -> Matrix:
    """``left + right`` or, for sign -1, ``left - right``; Undefined where their sizes differ."""
    if (len(left), len(left[0])) != (len(right), len(right[0])):
        raise Undefined("two matrices of different size are added")
    return tuple(
        tuple(x + y if sign > 0 else x - y for x, y in zip(a, b, strict=True)) for a, b in zip(left, right, strict=True)
    )


def rigid_inverse(matrix: Matrix) -> Matrix:
    """The inverse of a rotation or of a rigid transform."""
    rotation = transpose(tuple(row[:3] for row in matrix[:3]))
    if len(matrix) == 3:
        return rotation
    moved = matmul(rotation, tuple((row[3],) for row in matrix[:3]))
    return (*((*row, -entry[0]) for row, entry in zip(rotation, moved, strict=True)), matrix[3])


def determinant(matrix: Matrix) -> Scalar:
    """The determinant, by the first row."""
    if len(matrix) == 1:
        return matrix[0][0]
    total = None
    for k, entry in enumerate(matrix[0]):
        minor = tuple((*row[:k], *row[k + 1 :]) for row in matrix[1:])
        term = entry * determinant(minor)
        signed = -term if k % 2 else term
        total = signed if total is None else total + signed
    if total is None:
        raise Undefined("a matrix without entries")
    return total


def cross(left: tuple[Scalar, ...], right: tuple[Scalar, ...]) -> tuple[Scalar, ...]:
    """The vector product."""
    (a, b, c), (x, y, z) = left, right
    return b * z - c * y, c * x - a * z, a * y - b * x


def agree(left: Value, right: Value) -> bool:
    """Whether two values are the same; a slope agrees with the angles that have it."""
    if isinstance(left, Pi):
        left = left.turn()
    if isinstance(right, Pi):
        right = right.turn()
    if isinstance(left, Slope) and isinstance(right, Turn):
        return left.holds(right)
    if isinstance(right, Slope) and isinstance(left, Turn):
        return right.holds(left)
    return bool(left == right)
