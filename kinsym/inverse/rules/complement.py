"""A second statement of squares that add up, by what is left of a unit vector.

Where X^2 + Y^2 = 1 and Y = p c + q s is one component of a unit vector that turns with (c, s), the others are
Z = q c - p s and one that does not turn, W, an entry of the pose. So X^2 = Z^2 + W^2 states the same of (c, s). Where
Y is next to 1, X, Z and W are small, and 1 - Y^2 has lost the digits that they have.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from kinsym.algebra.ring import Poly
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import View
from kinsym.inverse.rules.turned_pair import Pair, Side, eliminant_of, proportional
from kinsym.inverse.state import State


def complement(view: View, pair: Pair) -> Pair | None:
    """The same equation for the other angle by the rest of the unit vector, or None if there is no such vector."""
    state = view.state
    eliminant = eliminant_of(state, pair)
    for left in _by_the_rest(view, pair):
        if proportional(eliminant_of(state, left), eliminant):
            return left
    return None


def _by_the_rest(view: View, pair: Pair) -> Iterator[Pair]:
    """What the complement might be, shortest first, for each side that turns as a whole."""
    state = view.state
    zero = state.chain.ring.zero
    if any((*pair.k1[:2], *pair.k2[:2])):
        return
    for kept, turned in (pair.sides, pair.sides[::-1]):
        p, q, constant = turned.rest
        if constant or not (p or q):
            continue
        scale = turned.scale
        multiply = state.chain.ring.mul
        a, b, e = (multiply(part, scale) for part in kept.rest)
        weights = tuple((multiply(weight, scale), unit) for weight, unit in kept.weights)
        side = Side((a, b, e), kept.scale, weights)
        for entry, equation in _entries(view):
            yield replace(
                pair,
                k1=(q, -p, zero),
                k2=(zero, zero, entry),
                sides=(side, Side((zero, zero, zero), state.chain.ring.one, ())),
                equations=(pair.equations[0], equation),
            )


def _entries(view: View) -> list[tuple[Poly, PoolEquation]]:
    """Directions that are known, with an equation that has each of them on its left side alone."""
    entries: dict[Poly, PoolEquation] = {}
    for equation in view.equations:
        if equation.unit == 0 and _is_known(view.state, equation):
            entries.setdefault(equation.lhs, equation)
    return sorted(entries.items(), key=lambda item: len(item[0]))


def _is_known(state: State, equation: PoolEquation) -> bool:
    """Whether the left side is not zero and holds no unknown."""
    unknown = {name for angle in equation.angles for name in (angle.cosine, angle.sine)} | set(equation.lengths)
    return bool(equation.lhs) and not unknown.intersection(state.chain.ring.used(equation.lhs))
