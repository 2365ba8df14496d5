"""Determinants of sparse matrices over the ring, in the blocks that their zeros leave.

Six screws in a good frame are mostly zeros: the matrix of an arm with a spherical wrist falls into a block of the
position and one of the rotation, and the determinant is their product without ever being multiplied out.
"""

from __future__ import annotations

from itertools import combinations

from kinsym.algebra.ring import Poly, Ring

Rows = list[list[Poly]]


def block_determinants(ring: Ring, rows: Rows) -> list[Poly]:
    """Polynomials whose product is the determinant of a square matrix.

    k rows that vanish outside k columns are a block; the rest is the other one.
    """
    size = len(rows)
    support = [{column for column, entry in enumerate(row) if entry} for row in rows]
    for count in range(1, size):
        for columns in combinations(range(size), count):
            first = [row for row in range(size) if support[row] <= set(columns)][:count]
            if len(first) < count:
                continue
            corner = [[rows[row][column] for column in columns] for row in first]
            others = [column for column in range(size) if column not in columns]
            rest = [[rows[row][column] for column in others] for row in range(size) if row not in first]
            sign = -1 if (sum(first) + sum(columns)) % 2 else 1
            return [determinant(ring, corner) * sign, *block_determinants(ring, rest)]
    return [determinant(ring, rows)]


def determinant(ring: Ring, rows: Rows) -> Poly:
    """The determinant of a square matrix, row by row from the minors of the rows above."""
    minors: dict[int, Poly] = {0: ring.one}
    for row in rows:
        following: dict[int, Poly] = {}
        for taken, minor in minors.items():
            for column, entry in enumerate(row):
                if entry and not taken >> column & 1:
                    key = taken | 1 << column
                    odd = (taken >> column).bit_count() % 2
                    following[key] = following.get(key, ring.zero) + minor * (-entry if odd else entry)
        minors = {key: minor for key, total in following.items() if (minor := ring.reduce(total))}
    return minors.get((1 << len(rows)) - 1, ring.zero)


def expansion(rows: Rows) -> int:
    """How many terms the expansion of a determinant has: the permanent of the numbers of terms."""
    counts: dict[int, int] = {0: 1}
    for row in rows:
        following: dict[int, int] = {}
        for taken, count in counts.items():
            for column, entry in enumerate(row):
                if entry and not taken >> column & 1:
                    key = taken | 1 << column
                    following[key] = following.get(key, 0) + count * len(entry)
        counts = following
    return sum(counts.values())
