"""Singular postures that need two conditions at once.

Where a task asks for more than an arm can move, the rank of J falls where all largest minors vanish. A factor of the
first of them that the others do not share is a value of one joint, such as ``s234 = 0``: there the second minor is
shorter, and its factors are looked at in turn.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from kinsym.algebra.factors import Factored, factored
from kinsym.algebra.ring import Poly
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.angle_sums import rewritten, spanning_trees
from kinsym.kinematics.singular.conditions import POSTURES, Arm, Condition, condition
from kinsym.kinematics.singular.zeros import Part, Zero, parts, postures

_TURNS = ((1, 0), (0, 1), (-1, 0), (0, -1))


def double_conditions(
    arm: Arm, lost: list[Poly], single: list[Condition], minors: Iterable[Factored]
) -> tuple[list[Condition], bool]:
    """The conditions on the zeros of the factors ``lost``, and whether there are no others.

    ``single`` are the conditions that stand alone, ``minors`` the other largest minors.
    """
    chain, minors = arm.chain, list(minors)
    sets: dict[tuple[Poly, Poly], list[Zero]] = {}
    exhaustive = True
    for poly in lost:
        for part in parts(chain, poly):
            factors = _second(chain, part, minors) if part.variable else None
            exhaustive &= factors is not None
            for factor in factors or []:
                zeros = sets.setdefault((poly, factor), [])
                zeros += [(part, other) for other in parts(chain, factor)]
    found: list[Condition] = []
    for (first, second), zeros in sets.items():
        one = condition(arm, zeros)
        exhaustive &= one is not None and one.whole
        if one is not None and not any(_covers(arm, other, one) for other in (*single, *found)):
            everywhere = len(one.zeros) == len(parts(chain, first)) * len(parts(chain, second))
            found += [one] if everywhere else [replace(one, zeros=(zero,), whole=False) for zero in one.zeros]
    return found, exhaustive


def _covers(arm: Arm, condition: Condition, other: Condition) -> bool:
    """Whether a condition holds wherever another one holds."""
    ring = arm.chain.ring
    return not any(
        ring.evaluate(poly, posture.values)
        for zero in other.zeros
        for posture in postures(arm.chain, zero, POSTURES)
        for poly in condition.polys
    )


def _second(chain: Chain, part: Part, minors: list[Factored]) -> list[Poly] | None:
    """The factors of the first minor that does not vanish on a part, as they are there; None if all vanish."""
    for minor in minors:
        factors = [_restricted(chain, part, poly) for poly, _ in minor.factors]
        if all(factors):
            return list(dict.fromkeys(poly for poly, _ in factored(chain.ring, factors).factors))
    return None


def _restricted(chain: Chain, part: Part, poly: Poly) -> Poly:
    """A polynomial where a joint, or a sum of joints, has the value of a part; its sign is made positive."""
    ring = chain.ring
    given = {part.variable: ring.zero} if part.variable in ring else {}
    choices = [poly]
    for (group, low, high), angle in chain.angles.items():
        if angle.name == part.variable:
            c, s = _TURNS[part.quarters]
            given = {angle.cosine: ring.number(c), angle.sine: ring.number(s)}
            own = chain.groups[group]
            choices = [rewritten(chain, own, edges, poly) for edges in spanning_trees(own) if (low, high) in edges]
    found = [_with(chain, choice, given) for choice in choices]
    shortest = min(found, key=lambda choice: (len(choice), sum(map(sum, choice))))
    return -shortest if shortest and shortest.LC < 0 else shortest


def _with(chain: Chain, poly: Poly, given: dict[str, Poly]) -> Poly:
    """A polynomial with values for some generators."""
    ring = chain.ring
    names = list(given)
    total = ring.zero
    for exponents, rest in ring.collect(poly, names).items():
        term = rest
        for name, exponent in zip(names, exponents, strict=True):
            term = ring.mul(term, given[name] ** exponent) if exponent else term
        total = total + term
    return total
