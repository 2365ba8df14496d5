"""The lecture's way from equations to angles: what holds one unknown first, then two links, then squares.

Unlike :mod:`kinsym.inverse`, which chooses equations for the code they make, this solver takes a few equations that a
method states, in their order, and prints the lecture's formulas: arc sine, arc cosine, Cramer's rule, Atan2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import combinations

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Kind, Poly
from kinsym.algebra.tree import ZERO, Call, PlusMinus, Sym, Tree, add, opposite, sub
from kinsym.inverse.knowledge import Edge, Knowledge
from kinsym.kinematics.angles import Angle
from kinsym.methods.circle import cosine_and_sine, solve_by
from kinsym.methods.draft import Draft
from kinsym.methods.find_links import as_links, coefficient
from kinsym.methods.steps import AngleOf, Row, one_row, quotient
from kinsym.methods.two_links import TwoLinks, solve_two_links

DIRECT, LENGTH, CRAMER, HOMOGENEOUS, ROOT, ONE_ROW, TWO_LINKS = range(7)
"""The kinds of steps, the first that applies is taken."""


@dataclass(frozen=True)
class Statement:
    """``lhs = rhs``, printed as the equation ``name`` together with its ``family``; ``shown`` is how lhs is written."""

    name: str
    family: str
    lhs: Poly
    rhs: Poly
    shown: Tree | None = None


@dataclass
class Solver:
    """What is known while one method solves its equations; ``introduce`` prints a family when it is first used."""

    draft: Draft
    introduce: Callable[[str], None]
    known: Knowledge
    links: Callable[[Draft, TwoLinks, tuple[Tree, Tree]], None] = solve_two_links
    statements: list[Statement] = field(default_factory=list)
    _printed: set[str] = field(default_factory=set)

    def solve(self, statements: Iterable[Statement]) -> None:
        """Find what these equations and those given before hold."""
        self.statements += statements
        while step := self._next():
            step()
            self._sums()

    @property
    def unknown(self) -> tuple[str, ...]:
        """The joint variables that are left."""
        return self.known.unknowns()

    def _next(self) -> Callable[[], None] | None:
        found: list[tuple[int, int, int, Callable[[], None]]] = []
        rows: dict[str, list[tuple[Row, Statement]]] = {}
        pairs: list[tuple[Statement, Poly, Poly]] = []
        for statement in self.statements:
            lhs, rhs = self._reduced(statement.lhs), self._reduced(statement.rhs)
            angles, lengths = self._unknowns(lhs, rhs)
            if len(lengths) == 1 and not angles:
                step = self._length(statement, lhs, rhs, lengths[0])
                if step is not None:
                    found.append((step[0], self._new(statement), len(found), step[1]))
            elif len(angles) == 1 and not lengths:
                row = self._row(statement, lhs, rhs, angles[0])
                if row is not None:
                    rows.setdefault(angles[0].label, []).append((row, statement))
            elif len(angles) == 2 and not lengths and angles[0].group == angles[1].group:
                pairs.append((statement, lhs, rhs))
        for label, several in rows.items():
            found += [(cost, new, len(found), step) for cost, new, step in self._angle(label, several)]
        if not found:
            found += [(TWO_LINKS, cost, i, step) for i, (cost, step) in enumerate(self._two_links(pairs))]
        return min(found, key=lambda item: item[:3])[3] if found else None

    def _new(self, *statements: Statement) -> int:
        """How many families would have to be printed before these equations are used."""
        return len({statement.family for statement in statements} - self._printed)

    def print_family(self, family: str) -> None:
        """Print a family now."""
        self._printed.add(family)
        self.introduce(family)

    def _use(self, *statements: Statement, gives: str) -> None:
        """Print the families of equations, and say what is found from which of them."""
        for statement in statements:
            if statement.family not in self._printed:
                self.print_family(statement.family)
        listed = [f"{{{name}}}" for name in dict.fromkeys(statement.name for statement in statements)]
        sources = " and ".join(filter(None, (", ".join(listed[:-1]), listed[-1])))
        self.draft.say(f"{gives} {sources}:")

    def _reduced(self, poly: Poly) -> Poly:
        """A polynomial with every unknown angle of a group by the one that stands for it."""
        chain, ring = self.draft.chain, self.draft.ring
        used = set(ring.used(poly))
        for (group, low, high), angle in chain.angles.items():
            if self.known.knows(angle) or not used & {angle.cosine, angle.sine}:
                continue
            c, s = self.known.turn(group, low, high)
            if c == ring[angle.cosine]:
                continue
            total = ring.zero
            for (i, j), part in ring.collect(poly, (angle.cosine, angle.sine)).items():
                total += part * c**i * (s * angle.sign) ** j
            poly = ring.reduce(total)
        return poly

    def _unknowns(self, *polys: Poly) -> tuple[list[Angle], list[str]]:
        chain, ring = self.draft.chain, self.draft.ring
        used = {name for poly in polys for name in ring.used(poly)}
        angles = [a for a in chain.angles.values() if used & {a.cosine, a.sine} and not self.known.knows(a)]
        lengths = [
            g.name for g in ring.generators if g.kind is Kind.LENGTH and g.name in used - set(self.known.lengths)
        ]
        return angles, lengths

    def _row(self, statement: Statement, lhs: Poly, rhs: Poly, angle: Angle) -> Row | None:
        """The equation as ``a c + b s = e``, the known side as it is printed."""
        ring, names = self.draft.ring, (angle.cosine, angle.sine)
        at = coefficient(ring)
        left, right = ring.collect(lhs, names), ring.collect(rhs, names)
        if not set(left) | set(right) <= {(1, 0), (0, 1), (0, 0)}:
            return None
        a: Poly = at(right, (1, 0)) - at(left, (1, 0))
        b: Poly = at(right, (0, 1)) - at(left, (0, 1))
        if self._vanishes(a) and self._vanishes(b):
            return None
        if not any(any(key) for key in left):
            shown = statement.shown if statement.shown is not None else self.draft.tree(lhs)
            return Row(a, b, sub(shown, self.draft.tree(at(right, (0, 0)))))
        if not any(any(key) for key in right):
            return Row(-a, -b, sub(self.draft.tree(rhs), self.draft.tree(at(left, (0, 0)))))
        return Row(a, b, self.draft.tree(at(left, (0, 0)) - at(right, (0, 0))))

    def _vanishes(self, poly: Poly) -> bool:
        ring = self.draft.ring
        return not poly or not any(ring.evaluate(poly, witness.numbers) for witness in self.draft.witnesses)

    def _angle(self, label: str, rows: list[tuple[Row, Statement]]) -> Iterable[tuple[int, int, Callable[[], None]]]:
        ring = self.draft.ring
        angle = next(a for a in self.draft.chain.angles.values() if a.label == label)
        named = AngleOf(angle.name, angle.cosine, angle.sine)

        def finish(statements: Iterable[Statement], solve: Callable[[], None]) -> Callable[[], None]:
            def step() -> None:
                self._use(*statements, gives=f"`{named.name}` from")
                solve()
                self.known = self.known.with_angle(_edge(angle))

            return step

        printed = [pair for pair in rows if not self._new(pair[1])]
        for several in (printed, rows):
            parts = cosine_and_sine(ring, [row for row, _ in several], self._vanishes)
            if parts is None:
                continue
            c, s = parts
            cost = DIRECT if c.constant and s.constant else CRAMER
            sources = [several[i][1] for i in sorted({*c.sources, *s.sources})]
            yield cost, self._new(*sources), finish(sources, partial(solve_by, self.draft, named, c, s))
        for row, statement in rows:
            cost = HOMOGENEOUS if row.e == ZERO else ONE_ROW
            step = finish([statement], partial(one_row, self.draft, ring, named, row))
            yield cost, self._new(statement), step

    def _length(
        self, statement: Statement, lhs: Poly, rhs: Poly, variable: str
    ) -> tuple[int, Callable[[], None]] | None:
        ring, draft = self.draft.ring, self.draft
        at = coefficient(ring)
        parts = ring.collect(rhs - lhs, (variable,))
        if not set(parts) <= {(0,), (1,), (2,)}:
            return None
        rest = at(parts, (0,))
        second, first = at(parts, (2,)), at(parts, (1,))
        pure = variable not in ring.used(lhs)
        shown = statement.shown if statement.shown is not None else draft.tree(lhs)
        known = sub(shown, draft.tree(rest + lhs)) if pure else draft.tree(-rest)

        def linear() -> None:
            self._use(statement, gives=f"`{variable}` from")
            draft.solve(variable, quotient(known, draft.tree(first)), branches=1)
            self.known = self.known.with_length(variable)

        def root() -> None:
            self._use(statement, gives=f"`{variable}` from")
            half = ring.mul(first, ring.number(Fraction(1, 2)))
            inner = add(draft.tree(ring.mul(half, half)), known) if half else known
            real = draft.require(f"{variable}.real", inner, ">=", ZERO)
            left = opposite(draft.tree(half)) if half else None
            draft.solve(variable, PlusMinus(left, Call("sqrt", (inner,))), branches=2, conditions=(real,))
            self.known = self.known.with_length(variable)

        if not second and not self._vanishes(first):
            return (LENGTH if ring.is_constant(first) else CRAMER), linear
        return (ROOT, root) if second == ring.one else None

    def _two_links(self, pairs: list[tuple[Statement, Poly, Poly]]) -> Iterable[tuple[int, Callable[[], None]]]:
        """Pairs of equations that are two links, those of one family and one sense of rotation first."""
        for (first, *sides), (second, *others) in combinations(pairs, 2):
            for flip in (1, -1):
                turned = [flip * side for side in others]
                found = as_links(self.draft.chain, self._unknowns(*sides, *turned)[0], sides, turned)
                if found is not None:
                    links, rests = found
                    cost = 2 * self._new(first, second) + (first.family != second.family) * 4 + (flip < 0)
                    yield cost, partial(self._solve_links, (first, second), rests, links, flip)
                    break

    def _solve_links(
        self, statements: tuple[Statement, Statement], rests: tuple[Poly, Poly], links: TwoLinks, flip: int
    ) -> None:
        """Name what is known of both equations, state them, solve."""
        draft = self.draft
        self._use(*statements, gives="Two links in a plane,")
        known = []
        for index, (statement, rest) in enumerate(zip(statements, rests, strict=True), start=1):
            side = self._known_side(statement, rest, flip if index == 2 else 1)
            known.append(side if isinstance(side, Sym) else draft.define(draft.fresh(f"k{index}"), side))
        self.links(draft, links, (known[0], known[1]))
        chain = draft.chain
        for name in (links.between.name, links.x.name):
            angle = next(a for a in chain.angles.values() if a.name == name and a.cosine[1:] == a.label)
            self.known = self.known.with_angle(_edge(angle))

    def _known_side(self, statement: Statement, rest: Poly, flip: int) -> Tree:
        """What an equation says of its two links: its left side as it is printed, less what is known on the right."""
        lhs = self._reduced(statement.lhs)
        if self._unknowns(lhs) != ([], []):
            return self.draft.tree(rest)
        shown = statement.shown if statement.shown is not None else nested(self.draft.ring, lhs)
        side = sub(shown, self.draft.tree(lhs - flip * rest))
        return side if flip > 0 else opposite(side)

    def _sums(self) -> None:
        """Joint angles that follow from sums that are known."""
        chain, draft = self.draft.chain, self.draft
        for angle in chain.angles.values():
            if len(angle.terms) > 1 or not self.known.knows(angle) or _edge(angle) in self.known.edges:
                continue
            plus: list[Tree] = []
            minus: list[Tree] = []
            for start, end in self.known.path(angle.group, angle.low, angle.high):
                part = chain.angles[angle.group, min(start, end), max(start, end)]
                sign = part.sign * (1 if start < end else -1) * angle.sign
                (plus if sign > 0 else minus).append(Sym(part.name))
            draft.solve(angle.name, add(*plus, *(opposite(part) for part in reversed(minus))), branches=1)
            self.known = self.known.with_angle(_edge(angle))


def _edge(angle: Angle) -> Edge:
    return angle.group, angle.low, angle.high
