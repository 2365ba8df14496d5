"""Which two equations are two links in a plane: A e^(ix) + B e^(iy), A and B constant vectors of the plane."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from kinsym.algebra.ring import Poly, Ring
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain
from kinsym.methods.steps import AngleOf
from kinsym.methods.two_links import Plane, TwoLinks

Parts = dict[tuple[int, ...], Poly]

_UNITS = tuple(tuple(int(i == k) for i in range(4)) for k in range(4))
"""The exponents of cosine and sine of x, cosine and sine of y."""
_REST = (0, 0, 0, 0)


def coefficient(ring: Ring) -> Callable[[Parts, tuple[int, ...]], Poly]:
    """How a coefficient is read that may not be there."""
    return lambda parts, key: parts.get(key, ring.zero)


def as_links(
    chain: Chain, angles: Sequence[Angle], sides: Sequence[Poly], others: Sequence[Poly]
) -> tuple[TwoLinks, tuple[Poly, Poly]] | None:
    """Two equations, each as (left, right), as two links, and what is known of either; None if they are none.

    ``angles`` are the two that are unknown, which must share a node, so that the angle between them has a name.
    """
    ring = chain.ring
    if len(angles) != 2:
        return None
    x, y = angles
    shared = {x.low, x.high} & {y.low, y.high}
    if not shared:
        return None
    node = min(shared)
    ends = (x.low + x.high - node, y.low + y.high - node)
    names = (x.cosine, x.sine, y.cosine, y.sine)
    first, second = (ring.collect(right - left, names) for left, right in (sides, others))
    if not {*first, *second} <= {*_UNITS, _REST}:
        return None
    senses = [_sense(chain, angle, node, end) for angle, end in zip(angles, ends, strict=True)]
    vectors = [_vector(ring, first, second, 2 * k, sense) for k, sense in enumerate(senses)]
    if vectors[0] is None or vectors[1] is None:
        return None
    between = chain.angles[x.group, min(ends), max(ends)]
    links = TwoLinks(
        vectors[0],
        vectors[1],
        AngleOf(between.name, between.cosine, between.sine),
        chain.turn(x.group, *ends),
        AngleOf(x.name, x.cosine, x.sine),
        senses[0],
    )
    at = coefficient(ring)
    return links, (ring.zero - at(first, _REST), ring.zero - at(second, _REST))


def _sense(chain: Chain, angle: Angle, node: int, end: int) -> int:
    """Whether the turn from the shared node has the sign of the angle's own sine."""
    return 1 if chain.turn(angle.group, node, end)[1] == chain.ring[angle.sine] else -1


def _vector(ring: Ring, first: Parts, second: Parts, place: int, sense: int) -> Plane | None:
    """The link of one angle, constant and the same in both equations."""
    at = coefficient(ring)
    c, s = _UNITS[place], _UNITS[place + 1]
    along, across = at(first, c), at(first, s) * -sense
    if at(second, s) * sense != along or at(second, c) != across:
        return None
    return (along, across) if ring.is_constant(along) and ring.is_constant(across) else None
