"""Products and sums that occur more than once get a name, so that they are computed once.

Two factors or two terms at a time: the pair that occurs most often is named first, of equals the one that comes first.
Sums are the same up to a sign.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from itertools import combinations

from kinsym.algebra.tree import Definition, Num, Prod, Sum, Sym, Tree, add, children, mul, negated, negative, symbols
from kinsym.emit.schedule import StraightLine

Pair = tuple[Tree, Tree]


def shared(line: StraightLine) -> StraightLine:
    """A straight line with repeated products and sums named, each where what it is made of is known."""
    names = [item.name for item in line.definitions]
    trees = [*(item.value for item in line.definitions), *line.outputs]
    written = len(trees)
    given: list[str] = []
    for word, join, pairs, replace in (
        ("product", mul, _factors, _without_factors),
        ("sum", add, _terms, _without_terms),
    ):
        tally = _Tally(Counter(pairs(tree)) for tree in trees)
        number = 0
        while (best := tally.most()) is not None:
            number += 1
            given.append(f"{word}{number}")
            for index in tally.holding(best):
                trees[index] = replace(trees[index], best, Sym(given[-1]))
                tally.change(index, Counter(pairs(trees[index])))
            trees.append(join(*best))
            tally.append(Counter(pairs(trees[-1])))
    known = dict(zip(given, trees[written:], strict=True))
    return StraightLine(
        definitions=_placed(list(zip(names, trees, strict=False)), known), outputs=tuple(trees[len(names) : written])
    )


class _Tally:
    """How often each pair occurs in a list of expressions, kept up while they change."""

    def __init__(self, counts: Iterable[Counter[Pair]]) -> None:
        self._counts: list[Counter[Pair]] = []
        self._total: Counter[Pair] = Counter()
        for count in counts:
            self.append(count)

    def append(self, count: Counter[Pair]) -> None:
        """One more expression, with the pairs in it."""
        self._counts.append(count)
        self._total.update(count)

    def change(self, index: int, count: Counter[Pair]) -> None:
        """An expression has other pairs now."""
        for pair, times in self._counts[index].items():
            self._total[pair] -= times
        self._counts[index] = count
        self._total.update(count)

    def holding(self, pair: Pair) -> list[int]:
        """The expressions that have the pair."""
        return [index for index, count in enumerate(self._counts) if pair in count]

    def most(self) -> Pair | None:
        """The pair that occurs most often, of equals the first; None if none occurs twice."""
        often = max(self._total.values(), default=0)
        if often < 2:
            return None
        return next(pair for count in self._counts for pair in count if self._total[pair] == often)


def _factors(tree: Tree) -> Iterator[Pair]:
    """The pairs of factors in an expression, without numbers."""
    for part in _parts(tree):
        yield from _factors(part)
    if isinstance(tree, Prod):
        yield from combinations(sorted(set(_plain(tree)), key=repr), 2)


def _plain(tree: Prod) -> Iterable[Tree]:
    return (factor for factor in tree.factors if isinstance(factor, Sym))


def _without_factors(tree: Tree, pair: Pair, name: Sym) -> Tree:
    tree = _inside(tree, lambda part: _without_factors(part, pair, name))
    if not (isinstance(tree, Prod) and set(pair) <= set(tree.factors)):
        return tree
    left = list(tree.factors)
    for factor in pair:
        left.remove(factor)
    number = [factor for factor in left if isinstance(factor, Num)]
    return mul(*number, name, *(factor for factor in left if not isinstance(factor, Num)))


def _terms(tree: Tree) -> Iterator[Pair]:
    """The pairs of terms in an expression, the first of a pair without a minus."""
    for part in _parts(tree):
        yield from _terms(part)
    if isinstance(tree, Sum):
        for pair in combinations(tree.terms, 2):
            yield _signed(pair)


def _signed(pair: Pair) -> Pair:
    first, second = sorted(pair, key=_order)
    return (negated(first), negated(second)) if negative(first) else (first, second)


@lru_cache(maxsize=4096)
def _order(term: Tree) -> str:
    """What terms are sorted by: their text without a minus."""
    return repr(negated(term) if negative(term) else term)


def _without_terms(tree: Tree, pair: Pair, name: Sym) -> Tree:
    tree = _inside(tree, lambda part: _without_terms(part, pair, name))
    if isinstance(tree, Sum):
        for here, instead in ((pair, name), (tuple(map(negated, pair)), negated(name))):
            if set(here) <= set(tree.terms):
                left = list(tree.terms)
                for term in here:
                    left.remove(term)
                return add(instead, *left)
    return tree


def _parts(tree: Tree) -> tuple[Tree, ...]:
    """The parts of a sum or a product; nothing is shared inside functions."""
    return children(tree) if isinstance(tree, Sum | Prod) else ()


def _inside(tree: Tree, change: Callable[[Tree], Tree]) -> Tree:
    """The same expression with its parts changed."""
    parts = _parts(tree)
    changed = tuple(map(change, parts))
    if all(new is old for new, old in zip(changed, parts, strict=True)):
        return tree
    return add(*changed) if isinstance(tree, Sum) else mul(*changed)


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
