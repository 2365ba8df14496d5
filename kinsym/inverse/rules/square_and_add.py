"""Two equations whose squares add up to one in a single angle (Pieper 1968; the lecture's r and z).

    X = k1 c + k2 s          k1, k2, X, Y linear in (c_y, s_y) of another angle y
    Y = k1 s - k2 c          c, s of the angle x

give X^2 + Y^2 = k1^2 + k2^2, of degree two in (c_y, s_y), and then (c, s) without a choice. In Pieper's solution x is
theta2, y is theta3, X = (r - k3)/(2 a1) with r the squared distance of the wrist and Y = (z - k4)/s alpha1.

Where the wrist lies on axis 2 both vectors vanish, and the equation in y is known from their lengths alone. Where it
lies on axis 1 the same holds for the elimination of theta1, which gives the same equation in y: the kernel gets both.

The squares are formed of the names of coefficients, not of the coefficients: the sums stay short, and nothing of
the large ring is multiplied out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import combinations, permutations

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.nested import number
from kinsym.algebra.ring import Kind, Poly, Ring
from kinsym.algebra.tree import (
    ONE,
    ZERO,
    Call,
    Definition,
    Num,
    Pow,
    Quot,
    Sum,
    Sym,
    Tree,
    add,
    mul,
    negated,
    negative,
    opposite,
    sub,
    sum_of_squares,
)
from kinsym.inverse.plan import Equation, Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import (
    SIZE,
    TAU,
    Candidate,
    Names,
    Outcome,
    View,
    angle_value,
    divided,
    edge,
    shown,
)
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

TITLES = {"quartic": "square and add, then the half-angle polynomial of degree four"}
COST, OTHER_COST = 60, 61
"""Pieper's own elimination, k1 and k2 of the arm and of y alone, stays regular where the wrist lies on axis 2."""

CONSTANTS = (Kind.CONSTANT, Kind.PARAMETER)

Line = tuple[Poly, Poly, Poly]
"""``p c_y + q s_y + r``."""
Eliminant = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Side:
    """X or Y: ``rest / scale``; ``weights`` are the factors and units of the pool's equations in it."""

    rest: Line
    scale: Poly
    weights: tuple[tuple[Poly, int], ...]


@dataclass(frozen=True)
class Pair:
    """``k1 c + k2 s = X`` and ``k1 s - k2 c = Y`` for the angle that is turned."""

    turned: Angle
    other: Angle
    k1: Line
    k2: Line
    sides: tuple[Side, Side]
    equations: tuple[PoolEquation, PoolEquation]

    @property
    def terms(self) -> int:
        """The number of terms of everything that the step computes with."""
        parts = [*self.k1, *self.k2]
        for side in self.sides:
            parts += [*side.rest, side.scale, *(weight for weight, _ in side.weights)]
        return sum(map(len, parts))


def candidates(view: View) -> Iterator[Candidate]:
    """Pairs of equations in the same two angles, either of which may be the one that is turned."""
    state = view.state
    families: dict[tuple[str, ...], list[PoolEquation]] = {}
    for equation in view.equations:
        if len(equation.angles) == 2 and not equation.lengths:
            families.setdefault(tuple(sorted(a.label for a in equation.angles)), []).append(equation)
    points = _points(state)
    found: list[tuple[Pair, Eliminant]] = []
    for family in families.values():
        angles = family[0].angles
        for turned, other in (angles, angles[::-1]):
            forms = [form for equation in family if (form := _form(state, equation, turned, points))]
            for first, second in permutations(forms, 2):
                pair = _pair(state, turned, other, first, second) if _promising(first, second) else None
                if pair is not None and any(map(any, eliminant := _eliminant(state, pair))):
                    found.append((pair, eliminant))
    for pair, eliminant in found:
        others = [
            second
            for second, same in found
            if (second.other, second.turned) != (pair.other, pair.turned)
            and second.other == pair.other
            and _proportional(eliminant, same)
        ]
        again = min(others, key=lambda second: second.terms, default=pair)
        cost = COST if _own(state.chain.ring, pair) else OTHER_COST
        yield Candidate(cost, pair.terms, pair.other.name, partial(_build, state, pair, again))


@dataclass(frozen=True)
class Form:
    """An equation ``a c + b s + rest = 0``; ``values`` are (a, b) at two points with the same constants."""

    line: Line
    equation: PoolEquation
    values: tuple[tuple[int, int], tuple[int, int]]


def _points(state: State) -> tuple[dict[str, int], dict[str, int]]:
    """Two random points modulo the prime that share the constants and parameters."""
    first, second = state.samples[:2]
    constants = [g.name for g in state.chain.ring.generators if g.kind in CONSTANTS]
    return first, {**second, **{name: first[name] for name in constants}}


def _form(
    state: State, equation: PoolEquation, turned: Angle, points: tuple[dict[str, int], dict[str, int]]
) -> Form | None:
    ring = state.chain.ring
    line = _linear(ring, equation.poly, turned)
    if line is None:
        return None
    first, second = ((ring.evaluate(line[0], point), ring.evaluate(line[1], point)) for point in points)
    return Form(line, equation, (first, second)) if any(first) and any(second) else None


def _promising(first: Form, second: Form) -> bool:
    """Whether the two vectors keep their angle and the ratio of their lengths from point to point."""
    ratios = set()
    for (a1, b1), (a2, b2) in zip(first.values, second.values, strict=True):
        squared = (a2 * a2 + b2 * b2) % PRIME
        if not squared:
            return False
        scale = inverse(squared)
        ratios.add(((a1 * a2 + b1 * b2) * scale % PRIME, (a1 * b2 - b1 * a2) * scale % PRIME))
    return len(ratios) == 1


def _pair(state: State, turned: Angle, other: Angle, one: Form, two: Form) -> Pair | None:
    """The two equations as a turned vector, or None if they are none."""
    ring = state.chain.ring
    first, second = one.equation, two.equation
    (a1, b1, rest1), (a2, b2, rest2) = one.line, two.line
    # Less of the second so that the two vectors are orthogonal: r without the part of z that d1 brings in.
    weights = [(ring.one, first.unit)]
    if along := ring.dot((a1, b1), (a2, b2)):
        ratio = _ratio(ring, along, ring.dot((a2, b2), (a2, b2)))
        if ratio is None:
            return None
        above, below = ratio
        weights = [(below, first.unit), (above, second.unit)]
        a1, b1, rest1 = (ring.mul(below, x) - ring.mul(above, y) for x, y in zip(one.line, two.line, strict=True))
    ratio = _ratio(ring, b2, a1) if a1 else _ratio(ring, -a2, b1)
    if ratio is None:
        return None
    above, below = ratio
    if ring.mul(below, b2) != ring.mul(above, a1) or ring.mul(below, a2) != -ring.mul(above, b1):
        return None
    k1, k2, scale = a1, b1, ring.one
    (quotient1, remainder1), (quotient2, remainder2) = a1.div(below), b1.div(below)
    if not remainder1 and not remainder2:
        # Both left sides are constants times the same vector, as 2 a1 and s alpha1 in Pieper's.
        k1, k2, scale, below = quotient1, quotient2, below, ring.one
    if state.vanishes(k1) and state.vanishes(k2):
        return None
    lines = [_linear(ring, poly, other) for poly in (k1, k2, -rest1, -ring.mul(below, rest2))]
    l1, l2, r1, r2 = lines
    if l1 is None or l2 is None or r1 is None or r2 is None:
        return None
    sides = (Side(r1, scale, tuple(weights)), Side(r2, above, ((below, second.unit),)))
    return Pair(turned, other, l1, l2, sides, (first, second))


def _linear(ring: Ring, poly: Poly, angle: Angle) -> Line | None:
    """A polynomial as ``a c + b s + e``, or None if it is not linear in them."""
    parts = ring.collect(poly, (angle.cosine, angle.sine))
    if not set(parts) <= {(1, 0), (0, 1), (0, 0)}:
        return None
    return parts.get((1, 0), ring.zero), parts.get((0, 1), ring.zero), parts.get((0, 0), ring.zero)


def _ratio(ring: Ring, above: Poly, below: Poly) -> tuple[Poly, Poly] | None:
    """The constants n and d with above/below = n/d if there are any; the caller tests that it is so everywhere."""
    if not above or not below:
        return None
    used = dict.fromkeys((*ring.used(above), *ring.used(below)))
    varying = [name for name in used if ring.generators[ring.index[name]].kind not in CONSTANTS]
    parts, others = ring.collect(below, varying), ring.collect(above, varying)
    key = max(parts)
    if key not in others:
        return None
    n, d = others[key].cancel(parts[key])
    return n, d


def _eliminant(state: State, pair: Pair) -> Eliminant:
    """X^2 + Y^2 - k1^2 - k2^2 up to a factor: its coefficients of c^2, c s, c, s, 1 at the random points."""
    lines = (*(side.rest for side in pair.sides), pair.k1, pair.k2)
    values = [[state.values(part) for part in line] for line in lines]
    scales = zip(*(state.values(side.scale) for side in pair.sides), strict=True)
    result = []
    for point, (m1, m2) in enumerate(scales):
        weights = (m2 * m2, m1 * m1, -m1 * m1 * m2 * m2, -m1 * m1 * m2 * m2)
        total = [0, 0, 0, 0, 0]
        for weight, line in zip(weights, values, strict=True):
            p, q, r = (part[point] for part in line)
            for place, product in enumerate((p * p - q * q, 2 * p * q, 2 * p * r, 2 * q * r, q * q + r * r)):
                total[place] += weight * product
        result.append(tuple(coefficient % PRIME for coefficient in total))
    return tuple(result)


def _proportional(first: Eliminant, second: Eliminant) -> bool:
    """Whether two eliminations say the same of the other angle."""
    return all(
        (a * d - b * c) % PRIME == 0
        for one, two in zip(first, second, strict=True)
        for (a, c), (b, d) in combinations(list(zip(one, two, strict=True)), 2)
    )


def _own(ring: Ring, pair: Pair) -> bool:
    """Whether k1 and k2 depend on the other angle and not on the pose."""
    parts = (*pair.k1, *pair.k2)
    kinds = {ring.generators[ring.index[name]].kind for part in parts for name in ring.used(part)}
    return Kind.POSE not in kinds and any((*pair.k1[:2], *pair.k2[:2]))


def _build(state: State, pair: Pair, again: Pair, names: Names) -> Outcome:
    definitions: list[Definition] = []

    named: dict[Tree, Tree] = {}

    def coefficient(stem: str, tree: Tree) -> Tree:
        if tree not in named:
            named[tree] = names.short(stem, tree, definitions)
        return named[tree]

    def line(parts: Line, scale: Poly) -> tuple[Tree, Tree, Tree]:
        stems = zip(("mu", "nu", "gamma"), parts, strict=True)
        p, q, r = (coefficient(stem, divided(state, part, scale)) for stem, part in stems)
        return p, q, r

    def form(stated: Pair) -> list[tuple[Tree, Tree, Tree]]:
        k1, k2 = (line(part, state.chain.ring.one) for part in (stated.k1, stated.k2))
        x, y = (line(side.rest, side.scale) for side in stated.sides)
        return [x, y, k1, k2]

    vectors = form(pair)
    second = vectors if again is pair else form(again)
    error = _error(state, pair)
    equations = tuple(dict.fromkeys(shown(state, equation) for equation in (*pair.equations, *again.equations)))
    unit = max(equation.unit for equation in pair.equations)
    other, turned = pair.other, pair.turned
    c, s = Sym(other.cosine), Sym(other.sine)
    lines, other_lines = ([_sum([mul(p, c), mul(q, s), r]) for p, q, r in part] for part in (vectors, second))
    statements = [_difference(lines), *([_difference(other_lines)] if again is not pair else [])]
    twice = (
        "; stated twice, as each keeps its digits where the vectors of the other vanish" if again is not pair else ""
    )
    inputs = {**_inputs(vectors, error, ""), **_inputs(second, _error(state, again), "2")}
    step = Step(
        number=names.step(),
        unknown=other.name,
        rule="quartic",
        equations=equations,
        coefficients=tuple(definitions),
        inputs=inputs,
        outputs=(other.cosine, other.sine),
        branches=4,
        unit=unit,
        reference=other.terms,
        solution=(*(("0", statement) for statement in statements), *_half_angle(other)),
        condition=None,
        degenerate=None,
        why=f"the squares of the two equations add up to one without {turned.name}, "
        f"a polynomial of degree four in the tangent of half the angle{twice}",
    )
    values: list[Definition] = []
    sides = [names.short("kappa", line, values) for line in lines]
    follow = _turn_step(names, turned, sides, error=error, equations=equations, unit=unit)
    known = state.known.with_angle(edge(other)).with_angle(edge(turned))
    return Outcome((step, angle_value(other), *values, follow, angle_value(turned)), known)


def _inputs(vectors: list[tuple[Tree, Tree, Tree]], error: Tree, suffix: str) -> dict[str, Tree]:
    """The kernel's arguments for one statement."""
    parts = (
        (f"{name}{end}{suffix}", part)
        for name, line in zip("xykl", vectors, strict=True)
        for end, part in zip(("c", "s", ""), line, strict=True)
    )
    return {**dict(parts), f"t{suffix}": error}


def _difference(lines: list[Tree]) -> Tree:
    """X^2 + Y^2 - k1^2 - k2^2."""
    x, y, k1, k2 = (_square(line) for line in lines)
    return _sum([x, y, opposite(k1), opposite(k2)])


def _half_angle(angle: Angle) -> tuple[tuple[str, Tree], ...]:
    """Cosine and sine by the tangent u of half the angle (the lecture's reduction to a polynomial)."""
    u = Sym(f"u_{angle.label}")
    below = add(ONE, Pow(u, 2))
    return (
        (angle.cosine, Quot(sub(ONE, Pow(u, 2)), below)),
        (angle.sine, Quot(mul(number(2), u), below)),
        (angle.name, angle_value(angle).value),
    )


def _sum(terms: list[Tree]) -> Tree:
    """The sum of the terms that are not zero."""
    kept = [term for term in terms if term != ZERO]
    return add(*kept) if kept else ZERO


def _square(tree: Tree) -> Tree:
    if isinstance(tree, Num):
        return mul(tree, tree)
    return Pow(negated(tree) if negative(tree) or (isinstance(tree, Sum) and negative(tree.terms[0])) else tree, 2)


def _magnitude(tree: Tree) -> Tree:
    return Num(abs(tree.value)) if isinstance(tree, Num) else Call("abs", (tree,))


def _error(state: State, pair: Pair) -> Tree:
    """How far the pose's tolerance moves X and Y."""
    parts = []
    for side in pair.sides:
        for weight, unit in side.weights:
            length: Tree = ONE if unit == 0 else SIZE if unit == 1 else Pow(SIZE, unit)
            above, below = mul(_magnitude(state.tree(weight)), length), _magnitude(state.tree(side.scale))
            parts.append(above if below == ONE else Quot(above, below))
    return mul(TAU, add(*parts))


def _turn_step(
    names: Names, angle: Angle, vectors: list[Tree], *, error: Tree, equations: tuple[Equation, ...], unit: int
) -> Step:
    """The turned angle; it is free where both vectors, (k1, k2) and (X, Y), vanish."""
    x, y, k1, k2 = vectors
    c, s = sub(mul(x, k1), mul(y, k2)), add(mul(x, k2), mul(y, k1))
    d = sum_of_squares(*(k for k in (k1, k2) if k != ZERO))
    return Step(
        number=names.step(),
        unknown=angle.name,
        rule="quotient",
        equations=equations,
        coefficients=(),
        inputs={"x": c, "y": s, "d": d, "t": Pow(error, 2)},
        outputs=(angle.cosine, angle.sine),
        branches=1,
        unit=unit,
        reference=angle.terms,
        solution=(
            (angle.cosine, Quot(c, d)),
            (angle.sine, Quot(s, d)),
            (angle.name, angle_value(angle).value),
        ),
        condition=None,
        degenerate=(d, "=", ZERO),
        why="two of these equations are linear in the cosine and sine of this angle (Cramer's rule)",
    )
