"""Trees evaluated modulo the prime."""

from __future__ import annotations

from collections.abc import Mapping

from kinsym.algebra.field import PRIME, inverse, residue
from kinsym.algebra.tree import Num, Pow, Prod, Quot, Sum, Sym, Tree


def residue_of(tree: Tree, values: Mapping[str, int]) -> int | None:
    """The value of a tree; None where a name has no value, a function is no polynomial or a denominator is zero.

    >>> residue_of(Sum((Sym("a"), Pow(Sym("a"), 2))), {"a": 3})
    12
    """
    match tree:
        case Num(value):
            return residue(value)
        case Sym(name):
            return values.get(name)
        case Sum(terms):
            parts = [residue_of(term, values) for term in terms]
            known = [part for part in parts if part is not None]
            return sum(known) % PRIME if len(known) == len(parts) else None
        case Prod(factors):
            total = 1
            for factor in factors:
                part = residue_of(factor, values)
                if part is None:
                    return None
                total = total * part % PRIME
            return total
        case Pow(base, exponent):
            inner = residue_of(base, values)
            return None if inner is None else pow(inner, exponent, PRIME)
        case Quot(numerator, denominator):
            above, below = residue_of(numerator, values), residue_of(denominator, values)
            return None if above is None or not below else above * inverse(below) % PRIME
        case _:
            return None
