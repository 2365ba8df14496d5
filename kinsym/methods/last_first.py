"""A polynomial nested by the last joint first: (-w_x s1 + w_y c1) c2 + w_z s2.

The lecture writes vectors so that it has turned back joint by joint, the last of the joints outermost.
"""

from __future__ import annotations

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Kind, Poly, Ring
from kinsym.algebra.tree import ZERO, Sum, Sym, Tree, add, mul, negated, negative


def last_first(ring: Ring, poly: Poly) -> Tree:
    """The polynomial as a tree, collected in the last angle that occurs.

    >>> from kinsym.algebra.ring import Generator
    >>> names = (("c1", Kind.COSINE), ("s1", Kind.SINE), ("c2", Kind.COSINE), ("s2", Kind.SINE))
    >>> ring = Ring([Generator(name, kind) for name, kind in names])
    >>> from kinsym.emit.text.formula import TextPrinter
    >>> TextPrinter()(last_first(ring, ring["c1"] * ring["c2"] + ring["s1"] * ring["c2"] + ring["s2"]))
    'c2*(c1 + s1) + s2'
    """
    cosines = [name for name in ring.used(poly) if _kind(ring, name) in (Kind.COSINE, Kind.SINE)]
    if not poly or not cosines:
        return nested(ring, poly) if poly else ZERO
    label = cosines[-1][1:]
    names = ("c" + label, "s" + label)
    groups = ring.collect(poly, names)
    rest = groups.pop((0, 0), None)
    terms: list[Tree] = []
    for key in sorted(groups, reverse=True):
        powers = [Sym(name) for name, power in zip(names, key, strict=True) for _ in range(power)]
        inner = last_first(ring, groups[key])
        flipped = isinstance(inner, Sum) and all(map(negative, inner.terms))
        term = mul(*powers, negated(inner) if flipped else inner)
        terms.append(negated(term) if flipped else term)
    if rest is not None:
        terms.append(last_first(ring, rest))
    first = next((i for i, term in enumerate(terms) if not negative(term)), 0)
    return add(terms[first], *terms[:first], *terms[first + 1 :])


def _kind(ring: Ring, name: str) -> Kind:
    return ring.generators[ring.index[name]].kind
