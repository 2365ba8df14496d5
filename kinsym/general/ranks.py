"""Which of the 24 cuts of a loop can be used, decided exactly modulo the prime at one generic pose."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import product as pairs

from kinsym.algebra.field import PRIME, angle_point, circle_point, inverse
from kinsym.deadline import Deadline
from kinsym.general.arm import JOINTS, NOTHING, Arm
from kinsym.general.lines import AXIS, Motion, Vector, inverted, moved, product, spread
from kinsym.general.plan import Cut
from kinsym.general.tables import DEGREE
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.tasks import rank

Matrix = list[list[int]]

RIGHT = 8
"""Unknown products of the two joints that are eliminated linearly, the constant left out."""
SIZE = 12
TURNS = 36
"""Roots of unity at which a determinant is taken; its exponents lie between -12 and 12."""


def candidates() -> Iterator[Cut]:
    """The 24 cuts in order."""
    for dropped, backward, shift in pairs(range(1, JOINTS + 1), (False, True), (False, True)):
        yield Cut(dropped=dropped, backward=backward, shift=shift, bordered=False)


def usable(arm: Arm, deadline: Deadline = NO_LIMIT) -> list[Cut]:
    """The cuts whose determinant has degree 8 and vanishes at the solutions alone, each in its mode."""
    links, joints = _loop(arm, NOTHING)
    found: list[Cut] = []
    for cut in candidates():
        deadline.note("no closed form, the ways round the loop are looked at")
        if (mode := _mode(cut, links, joints)) is not None:
            found.append(mode)
    return found


def holds(arm: Arm, cut: Cut, given: Mapping[str, int]) -> bool:
    """Whether a cut can be used in its mode also where the constants of the table are as given."""
    return _mode(replace(cut, bordered=False), *_loop(arm, given)) == cut


def _loop(arm: Arm, given: Mapping[str, int]) -> tuple[list[Motion], list[_Joint]]:
    """The links of the loop that a random pose closes, and the joints at that pose."""
    generator = random.Random("general")
    links = arm.values(generator, given)
    joints = [_Joint(kind, sign, generator) for kind, sign in zip(arm.kinds, arm.signs, strict=True)]
    closing: Motion = joints[0].motion
    for link, joint in zip(links, joints[1:], strict=False):
        closing = product(product(closing, link), joint.motion)
    links[-1] = inverted(closing)
    return links, joints


class _Joint:
    """A joint at a random place: its motion, and its monomials sin, cos, 1 or d, d^2, 1."""

    def __init__(self, kind: str, sign: int, generator: random.Random) -> None:
        self.kind, self.sign = kind, sign
        if kind == "R":
            c, s = circle_point(generator)
            self.monomials = [s, c, 1]
            self.motion: Motion = [[c, -sign * s, 0], [sign * s, c, 0], [0, 0, 1]], [0, 0, 0]
        else:
            d = generator.randrange(1, PRIME)
            self.monomials = [d, d * d % PRIME, 1]
            self.motion = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, sign * d]


def _mode(cut: Cut, links: list[Motion], joints: list[_Joint]) -> Cut | None:
    """The cut, marked as bordered where two ranks are lost at a solution; None if it cannot be used."""
    order = [joints[number - 1] for number in cut.order]
    x = order[4] if cut.shift else order[3]
    if order[2].kind == "P" or order[5].kind == "P":
        return None
    six = _six_rows(cut, links, order)
    if six is None:
        return None
    system = _System(six, cut.shift, x.kind)
    elsewhere = circle_point(random.Random("elsewhere"))
    if rank(system.matrix(elsewhere)) < SIZE:
        return None
    sine, cosine, _ = order[2].monomials
    lost = SIZE - rank(system.matrix((cosine, sine)))
    if lost not in (1, 2) or not _of_degree(system):
        return None
    return replace(cut, bordered=lost == 2)


def _six_rows(cut: Cut, links: list[Motion], order: list[_Joint]) -> Matrix | None:
    """The six equations in joints 2, 3, 4 that are left when joints 0 and 1 are eliminated; None if not six."""
    direction = -1 if cut.backward else 1
    steps = [inverted(links[k - 1]) if cut.backward else links[k - 1] for k in cut.links]
    left: list[Vector] = [AXIS]
    for k in (4, 3, 2):
        left = [moved(steps[k], state) for state in left]
        left = spread(order[k].kind, direction * order[k].sign, left)
    right: list[Vector] = [moved(inverted(steps[5]), AXIS)]
    for k in (0, 1):
        right = spread(order[k].kind, -direction * order[k].sign, right)
        right = [moved(inverted(steps[k]), state) for state in right]
    left[-1] = [(a - b) % PRIME for a, b in zip(left[-1], right[-1], strict=True)]
    rows = [list(row) for row in zip(*right[:-1], *left, strict=True)][1:]
    return _eliminated(rows, RIGHT)


def _eliminated(rows: Matrix, columns: int) -> Matrix | None:
    """What is left of the rows without their first columns, made zero; None if these depend on each other."""
    for done in range(columns):
        pivot = next((i for i in range(done, len(rows)) if rows[i][done]), None)
        if pivot is None:
            return None
        rows[done], rows[pivot] = rows[pivot], rows[done]
        scale = inverse(rows[done][done])
        for i in range(done + 1, len(rows)):
            if rows[i][done]:
                factor = rows[i][done] * scale % PRIME
                rows[i] = [(a - factor * b) % PRIME for a, b in zip(rows[i], rows[done], strict=True)]
    return [row[columns:] for row in rows[columns:]]


class _System:
    """The 12 x 12 matrix of the unknowns X^3 W, X^2 W, X W, W as a function of the suppressed angle.

    X is the tangent of half of x; W = (sin y, cos y, 1).
    """

    def __init__(self, six: Matrix, shift: bool, kind: str) -> None:
        self.parts: list[list[Matrix]] = []
        for m in range(3):
            blocks = []
            for n in range(3):
                places = [9 * m + (3 * k + n if shift else 3 * n + k) for k in range(3)]
                blocks.append([[row[place] for place in places] for row in six])
            self.parts.append(_half_angle(blocks) if kind == "R" else [blocks[1], blocks[0], blocks[2]])

    def matrix(self, point: tuple[int, int]) -> Matrix:
        """The matrix at (cosine, sine) of the suppressed angle."""
        c, s = point
        blocks = [
            [
                [(s * a + c * b + e) % PRIME for a, b, e in zip(*rows, strict=True)]
                for rows in zip(*(part[k] for part in self.parts), strict=True)
            ]
            for k in range(3)
        ]
        zero = [0, 0, 0]
        upper = [[*a, *b, *c, *zero] for a, b, c in zip(*blocks, strict=True)]
        lower = [[*zero, *a, *b, *c] for a, b, c in zip(*blocks, strict=True)]
        return upper + lower


def _half_angle(blocks: list[Matrix]) -> list[Matrix]:
    """Coefficients of sin, cos, 1 to those of X^2, X, 1, multiplied by 1 + X^2."""
    sine, cosine, one = blocks
    return [
        [[(e - b) % PRIME for b, e in zip(*rows, strict=True)] for rows in zip(cosine, one, strict=True)],
        [[2 * a % PRIME for a in row] for row in sine],
        [[(e + b) % PRIME for b, e in zip(*rows, strict=True)] for rows in zip(cosine, one, strict=True)],
    ]


def _of_degree(system: _System) -> bool:
    """Whether the determinant is a trigonometric polynomial of degree 8 at most."""
    points = [point for j in range(TURNS) if (point := angle_point(Fraction(2 * j, TURNS)))]
    values = [determinant(system.matrix(point)) for point in points]
    for k in range(DEGREE + 1, SIZE + 1):
        waves = [points[j * k % TURNS] for j in range(TURNS)]
        if any(sum(value * wave[part] for value, wave in zip(values, waves, strict=True)) % PRIME for part in (0, 1)):
            return False
    return True


def determinant(rows: Matrix) -> int:
    """The determinant modulo the prime."""
    rows, value = [list(row) for row in rows], 1
    for done in range(len(rows)):
        pivot = next((i for i in range(done, len(rows)) if rows[i][done]), None)
        if pivot is None:
            return 0
        if pivot != done:
            rows[done], rows[pivot], value = rows[pivot], rows[done], -value
        value = value * rows[done][done] % PRIME
        scale = inverse(rows[done][done])
        for i in range(done + 1, len(rows)):
            if rows[i][done]:
                factor = rows[i][done] * scale % PRIME
                rows[i] = [(a - factor * b) % PRIME for a, b in zip(rows[i], rows[done], strict=True)]
    return value % PRIME
