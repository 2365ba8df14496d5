"""Products and sums that occur more than once get a name, so that they are computed once.

Two factors or two terms at a time: the pair that occurs most often is named first, of equals the one that was seen
first. Sums are the same up to a sign. A sum of n terms has n (n - 1) / 2 pairs, but naming one of them changes only
those that its two terms are in; so the pairs are counted once and then kept up.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations, product

from kinsym.algebra.tree import Definition, Num, Prod, Sum, Sym, Tree, add, children, mul, negated, negative, symbols
from kinsym.emit.schedule import StraightLine

Pair = tuple[Tree, Tree, int]
"""Two parts, the one that was seen first in front, and the product of their signs."""


def shared(line: StraightLine) -> StraightLine:
    """A straight line with repeated products and sums named, each where what it is made of is known."""
    names = [item.name for item in line.definitions]
    trees = [*(item.value for item in line.definitions), *line.outputs]
    written = len(trees)
    given: list[str] = []
    for kind, word in ((Prod, "product"), (Sum, "sum")):
        if kind is Sum:
            seen: dict[frozenset[Tree], Tree] = {}
            trees = [_aligned(tree, seen) for tree in trees]
        sharing = _Sharing(kind, trees)
        for pair in iter(sharing.most, None):
            given.append(f"{word}{len(sharing.named) + 1}")
            sharing.name(pair, Sym(given[-1]))
        trees = sharing.trees()
    known = dict(zip(given, trees[written:], strict=True))
    return StraightLine(
        definitions=_placed(list(zip(names, trees, strict=False)), known), outputs=tuple(trees[len(names) : written])
    )


@dataclass
class _Row:
    """A sum or a product: the parts that can be shared, with their signs, and the others."""

    parts: dict[Tree, int] = field(default_factory=dict)
    others: list[Tree] = field(default_factory=list)
    touched: bool = False


class _Sharing:
    """The sums, or the products, in a list of expressions, and which of them each pair of parts is in."""

    def __init__(self, kind: type[Sum] | type[Prod], trees: list[Tree]) -> None:
        self._kind, self._trees = kind, trees
        self._seen: dict[Tree, int] = {}
        self._rows: list[_Row] = []
        self._of: dict[Tree, _Row] = {}
        self._holding: dict[Pair, dict[int, None]] = {}
        self._serial: dict[Pair, int] = {}
        self._queue: list[tuple[int, int, Pair]] = []
        self.named: list[_Row] = []
        for tree in trees:
            for node in _nodes(tree, kind):
                row = _sum_row(node) if isinstance(node, Sum) else _product_row(node)
                self._of.setdefault(node, row)
                self._append(row)

    def most(self) -> Pair | None:
        """The pair that is in most rows, of equals the first; None if none is in two."""
        while self._queue:
            rows, serial, pair = heapq.heappop(self._queue)
            now = len(self._holding[pair])
            if now == -rows:
                return pair
            if now > 1:
                heapq.heappush(self._queue, (-now, serial, pair))
        return None

    def name(self, pair: Pair, name: Sym) -> None:
        """Put the name in the place of the pair, wherever it is."""
        first, second, relative = pair
        self._seen[name] = len(self._seen)
        for index in list(self._holding[pair]):
            row = self._rows[index]
            left = {part: sign for part, sign in row.parts.items() if part not in (first, second)}
            for gone, other in ((first, second), *product((first, second), left)):
                del self._holding[self._pair(gone, other, row)][index]
            row.parts, row.touched = {name: row.parts[first], **left}, True
            self._enter(index, ((name, other) for other in left))
        self.named.append(_Row({first: 1, second: relative}, touched=True))
        self._append(self.named[-1])

    def trees(self) -> list[Tree]:
        """The expressions as they are now, and behind them what the names stand for."""
        return [*map(self._rebuilt, self._trees), *map(self._joined, self.named)]

    def _append(self, row: _Row) -> None:
        for part in row.parts:
            self._seen.setdefault(part, len(self._seen))
        self._rows.append(row)
        self._enter(len(self._rows) - 1, combinations(row.parts, 2))

    def _enter(self, index: int, twos: Iterable[tuple[Tree, Tree]]) -> None:
        for two in twos:
            pair = self._pair(*two, self._rows[index])
            holding = self._holding.setdefault(pair, {})
            serial = self._serial.setdefault(pair, len(self._serial))
            holding[index] = None
            if len(holding) > 1:
                heapq.heappush(self._queue, (-len(holding), serial, pair))

    def _pair(self, one: Tree, other: Tree, row: _Row) -> Pair:
        first, second = (one, other) if self._seen[one] < self._seen[other] else (other, one)
        return first, second, row.parts[first] * row.parts[second]

    def _rebuilt(self, tree: Tree) -> Tree:
        row = self._of.get(tree)
        if row is not None and row.touched:
            return self._joined(row)
        match tree:
            case Sum(terms):
                return add(*map(self._rebuilt, terms))
            case Prod(factors):
                return mul(*map(self._rebuilt, factors))
            case _:
                return tree

    def _joined(self, row: _Row) -> Tree:
        parts = [self._rebuilt(part) if sign > 0 else negated(self._rebuilt(part)) for part, sign in row.parts.items()]
        others = [self._rebuilt(other) for other in row.others]
        return add(*parts, *others) if self._kind is Sum else mul(*parts, *others)


def _aligned(tree: Tree, seen: dict[frozenset[Tree], Tree]) -> Tree:
    """The expression with sums that are factors written as before: x (b - a) is -x (a - b) where a - b was seen."""
    match tree:
        case Sum(terms):
            return add(*(_aligned(term, seen) for term in terms))
        case Prod(factors):
            return mul(*(_as_before(_aligned(factor, seen), seen) for factor in factors))
        case _:
            return tree


def _as_before(factor: Tree, seen: dict[frozenset[Tree], Tree]) -> Tree:
    if not isinstance(factor, Sum):
        return factor
    other = seen.get(frozenset(map(negated, factor.terms)))
    return seen.setdefault(frozenset(factor.terms), factor) if other is None else Prod((Num(Fraction(-1)), other))


def _nodes(tree: Tree, kind: type[Sum] | type[Prod]) -> Iterator[Sum | Prod]:
    """The sums, or the products, in an expression; nothing is shared inside functions."""
    if isinstance(tree, Sum | Prod):
        for part in children(tree):
            yield from _nodes(part, kind)
        if isinstance(tree, kind):
            yield tree


def _sum_row(tree: Sum) -> _Row:
    row = _Row()
    for term in tree.terms:
        sign = -1 if negative(term) else 1
        part = term if sign > 0 else negated(term)
        if part in row.parts:
            row.others.append(term)
        else:
            row.parts[part] = sign
    return row


def _product_row(tree: Prod) -> _Row:
    """Numbers are no factors to share: a product is the same quantity times another number.

    The order is that of names, so that products of cosines and sines come before those with a length: they are needed
    again where there is no length.
    """
    names = sorted({factor.name for factor in tree.factors if isinstance(factor, Sym)})
    row = _Row(parts={Sym(name): 1 for name in names})
    left = set(row.parts)
    for factor in tree.factors:
        if factor in left:
            left.discard(factor)
        else:
            row.others.append(factor)
    return row


def _placed(definitions: list[tuple[str, Tree]], known: dict[str, Tree]) -> tuple[Definition, ...]:
    """All definitions in an order in which each follows what it reads; a shared one stands as late as it can."""
    placed: list[Definition] = []
    done: set[str] = set()

    def need(tree: Tree) -> None:
        for name in symbols(tree):
            if name in known and name not in done:
                need(known[name])
                done.add(name)
                placed.append(Definition(name=name, value=known[name]))

    for name, tree in definitions:
        need(tree)
        placed.append(Definition(name=name, value=tree))
    for name, tree in known.items():
        if name not in done:
            need(tree)
            done.add(name)
            placed.append(Definition(name=name, value=tree))
    return tuple(placed)
