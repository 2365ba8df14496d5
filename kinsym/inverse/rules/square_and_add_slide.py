"""Square and add where the other unknown is a length (Pieper 1968, arms with a prismatic joint among the first three).

    X = k1 c + k2 s          k1, k2, X, Y of degree two at most in a length d
    Y = k1 s - k2 c

give X^2 + Y^2 = k1^2 + k2^2. Of degree two it is solved as every quadratic equation. Of degree four it goes to the
kernel of the half-angle polynomial: d = size tan(phi/2) makes every line p + q d + r d^2 one in the cosine and sine of
phi, so that near roots are told apart, or merged, by the same tolerances as those of an angle.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import permutations

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import (
    ONE,
    ZERO,
    Call,
    Definition,
    Num,
    PlusMinus,
    Pow,
    Quot,
    Sym,
    Tree,
    add,
    mul,
    opposite,
    sub,
)
from kinsym.inverse.plan import Equation, Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import (
    SIZE,
    Candidate,
    Names,
    Outcome,
    View,
    angle_value,
    divided,
    edge,
    shown,
    tolerance,
)
from kinsym.inverse.rules.squares import (
    Terms,
    difference,
    error_of,
    magnitude,
    quartic_inputs,
    square,
    total,
    turn_step,
)
from kinsym.inverse.rules.tangent import by_tangent, length_of, new_tangent
from kinsym.inverse.rules.turned_pair import Line, Pair, promising, shared_points, turned_form, turned_pair
from kinsym.inverse.state import State

HALF = Num(Fraction(1, 2))
TITLES: dict[str, str] = {}
QUADRATIC_COST, TANGENT_COST, QUARTIC_COST = 58, 59, 62
SIGNS = (1, 1, -1, -1)


@dataclass(frozen=True)
class _Statement:
    """What a step states: X, Y, k1 and k2 as polynomials in the length, and where they come from."""

    variable: str
    pair: Pair
    vectors: list[Terms]
    definitions: list[Definition]
    equations: tuple[Equation, ...]
    error: Tree


def candidates(view: View) -> Iterator[Candidate]:
    """Pairs of equations in one angle and one length; the angle is the one that is turned."""
    state = view.state
    families: dict[tuple[str, str], list[PoolEquation]] = {}
    for equation in view.equations:
        if len(equation.angles) == 1 and len(equation.lengths) == 1:
            families.setdefault((equation.angles[0].label, equation.lengths[0]), []).append(equation)
    points = shared_points(state)
    for (_, variable), family in families.items():
        turned = family[0].angles[0]
        forms = [form for equation in family if (form := turned_form(state, equation, turned, points))]
        for first, second in permutations(forms, 2):
            state.deadline.check()
            if not promising(first, second):
                continue
            pair = turned_pair(state, turned, variable, first, second)
            if pair is None:
                continue
            degree, leading = _leading(state, pair)
            cost = _cost(degree, constant=state.chain.ring.is_constant(leading))
            if cost:
                yield Candidate(cost, pair.terms, variable, partial(_build, state, variable, pair, cost))


def _leading(state: State, pair: Pair) -> tuple[int, Poly]:
    """Degree and leading coefficient of X^2 + Y^2 - k1^2 - k2^2, the scales of X and Y multiplied out."""
    ring = state.chain.ring
    (x, y), both = pair.sides, ring.mul(pair.sides[0].scale, pair.sides[1].scale)
    lines = [(x.rest, y.scale), (y.rest, x.scale), (pair.k1, both), (pair.k2, both)]
    scaled = [[ring.mul(part, scale) for part in line] for line, scale in lines]
    for degree in (4, 3, 2):
        leading = ring.zero
        for sign, parts in zip(SIGNS, scaled, strict=True):
            for i, part in enumerate(parts):
                if 0 <= degree - i <= 2:
                    leading += ring.mul(part, parts[degree - i]) * sign
        leading = ring.reduce(leading)
        if leading and any(state.values(leading)):
            return degree, leading
    return 0, ring.zero


def _cost(degree: int, *, constant: bool) -> int:
    """The cost by the degree of the polynomial; 0 for a degree of three, whose root at infinity is none."""
    if degree == 2:
        return QUADRATIC_COST if constant else TANGENT_COST
    return QUARTIC_COST if degree == 4 else 0


def _build(state: State, variable: str, pair: Pair, cost: int, names: Names) -> Outcome:
    definitions: list[Definition] = []
    named: dict[Tree, Tree] = {}

    def coefficient(stem: str, tree: Tree) -> Tree:
        if tree not in named:
            named[tree] = names.short(stem, tree, definitions)
        return named[tree]

    def line(parts: Line, scale: Poly) -> Terms:
        stems = zip(("gamma", "mu", "nu"), parts, strict=True)
        p, q, r = (coefficient(stem, divided(state, part, scale)) for stem, part in stems)
        return p, q, r

    one = state.chain.ring.one
    vectors = [
        *(line(side.rest, side.scale) for side in pair.sides),
        *(line(part, one) for part in (pair.k1, pair.k2)),
    ]
    equations = tuple(shown(state, equation) for equation in pair.equations)
    error = error_of(state, pair)
    stated = _Statement(variable, pair, vectors, definitions, equations, error)
    solve = {QUADRATIC_COST: _quadratic, TANGENT_COST: _tangent, QUARTIC_COST: _quartic}[cost]
    steps = solve(names, stated)
    d = Sym(variable)
    lines = [total([p, mul(q, d), mul(r, Pow(d, 2))]) for p, q, r in vectors]
    values: list[Definition] = []
    sides = [names.short("kappa", line, values) for line in lines]
    turned = pair.turned
    follow = turn_step(names, turned, sides, error=error, equations=equations)
    known = state.known.with_length(variable).with_angle(edge(turned))
    return Outcome((*steps, *values, follow, angle_value(turned)), known)


def _coefficients(stated: _Statement) -> tuple[Tree, Tree, Tree]:
    """a2, a1, a0 of a2 d^2 + 2 a1 d + a0 = 0."""
    a2: list[Tree] = []
    a1: list[Tree] = []
    a0: list[Tree] = []
    for sign, (p, q, r) in zip(SIGNS, stated.vectors, strict=True):
        squared = total([square(q), mul(number(2), p, r)])
        for part, product in ((a2, squared), (a1, mul(p, q)), (a0, square(p))):
            part.append(product if sign > 0 else opposite(product))
    return total(a2), total(a1), total(a0)


def _why(stated: _Statement) -> str:
    return f"the squares of the two equations add up to one without {stated.pair.turned.name}"


def _tangent(names: Names, stated: _Statement) -> tuple[Step, ...]:
    """a2 d^2 + 2 a1 d + a0 = 0 where a2 can vanish."""
    parts = _coefficients(stated)
    first, second = by_tangent(names, stated.variable, parts, stated.equations, _why(stated))
    return replace(first, coefficients=(*stated.definitions, *first.coefficients)), second


def _quadratic(names: Names, stated: _Statement) -> tuple[Step, ...]:
    """The same with a constant a2."""
    variable, definitions = stated.variable, stated.definitions
    a2, a1, a0 = _coefficients(stated)
    leading = names.short("lambda", a2, definitions)
    b = names.short("kappa", a1 if leading == ONE else _over(a1, leading), definitions)
    c = names.short("kappa", a0 if leading == ONE else _over(a0, leading), definitions)
    root = Call("sqrt", (sub(square(b), c),))
    step = Step(
        number=names.step(),
        unknown=variable,
        rule="quadratic",
        equations=stated.equations,
        coefficients=tuple(definitions),
        inputs={"b": b, "c": c, "t": _over(tolerance(2), magnitude(leading))},
        outputs=(variable,),
        branches=2,
        reference=((variable, 1),),
        solution=((variable, PlusMinus(None if b == ZERO else opposite(b), root)),),
        condition=(square(b), ">=", c),
        degenerate=None,
        why=f"{_why(stated)}, quadratic in this length",
    )
    return (step,)


def _over(above: Tree, below: Tree) -> Tree:
    return above if below == ONE or above == ZERO else Quot(above, below)


def _quartic(names: Names, stated: _Statement) -> tuple[Step, ...]:
    """The polynomial in phi, then the length."""
    variable, vectors, definitions, error = stated.variable, stated.vectors, stated.definitions, stated.error
    phi, cosine, sine = new_tangent(names)

    def turned(terms: Terms) -> Terms:
        p, q, r = terms
        if r == ZERO:
            p2 = mul(HALF, p)
            return p2, mul(HALF, q, SIZE), p2
        r2 = mul(r, Pow(SIZE, 2))
        parts = mul(HALF, sub(p, r2)), mul(HALF, q, SIZE), mul(HALF, add(p, r2))
        first, second, third = (
            names.short(stem, t, definitions) for stem, t in zip(("mu", "nu", "gamma"), parts, strict=True)
        )
        return first, second, third

    forms = [turned(terms) for terms in vectors]
    d = Sym(variable)
    statement = difference([total([p, mul(q, d), mul(r, Pow(d, 2))]) for p, q, r in vectors])
    first = Step(
        number=names.step(),
        unknown=phi,
        rule="quartic",
        equations=stated.equations,
        coefficients=tuple(definitions),
        inputs={**quartic_inputs(forms, error, ""), **quartic_inputs(forms, error, "2")},
        outputs=(cosine.name, sine.name),
        branches=4,
        reference=(),
        solution=(("0", statement),),
        condition=None,
        degenerate=None,
        why=f"the squares of the two equations add up to a polynomial of degree four in {variable} = size tan({phi}/2)",
    )
    return first, length_of(names, variable, (phi, cosine, sine), stated.equations)
