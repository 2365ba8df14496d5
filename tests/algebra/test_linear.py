"""Vectors and matrices modulo the prime, against the same in whole numbers."""

from __future__ import annotations

import random
from itertools import permutations

import pytest

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import cross, determinant, difference, dot, kernel

GENERATOR = random.Random(8)
VECTORS = [(1, 0, 0), (0, 0, 5), *(tuple(GENERATOR.randrange(-99, 99) for _ in range(3)) for _ in range(4))]


@pytest.mark.parametrize("left", VECTORS)
@pytest.mark.parametrize("right", VECTORS)
def test_products_and_differences_are_residues(left: tuple[int, ...], right: tuple[int, ...]) -> None:
    (a, b, c), (x, y, z) = left, right
    assert cross(left, right) == tuple(value % PRIME for value in (b * z - c * y, c * x - a * z, a * y - b * x))
    assert difference(left, right) == tuple((one - other) % PRIME for one, other in zip(left, right, strict=True))
    assert dot(left, right) == (a * x + b * y + c * z) % PRIME


def by_permutations(rows: list[list[int]]) -> int:
    """The determinant by its definition."""
    total = 0
    for order in permutations(range(len(rows))):
        term = (-1) ** sum(order[i] > order[j] for j in range(len(order)) for i in range(j))
        for row, column in zip(rows, order, strict=True):
            term *= row[column]
        total += term
    return total % PRIME


def matrices(count: int) -> list[list[list[int]]]:
    """Square matrices with many zeros."""
    generator = random.Random(9)
    sizes = [generator.randrange(1, 6) for _ in range(count)]
    return [[[generator.choice((0, 0, 1, -2, 3, 7)) for _ in range(n)] for _ in range(n)] for n in sizes]


def test_determinants_are_those_of_the_definition() -> None:
    found = [(determinant(rows), by_permutations(rows)) for rows in matrices(60)]
    assert all(one == other for one, other in found)
    assert sum(one == 0 for one, _ in found) > 5 < sum(one != 0 for one, _ in found)


def test_a_kernel_holds_all_that_a_matrix_takes_to_zero() -> None:
    """As many vectors as columns lack a pivot, each of them with a one where the others have zeros."""
    for rows in matrices(60):
        before = [list(row) for row in rows]
        basis = kernel(rows)
        assert rows == before
        assert all(dot(row, vector) == 0 for vector in basis for row in rows)
        assert (len(basis) > 0) == (determinant(rows) == 0)
        for vector in basis:
            free = max(place for place, value in enumerate(vector) if value)
            assert vector[free] == 1
            assert [other[free] for other in basis].count(0) == len(basis) - 1
            assert all(0 <= value < PRIME for value in vector)
    assert kernel([[0, 0]]) == [[1, 0], [0, 1]]
    assert len(kernel([[1, 2, 3, 4], [2, 4, 6, 8], [0, 0, 0, 0]])) == 3
    assert kernel([[2, 0], [0, 3], [1, 1]]) == []
