"""From a polynomial to the way it is written: nested by joint, as the lecture prints it.

The terms are collected in the cosine and sine of the first angle that occurs, inside them in those of the next:
r11 = c1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6) - s1*(...). That is also the form with the fewest operations.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction

from kinsym.algebra.ring import Kind, Poly, Ring, fraction
from kinsym.algebra.tree import (
    ZERO,
    Num,
    Pow,
    Prod,
    Sum,
    Sym,
    Tree,
    add,
    mul,
    negated,
    negative,
)


def nested(ring: Ring, poly: Poly, names: Mapping[str, Tree] | None = None) -> Tree:
    """A polynomial as a tree; ``names`` replaces generators by what they are called at this place."""
    return _Writer(ring, names or {}).write(poly)


class _Writer:
    def __init__(self, ring: Ring, names: Mapping[str, Tree]) -> None:
        self.ring = ring
        self.names = names

    def write(self, poly: Poly) -> Tree:
        if not poly:
            return ZERO
        pair = self._first_pair(poly)
        if pair is None:
            return self._flat(poly)
        groups = self.ring.collect(poly, pair)
        rest = groups.pop((0,) * len(pair), None)
        if rest is not None and len(groups) == 1 and rest == -next(iter(groups.values())):
            return self._versine(pair, next(iter(groups)), rest)
        terms = [_times(self._monomial(pair, key), self.write(groups[key])) for key in sorted(groups, reverse=True)]
        if rest is not None:
            terms.append(self.write(rest))
        return _positive_first(add(*terms))

    def _versine(self, pair: Sequence[str], key: tuple[int, ...], factor: Poly) -> Tree:
        """``factor (1 - c)``, as the lecture writes the translation of a screw displacement."""
        inner = self.write(factor)
        bracket = Sum((number(1), negated(self._monomial(pair, key))))
        return negated(mul(negated(inner), bracket)) if negative(inner) else mul(inner, bracket)

    def _first_pair(self, poly: Poly) -> tuple[str, ...] | None:
        for name in self.ring.used(poly):
            generator = self.ring.generators[self.ring.index[name]]
            if generator.kind is Kind.COSINE:
                return name, "s" + name[1:]
            if generator.kind is Kind.SINE:
                return "c" + name[1:], name
        return None

    def _monomial(self, names: Sequence[str], exponents: tuple[int, ...]) -> Tree:
        return mul(*(_power(self._name(n), e) for n, e in zip(names, exponents, strict=True) if e))

    def _name(self, name: str) -> Tree:
        return self.names.get(name, Sym(name))

    def _flat(self, poly: Poly) -> Tree:
        """The terms without joint angles, collected in the entries of the pose."""
        entries = [name for name in self.ring.used(poly) if self._kind(name) is Kind.POSE]
        groups = self.ring.collect(poly, entries)
        terms = []
        for key in sorted(groups, reverse=True):
            inner = self._lengths(groups[key])
            if not any(key):
                terms.append(inner)
            elif isinstance(inner, Sum):
                sign = -1 if all(negative(term) for term in inner.terms) else 1
                terms.append(mul(number(sign), inner if sign > 0 else negated(inner), self._monomial(entries, key)))
            else:
                terms.append(mul(inner, self._monomial(entries, key)))
        return _positive_first(add(*terms))

    def _lengths(self, poly: Poly) -> Tree:
        """The terms in lengths alone, constants and parameters first in each product."""
        terms: list[Tree] = []
        for monomial, coefficient in sorted(poly.terms(), key=lambda term: term[0], reverse=True):
            used = [(g, exponent) for g, exponent in zip(self.ring.generators, monomial, strict=True) if exponent]
            used.sort(key=lambda pair: pair[0].kind is Kind.LENGTH)
            factors = (_power(self._name(generator.name), exponent) for generator, exponent in used)
            terms.append(mul(Num(fraction(coefficient)), *factors))
        return _positive_first(add(*terms))

    def _kind(self, name: str) -> Kind:
        return self.ring.generators[self.ring.index[name]].kind


def _power(base: Tree, exponent: int) -> Tree:
    return base if exponent == 1 else Pow(base, exponent)


def _times(outer: Tree, inner: Tree) -> Tree:
    """``outer*(sum)`` but ``atom*outer``: the lecture writes a2 c2 and c1(...)."""
    if isinstance(inner, Sum):
        if negative(inner.terms[0]):
            return negated(mul(outer, negated(inner)))
        return mul(outer, inner)
    factors = inner.factors if isinstance(inner, Prod) else (inner,)
    lengths = [f for f in factors if not _is_circular(f)]
    circular = [f for f in factors if _is_circular(f)]
    return mul(*lengths, outer, *circular)


def _is_circular(tree: Tree) -> bool:
    """Whether a factor stands behind the cosine it multiplies: cosines and sines, entries of a pose, brackets."""
    if isinstance(tree, Sum):
        return True
    base = tree.base if isinstance(tree, Pow) else tree
    return isinstance(base, Sym) and re.fullmatch(r"[cs][0-9].*|[uvwp][0-9]*_[xyz]", base.name) is not None


def _positive_first(tree: Tree) -> Tree:
    """A sum that starts with a term without a minus sign, if it has one."""
    if not isinstance(tree, Sum) or not negative(tree.terms[0]):
        return tree
    for position, term in enumerate(tree.terms):
        if not negative(term):
            return Sum((term, *tree.terms[:position], *tree.terms[position + 1 :]))
    return tree


def number(value: Fraction | int) -> Tree:
    """A number as a tree."""
    return Num(Fraction(value))
