"""Cosine and sine of an angle from several equations ``a c + b s = e``, each by the shortest way.

A way is a weighted sum of right sides over a divisor: one equation that lacks the other function, Cramer's rule with
two, or two that lack it weighted with their own coefficients where the squares of these add up to a number.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Ring
from kinsym.algebra.tree import ZERO, Call, Num, Sum, Sym, Tree, add, mul, negative
from kinsym.methods.document import Equation
from kinsym.methods.draft import Draft
from kinsym.methods.steps import AngleOf, Row, quotient


@dataclass(frozen=True)
class Weighted:
    """``(w1 e1 + w2 e2) / divisor``, with the places of the equations it takes."""

    terms: tuple[tuple[Poly, Tree], ...]
    divisor: Poly
    sources: tuple[int, ...]

    @property
    def constant(self) -> bool:
        """Whether nothing can make it fail."""
        return bool(self.divisor.is_ground)

    @property
    def cost(self) -> tuple[bool, int, int, int]:
        """Plain divisors first, then short ones, then few equations."""
        return (
            not self.constant,
            len(self.divisor),
            len(self.sources),
            sum(len(weight) for weight, _ in self.terms),
        )

    def above(self, ring: Ring) -> Tree:
        """The numerator, a term without a minus sign first."""
        terms = [mul(nested(ring, weight), e) for weight, e in self.terms]
        terms = [term for term in terms if term != ZERO]
        if len(terms) == 2 and negative(terms[0]) and not negative(terms[1]):
            terms.reverse()
        return add(*terms)


Vanishes = Callable[[Poly], bool]


def cosine_and_sine(ring: Ring, rows: Sequence[Row], vanishes: Vanishes) -> tuple[Weighted, Weighted] | None:
    """The shortest way to each of them; None where the equations do not give both."""
    swapped = [Row(row.b, row.a, row.e) for row in rows]
    cosines = list(_ways(ring, rows, vanishes))
    sines = list(_ways(ring, swapped, vanishes))
    if not cosines or not sines:
        return None
    return min(cosines, key=lambda way: way.cost), min(sines, key=lambda way: way.cost)


def _ways(ring: Ring, rows: Sequence[Row], vanishes: Vanishes) -> Iterator[Weighted]:
    """The ways to what has the coefficients ``a``."""
    for i, row in enumerate(rows):
        if not row.b and not vanishes(row.a):
            yield _reduced(ring, [(ring.one, row.e)], row.a, (i,))
    for i, j in combinations(range(len(rows)), 2):
        first, second = rows[i], rows[j]
        if not first.b and not second.b:
            length = ring.reduce(first.a * first.a + second.a * second.a)
            if length and length.is_ground:
                yield _reduced(ring, [(first.a, first.e), (second.a, second.e)], length, (i, j))
            continue
        below = ring.reduce(first.a * second.b - second.a * first.b)
        if not vanishes(below):
            yield _reduced(ring, [(second.b, first.e), (-first.b, second.e)], below, (i, j))


def _reduced(ring: Ring, terms: list[tuple[Poly, Tree]], divisor: Poly, sources: tuple[int, ...]) -> Weighted:
    """In lowest terms, the divisor's first coefficient positive."""
    common = divisor
    for weight, _ in terms:
        common = common.gcd(weight)
    divisor, terms = divisor.quo(common), [(weight.quo(common), e) for weight, e in terms]
    content = divisor.content() * (1 if divisor.LC > 0 else -1)
    divided = tuple((weight.quo_ground(content), e) for weight, e in terms if weight)
    return Weighted(divided, divisor.quo_ground(content), sources)


def solve_by(draft: Draft, angle: AngleOf, c: Weighted, s: Weighted, *, determinant: str = "") -> None:
    """State cosine and sine, then the angle by Atan2; at once where both are short. ``determinant`` names a divisor."""
    ring = draft.ring
    divisors = [nested(ring, way.divisor) for way in (c, s)]
    above = [way.above(ring) for way in (c, s)]
    plain = all(isinstance(e, Sym) for way in (c, s) for _, e in way.terms)
    single = len(c.terms) == len(s.terms) == 1 and all(weight.is_ground for way in (c, s) for weight, _ in way.terms)
    conditions: list[Equation] = []
    if determinant and divisors[0] == divisors[1] and isinstance(divisors[0], Sum):
        name = draft.define(draft.fresh(determinant), divisors[0])
        divisors = [name, name]
    for divisor in dict.fromkeys(divisors):
        if not isinstance(divisor, Num):
            suffix = "" if not conditions else ".too"
            conditions.append(draft.require(f"{angle.name}.unique{suffix}", divisor, "!=", ZERO))
    whole = [quotient(top, bottom) for top, bottom in zip(above, divisors, strict=True)]
    if not any(isinstance(divisor, Sum) for divisor in divisors) and not determinant and (plain or single):
        y, x = whole[1], whole[0]
    else:
        draft.state(f"{angle.name}.c", angle.c, whole[0])
        draft.state(f"{angle.name}.s", angle.s, whole[1])
        y, x = angle.s, angle.c
    draft.solve(angle.name, Call("atan2", (y, x)), branches=1, conditions=conditions)
