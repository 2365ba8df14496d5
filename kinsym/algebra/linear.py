"""Vectors and linear equations modulo the prime."""

from __future__ import annotations

from collections.abc import Sequence

from kinsym.algebra.field import PRIME, inverse

Numbers = tuple[int, int, int]


def cross(left: Sequence[int], right: Sequence[int]) -> Numbers:
    """The vector product."""
    (a, b, c), (x, y, z) = left, right
    return (b * z - c * y) % PRIME, (c * x - a * z) % PRIME, (a * y - b * x) % PRIME


def dot(left: Sequence[int], right: Sequence[int]) -> int:
    """The scalar product."""
    return sum(a * b for a, b in zip(left, right, strict=True)) % PRIME


def difference(left: Sequence[int], right: Sequence[int]) -> Numbers:
    """``left - right``."""
    x, y, z = ((a - b) % PRIME for a, b in zip(left, right, strict=True))
    return x, y, z


def kernel(rows: Sequence[Sequence[int]]) -> list[list[int]]:
    """A basis of the vectors that a matrix takes to zero.

    >>> [[value if value < 9 else value - PRIME for value in vector] for vector in kernel([[1, 2], [2, 4]])]
    [[-2, 1]]
    """
    matrix = [[value % PRIME for value in row] for row in rows]
    count = len(matrix[0])
    pivots: list[int] = []
    for column in range(count):
        found = len(pivots)
        row = next((i for i in range(found, len(matrix)) if matrix[i][column]), None)
        if row is None:
            continue
        matrix[found], matrix[row] = matrix[row], matrix[found]
        scale = inverse(matrix[found][column])
        matrix[found] = [value * scale % PRIME for value in matrix[found]]
        for i, line in enumerate(matrix):
            if i != found and line[column]:
                factor = line[column]
                matrix[i] = [(a - factor * b) % PRIME for a, b in zip(line, matrix[found], strict=True)]
        pivots.append(column)
    basis = []
    for free in (column for column in range(count) if column not in pivots):
        vector = [0] * count
        vector[free] = 1
        for row, column in enumerate(pivots):
            vector[column] = -matrix[row][free] % PRIME
        basis.append(vector)
    return basis


def determinant(rows: Sequence[Sequence[int]]) -> int:
    """The determinant of a square matrix.

    >>> determinant([[2, 1], [1, 3]])
    5
    """
    matrix = [list(row) for row in rows]
    value = 1
    for column in range(len(matrix)):
        row = next((i for i in range(column, len(matrix)) if matrix[i][column] % PRIME), None)
        if row is None:
            return 0
        if row != column:
            matrix[row], matrix[column] = matrix[column], matrix[row]
            value = -value
        value = value * matrix[column][column] % PRIME
        scale = inverse(matrix[column][column])
        for line in matrix[column + 1 :]:
            factor = line[column] * scale % PRIME
            line[column:] = [
                (a - factor * b) % PRIME for a, b in zip(line[column:], matrix[column][column:], strict=True)
            ]
    return value % PRIME
