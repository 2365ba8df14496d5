"""Polynomials over the joints and over quantities that a derivation has named (f1, g1, k1): one ring for both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from kinsym.algebra.ring import Generator, Kind, Poly, Ring
from kinsym.algebra.tree import Num, Pow, Prod, Sum, Sym, Tree, negated
from kinsym.methods.draft import Draft


class Words(Ring):
    """The ring of a chain with named quantities behind its generators."""

    def __init__(self, ring: Ring, names: Sequence[str]) -> None:
        super().__init__([*ring.generators, *(Generator(name, Kind.POSE) for name in names)])
        self._plain, self._extra = ring, len(names)

    def lift(self, poly: Poly) -> Poly:
        """A polynomial of the chain's ring in this one."""
        result = self.ring.zero
        for monomial, coefficient in poly.terms():
            result[(*monomial, *(0,) * self._extra)] = coefficient
        return result

    def expand(self, poly: Poly, meaning: Mapping[str, Poly]) -> Poly:
        """A polynomial of this ring in the chain's, each named quantity replaced by what it means there."""
        plain = self._plain
        count = len(plain.generators)
        total = plain.zero
        for monomial, coefficient in poly.terms():
            term = plain.ring.term_new(monomial[:count], coefficient)
            for generator, exponent in zip(self.generators[count:], monomial[count:], strict=True):
                for _ in range(exponent):
                    term = plain.mul(term, meaning[generator.name])
            total += term
        return plain.reduce(total)

    def of_tree(self, tree: Tree) -> Poly:
        """A formula without quotients and functions as a polynomial; its names are generators of this ring."""
        match tree:
            case Num(value):
                return self.number(value)
            case Sym(name):
                return self[name]
            case Sum(terms):
                total = self.zero
                for term in terms:
                    total += self.of_tree(term)
                return total
            case Prod(factors):
                product = self.one
                for factor in factors:
                    product = self.mul(product, self.of_tree(factor))
                return product
            case Pow(base, exponent):
                return self.reduce(self.of_tree(base) ** exponent)
            case _:
                raise TypeError(f"{tree} is no polynomial")


def short(draft: Draft, stem: str, poly: Poly) -> Tree:
    """A polynomial as it is if it is a name or a number, else under a new name."""
    tree = draft.tree(poly)
    if isinstance(tree, (Num, Sym)) or isinstance(negated(tree), Sym):
        return tree
    return draft.define(draft.fresh(stem), tree)
