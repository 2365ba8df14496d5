"""A wrist of three turns as Z-Y-Z Euler angles: each is a joint's angle up to a sign and quarter turns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly, Ring, Rotation, identity, matmul, transpose
from kinsym.algebra.tree import ZERO, Pi, Quot, Sym, Tree, add, mul, opposite, sub
from kinsym.kinematics.links import turn_z
from kinsym.methods.steps import TWO


@dataclass(frozen=True)
class Turn:
    """An Euler angle as ``sign * joint + quarters * pi/2``."""

    sign: int
    quarters: int

    def pair(self, c: Poly, s: Poly) -> tuple[Poly, Poly]:
        """Its cosine and sine by those of the joint."""
        s = s * self.sign
        for _ in range(self.quarters):
            c, s = -s, c
        return c, s

    def tree(self, joint: str) -> Tree:
        """The angle by the joint."""
        shift = (ZERO, Quot(Pi(), TWO), Pi(), opposite(Quot(Pi(), TWO)))[self.quarters]
        return add(mul(number(self.sign), Sym(joint)), shift)

    def back(self, angle: Sym) -> Tree:
        """The joint by the angle."""
        shift = (ZERO, Quot(Pi(), TWO), Pi(), opposite(Quot(Pi(), TWO)))[self.quarters]
        rest = sub(angle, shift) if shift != ZERO else angle
        return rest if self.sign > 0 else opposite(rest)


@dataclass(frozen=True)
class Fit:
    """The wrist as Z-Y-Z turns with a constant rotation behind them."""

    turns: tuple[Turn, Turn, Turn]
    behind: Rotation


def fitted(ring: Ring, wrist: Rotation, pairs: list[tuple[Poly, Poly]]) -> Fit | None:
    """The Euler angles of a wrist, the plainest first; None where axes are not at right angles."""
    turns = [Turn(sign, quarters) for quarters in range(4) for sign in (1, -1)]
    for behind in _quarter_turns(ring):
        x = matmul(ring, wrist, transpose(behind))
        for middle in turns:
            c, s = middle.pair(*pairs[1])
            if x[2][2] != c:
                continue
            first = [t for t in turns if _is_column((x[0][2], x[1][2]), t.pair(*pairs[0]), s, ring)]
            third = [t for t in turns if _is_column((-x[2][0], x[2][1]), t.pair(*pairs[2]), s, ring)]
            for phi, psi in product(first, third):
                if x == _euler(ring, phi.pair(*pairs[0]), (c, s), psi.pair(*pairs[2])):
                    return Fit((phi, middle, psi), behind)
    return None


def _is_column(entries: tuple[Poly, Poly], pair: tuple[Poly, Poly], sine: Poly, ring: Ring) -> bool:
    return all(entry == ring.mul(part, sine) for entry, part in zip(entries, pair, strict=True))


def _euler(ring: Ring, phi: tuple[Poly, Poly], eta: tuple[Poly, Poly], psi: tuple[Poly, Poly]) -> Rotation:
    zero, one = ring.zero, ring.one
    c, s = eta
    about_y: Rotation = ((c, zero, s), (zero, one, zero), (-s, zero, c))
    return matmul(ring, matmul(ring, turn_z(ring, *phi), about_y), turn_z(ring, *psi))


def _quarter_turns(ring: Ring) -> Iterator[Rotation]:
    """The 24 rotations by quarter turns, that by nothing first."""
    zero, unit = ring.zero, identity(ring)
    for order in permutations(range(3)):
        even = order in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        for signs in product((1, -1), repeat=3):
            if (signs[0] * signs[1] * signs[2] > 0) == even:
                yield tuple(
                    tuple(unit[order[i]][j] * signs[i] if unit[order[i]][j] else zero for j in range(3))
                    for i in range(3)
                )  # type: ignore[misc]
