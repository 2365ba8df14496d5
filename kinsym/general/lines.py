"""The line l through the point p as 15 numbers that a rigid motion maps linearly, modulo the prime.

psi = (1, p, q, l, s, m, w) with q = p.p, s = p.l, m = p x l, w = q l - 2 s p. Its 14 entries behind the 1 are the
left sides of the equations of Raghavan and Roth (1990). A motion (R, t) maps

    p' = R p + t                q' = q + 2 t.(R p) + t.t
    l' = R l                    s' = s + t.(R l)
    m' = R m + t x (R l)        w' = R w - 2 t x (R m) + t.t R l - 2 (s + t.(R l)) t

and a joint about or along z splits a vector into parts that multiply sin, cos, 1 or d, d^2, 1.
"""

from __future__ import annotations

from kinsym.algebra.field import PRIME

Vector = list[int]
Motion = tuple[list[list[int]], list[int]]
"""Rotation rows and translation."""

E, P, Q, L, S, M, W = 0, slice(1, 4), 4, slice(5, 8), 8, slice(9, 12), slice(12, 15)
LENGTH = 15
AXIS: Vector = [1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]
"""The z axis through the origin, which a turn about z leaves as it is."""


def inverted(motion: Motion) -> Motion:
    """The inverse motion."""
    rotation, translation = motion
    turned = [list(column) for column in zip(*rotation, strict=True)]
    return turned, [-x % PRIME for x in times(turned, translation)]


def times(matrix: list[list[int]], vector: Vector) -> Vector:
    """A matrix times a column."""
    return [sum(a * b for a, b in zip(row, vector, strict=True)) % PRIME for row in matrix]


def product(left: Motion, right: Motion) -> Motion:
    """One motion after another: left * right."""
    columns = zip(*right[0], strict=True)
    rotation = [list(row) for row in zip(*(times(left[0], list(column)) for column in columns), strict=True)]
    return rotation, [(a + b) % PRIME for a, b in zip(times(left[0], right[1]), left[1], strict=True)]


def dot(left: Vector, right: Vector) -> int:
    """The scalar product."""
    return sum(a * b for a, b in zip(left, right, strict=True)) % PRIME


def cross(left: Vector, right: Vector) -> Vector:
    """The vector product."""
    (a, b, c), (x, y, z) = left, right
    return [(b * z - c * y) % PRIME, (c * x - a * z) % PRIME, (a * y - b * x) % PRIME]


def moved(motion: Motion, psi: Vector) -> Vector:
    """A motion applied to a state; where it is a part of one, its first entry is 0."""
    rotation, t = motion
    one, square = psi[E], dot(t, t)
    p, direction, m, w = (times(rotation, psi[part]) for part in (P, L, M, W))
    s = psi[S] + dot(t, direction)
    tm, tl = cross(t, m), cross(t, direction)
    return [
        one,
        *((a + one * b) % PRIME for a, b in zip(p, t, strict=True)),
        (psi[Q] + 2 * dot(t, p) + one * square) % PRIME,
        *direction,
        s % PRIME,
        *((a + b) % PRIME for a, b in zip(m, tl, strict=True)),
        *((a - 2 * b + square * c - 2 * s * d) % PRIME for a, b, c, d in zip(w, tm, direction, t, strict=True)),
    ]


def split(kind: str, sign: int, psi: Vector) -> list[Vector]:
    """The parts of a joint's motion of a state: those of sin, cos, 1, or of d, d^2, 1."""
    first, second, rest = [0] * LENGTH, [0] * LENGTH, list(psi)
    if kind == "R":
        for part in (P, L, M, W):
            x, y = part.start, part.start + 1
            first[x], first[y] = -sign * psi[y], sign * psi[x]
            second[x], second[y] = psi[x], psi[y]
            rest[x] = rest[y] = 0
    else:
        one, (lx, ly, lz), (mx, my, _) = psi[E], psi[L], psi[M]
        first[P] = [0, 0, sign * one]
        first[Q], first[S] = 2 * sign * psi[P.stop - 1], sign * lz
        first[M] = [-sign * ly, sign * lx, 0]
        first[W] = [2 * sign * my, -2 * sign * mx, -2 * sign * psi[S]]
        second[Q], second[W] = one, [lx, ly, -lz]
    return [[x % PRIME for x in part] for part in (first, second, rest)]


def spread(kind: str, sign: int, states: list[Vector]) -> list[Vector]:
    """The parts of many states, those of the first monomial first."""
    parts = [split(kind, sign, state) for state in states]
    return [part[k] for k in range(3) for part in parts]
