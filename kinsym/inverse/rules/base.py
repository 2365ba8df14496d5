"""What every rule is made of: candidates, linear forms and names.

A rule looks at the equations of one state and proposes candidates; the search takes the cheapest. A candidate becomes
items of the plan only when it is chosen.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Call, Definition, Num, Pow, Quot, Sum, Sym, Tree, mul, negated, negative, opposite
from kinsym.inverse.knowledge import Knowledge
from kinsym.inverse.plan import Equation, Item
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

TAU, SIZE = Sym("tau"), Sym("size")


@dataclass
class Names:
    """Hands out names that the user's table does not use: kappa1, kappa2, ..., mu1, nu1, gamma1, ..."""

    taken: set[str]
    counts: dict[str, int] = field(default_factory=dict)
    steps: int = 0

    def fresh(self, stem: str) -> str:
        """The next free name of a family."""
        while True:
            self.counts[stem] = self.counts.get(stem, 0) + 1
            name = f"{stem}{self.counts[stem]}"
            if name not in self.taken:
                self.taken.add(name)
                return name

    def step(self) -> int:
        """The next step number."""
        self.steps += 1
        return self.steps

    def short(self, stem: str, tree: Tree, definitions: list[Definition]) -> Tree:
        """The tree itself if it is a name or a number, else a new name for it."""
        if isinstance(tree, (Num, Sym)) or isinstance(negated(tree), Sym):
            return tree
        name = self.fresh(stem)
        definitions.append(Definition(name=name, value=tree))
        return Sym(name)


@dataclass(frozen=True)
class Outcome:
    """The items a candidate adds to the plan and what is known after it."""

    items: tuple[Item, ...]
    known: Knowledge


@dataclass(frozen=True)
class Candidate:
    """One way to find one unknown. The order of candidates is that of ``cost``, then of joints, then of terms."""

    cost: int
    terms: int
    unknown: str
    build: Callable[[Names], Outcome]

    @property
    def order(self) -> tuple[int, int, str]:
        """Sort key: cheap first, then short, then by name."""
        return self.cost, self.terms, self.unknown


@dataclass(frozen=True)
class LinearForm:
    """``a cos(angle) + b sin(angle) = e`` with a, b, e known."""

    angle: Angle
    a: Poly
    b: Poly
    e: Poly
    equation: PoolEquation

    @property
    def terms(self) -> int:
        """The number of terms of the three coefficients."""
        return len(self.a) + len(self.b) + len(self.e)


def linear_forms(state: State, equations: Iterable[PoolEquation]) -> dict[str, list[LinearForm]]:
    """The equations with one unknown angle, linear in its cosine and sine, by angle.

    Those with constant coefficients come first, then the shorter.
    """
    ring = state.chain.ring
    forms: dict[str, list[LinearForm]] = {}
    seen: set[object] = set()
    for equation in equations:
        if len(equation.angles) != 1 or equation.lengths:
            continue
        angle = equation.angles[0]
        parts = ring.collect(equation.poly, (angle.cosine, angle.sine))
        if not set(parts) <= {(1, 0), (0, 1), (0, 0)}:
            continue
        a, b = parts.get((1, 0), ring.zero), parts.get((0, 1), ring.zero)
        key = equation.poly if equation.poly.LC > 0 else -equation.poly
        if key in seen or (state.vanishes(a) and state.vanishes(b)):
            continue
        seen.add(key)
        e: Poly = parts.get((0, 0), ring.zero)
        forms.setdefault(angle.label, []).append(LinearForm(angle, a, b, -e, equation))
    for family in forms.values():
        family.sort(key=lambda form: (not (ring.is_constant(form.a) and ring.is_constant(form.b)), form.terms))
    return forms


class View:
    """What the rules see of a state: its equations, sorted by what is unknown in them."""

    def __init__(self, state: State, equations: list[PoolEquation]) -> None:
        self.state = state
        self.equations = equations
        self.linear = linear_forms(state, equations)

    def of_lengths(self) -> list[PoolEquation]:
        """The equations whose only unknown is one prismatic variable."""
        return [e for e in self.equations if len(e.lengths) == 1 and not e.angles]

    def of_two_lengths(self) -> list[PoolEquation]:
        """The equations whose only unknowns are two prismatic variables."""
        return [e for e in self.equations if len(e.lengths) == 2 and not e.angles]

    def of_two_angles(self) -> list[PoolEquation]:
        """The position equations with two unknown angles of one group and nothing else unknown."""
        return [
            e
            for e in self.equations
            if len(e.angles) == 2 and not e.lengths and e.unit == 1 and e.angles[0].group == e.angles[1].group
        ]


def tolerance(unit: int) -> Tree:
    """tau in the unit of an equation: tau, tau*size, tau*size^2."""
    if unit == 0:
        return TAU
    return mul(TAU, SIZE if unit == 1 else Pow(SIZE, unit))


def shown(state: State, equation: PoolEquation) -> Equation:
    """A pool equation as the plan prints it, without a minus sign on both sides."""
    left, right = state.tree(equation.lhs), state.tree(equation.rhs)
    if _all_negative(left) and (_all_negative(right) or right == ZERO):
        left, right = negated(left), opposite(right)
    return Equation(lhs=left, rhs=right, source=equation.source)


def _all_negative(tree: Tree) -> bool:
    return all(map(negative, tree.terms)) if isinstance(tree, Sum) else negative(tree)


def divided(state: State, numerator: Poly, constant: Poly) -> Tree:
    """A polynomial over a constant in lowest terms, as it is written now."""
    above, below = numerator.cancel(constant)
    if below.is_ground:
        return state.tree(above.quo_ground(below.coeff(1)))
    return Quot(state.tree(above), state.tree(below))


def angle_value(angle: Angle) -> Definition:
    """``theta = Atan2(s, c)``."""
    return Definition(name=angle.name, value=Call("atan2", (Sym(angle.sine), Sym(angle.cosine))))


def edge(angle: Angle) -> tuple[int, int, int]:
    """The angle as an edge of the knowledge graph."""
    return angle.group, angle.low, angle.high
