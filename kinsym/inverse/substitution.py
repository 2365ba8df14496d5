"""Equations without a prismatic variable: it is taken from one equation and put into the others.

Where an equation holds a length with a constant factor, a d + r = 0, every other equation of degree k in d becomes one
without it, multiplied by a^k. What is left has one unknown less, so that rules for two unknowns reach arms with a
prismatic joint between two others (RPR and PRP before a wrist, three prismatic joints at any place).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from kinsym.algebra.ring import Poly
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.state import State

SOURCES = 3
"""From how many equations, the shortest, each length is taken."""
ROUNDS = 2
"""How many lengths are put in one after the other."""
HIGHEST = 2
"""The highest power of a length that is replaced."""
LONGEST = 400
"""How many products of terms it may take: what comes out of more leads to steps that nobody reads, in minutes."""


@dataclass(frozen=True)
class Source:
    """An equation that gives a length: ``factor d + rest = 0`` with a constant factor."""

    equation: PoolEquation
    variable: str
    factor: Poly
    rest: Poly


def substituted(state: State, equations: Iterable[PoolEquation]) -> list[PoolEquation]:
    """Equations with at most two unknowns that come out when lengths are replaced."""
    known = list(equations)
    seen = {_key(equation) for equation in known}
    result: list[PoolEquation] = []
    for _ in range(ROUNDS):
        fresh = []
        for equation in _once(state, known):
            key = _key(equation)
            if key not in seen:
                seen.add(key)
                fresh.append(equation)
        known += fresh
        result += fresh
        if not fresh:
            break
    return [equation for equation in result if equation.unknowns <= 2]


def _key(equation: PoolEquation) -> Poly:
    poly = equation.poly
    return poly.quo_ground(poly.LC) if poly else poly


def _once(state: State, equations: list[PoolEquation]) -> Iterator[PoolEquation]:
    ring = state.chain.ring
    for variable in dict.fromkeys(length for equation in equations for length in equation.lengths):
        holding = [equation for equation in equations if variable in equation.lengths]
        holding.sort(key=lambda equation: (equation.unknowns, len(equation.poly)))
        sources: list[Source] = []
        for equation in holding:
            parts = ring.collect(equation.poly, (variable,))
            if len(sources) < SOURCES and equation.unit == 1 and set(parts) <= {(0,), (1,)}:
                factor = parts[(1,)]
                if ring.is_constant(factor) and not state.vanishes(factor):
                    sources.append(Source(equation, variable, factor, parts.get((0,), ring.zero)))
        for source in sources:
            others = _unknowns(source.equation) - {variable}
            for equation in holding:
                if equation is source.equation or len(others | (_unknowns(equation) - {variable})) > 2:
                    continue
                if len(equation.poly) * len(source.rest) > LONGEST:
                    continue
                state.deadline.check()
                found = _put(state, equation, source)
                if found is not None:
                    yield found


def _unknowns(equation: PoolEquation) -> set[str]:
    return {*equation.lengths, *(angle.label for angle in equation.angles)}


def _put(state: State, equation: PoolEquation, source: Source) -> PoolEquation | None:
    ring, variable, factor, rest = state.chain.ring, source.variable, source.factor, source.rest
    parts: dict[int, Poly] = {key[0]: part for key, part in ring.collect(equation.poly, (variable,)).items()}
    degree = max(parts)
    if degree > HIGHEST:
        return None
    scale = factor
    if factor.is_ground:
        rest, scale = rest.quo_ground(factor.coeff(1)), ring.one
    total = ring.zero
    for power, part in parts.items():
        product = part
        for _ in range(power):
            product = -ring.mul(product, rest)
        for _ in range(degree - power):
            product = ring.mul(product, scale)
        total += product
    total = ring.reduce(total)
    if not total:
        return None
    return _separated(state, total, equation, source)


def _separated(state: State, poly: Poly, equation: PoolEquation, source: Source) -> PoolEquation | None:
    """A polynomial that is zero as an equation, what is known on the left."""
    ring, other = state.chain.ring, source.equation
    angles = {angle.label: angle for angle in (*equation.angles, *other.angles)}
    lengths = dict.fromkeys((*equation.lengths, *other.lengths))
    used = set(ring.used(poly))
    kept = tuple(angle for angle in angles.values() if angle.cosine in used or angle.sine in used)
    slides = tuple(length for length in lengths if length in used)
    if not kept and not slides:
        return None
    names = [*(name for angle in kept for name in (angle.cosine, angle.sine)), *slides]
    constant = (0,) * len(names)
    lhs: Poly = ring.collect(poly, names).get(constant, ring.zero)
    text = f"{equation.source}, with {source.variable} by {other.source}"
    return PoolEquation(lhs, lhs - poly, equation.unit, text, kept, slides)
