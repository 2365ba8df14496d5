"""Two links in a plane: A e^(ix) + B e^(iy) = k1 + i k2 (lecture, slides 52, 53 and 70).

Squared and added, the angle y - x is left alone; with it known the two equations are linear in the cosine and sine of
x. A and B are plane vectors; along the first axis they are the lecture's a1 and a2.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Ring
from kinsym.algebra.tree import Call, PlusMinus, Tree, add, mul, sub
from kinsym.methods.draft import Draft
from kinsym.methods.steps import AngleOf, Row, one_row, quotient, square, two_rows

Plane = tuple[Poly, Poly]


@dataclass(frozen=True)
class TwoLinks:
    """``first`` and ``second`` are A and B; ``turn`` holds cosine and sine of y - x, whose angle is ``between``.

    ``x`` is the angle of the first link; ``flip`` is -1 where its sine has the opposite sign in the table.
    """

    first: Plane
    second: Plane
    between: AngleOf
    turn: Plane
    x: AngleOf
    flip: int


def solve_two_links(
    draft: Draft, links: TwoLinks, known: tuple[Tree, Tree], *, kappa: str = "", determinant: str = ""
) -> None:
    """State the squares, solve for the angle between the links, then for the first angle.

    ``kappa`` names the cosine that the squares give, ``determinant`` that of the two linear equations.
    """
    ring = draft.ring
    state_squares(draft, links, known)
    row = squares_row(draft, links, known)
    a, b = row.a, row.b
    if kappa and not b:
        value = draft.define(draft.fresh(kappa), quotient(row.e, nested(ring, a)))
        limit = draft.require(f"{links.between.name}.real", Call("abs", (value,)), "<=", draft.tree(ring.one))
        draft.solve(links.between.name, PlusMinus(None, Call("acos", (value,))), branches=2, conditions=(limit,))
    else:
        one_row(draft, ring, links.between, row)
    draft.say(
        f"With `{links.between.name}` known both equations are linear in the cosine and sine of `{links.x.name}`,"
    )
    rows = expanded(ring, links, known)
    for name, part in zip("xy", rows, strict=True):
        c, s = links.x.c, links.x.s
        left = add(mul(nested(ring, part.a), c), mul(nested(ring, part.b), s))
        draft.state(f"{links.x.name}.row.{name}", left, part.e)
    two_rows(draft, ring, links.x, *rows, determinant=determinant)


def state_squares(draft: Draft, links: TwoLinks, known: tuple[Tree, Tree]) -> None:
    """``|A|^2 + |B|^2 + 2 A.B cos + ... = k1^2 + k2^2``."""
    constant, a, b = _squared(draft.ring, links)
    between = links.between
    left = add(draft.tree(constant), mul(draft.tree(a), between.c), mul(draft.tree(b), between.s))
    draft.state(f"{between.name}.squares", left, add(*map(square, known)))


def squares_row(draft: Draft, links: TwoLinks, known: tuple[Tree, Tree]) -> Row:
    """The same as ``a c + b s = e``."""
    constant, a, b = _squared(draft.ring, links)
    return Row(a, b, sub(add(*map(square, known)), draft.tree(constant)))


def _squared(ring: Ring, links: TwoLinks) -> tuple[Poly, Poly, Poly]:
    (a1, a2), (b1, b2) = links.first, links.second
    constant = ring.reduce(a1 * a1 + a2 * a2 + b1 * b1 + b2 * b2)
    along, across = ring.reduce(a1 * b1 + a2 * b2), ring.reduce(a2 * b1 - a1 * b2)
    parts = ring.collect(ring.reduce(2 * (along * links.turn[0] + across * links.turn[1])), _names(links.between))
    return constant, parts.get((1, 0), ring.zero), parts.get((0, 1), ring.zero)


def expanded(ring: Ring, links: TwoLinks, known: tuple[Tree, Tree]) -> tuple[Row, Row]:
    """Both equations in the cosine and sine of x, the angle between the links known."""
    (a1, a2), (b1, b2), (c, s) = links.first, links.second, links.turn
    along = ring.reduce(a1 + b1 * c - b2 * s)
    across = ring.reduce(a2 + b1 * s + b2 * c)
    return Row(along, -across * links.flip, known[0]), Row(across, along * links.flip, known[1])


def _names(angle: AngleOf) -> tuple[str, str]:
    return angle.cosine, angle.sine
