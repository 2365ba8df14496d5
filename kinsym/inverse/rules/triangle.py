"""Two links in a plane: square and add (lecture 2.85 Fanuc, 3.4 planar RRR; the law of cosines).

Two position equations are the real and imaginary part of X + iY = A e^(i x) + B e^(i y) with constant A and B. Their
squares leave the angle between the links, two values; the direction of the first link follows without a choice. The
border is where the triangle is flat: stretched or folded.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import combinations

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import (
    ZERO,
    Call,
    Definition,
    PlusMinus,
    Pow,
    Quot,
    Sym,
    Tree,
    add,
    mul,
    opposite,
    sub,
    sum_of_squares,
)
from kinsym.inverse.plan import Step
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.base import Candidate, Names, Outcome, View, angle_value, edge, shown, tolerance
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

TITLES = {
    "triangle": "two-link triangle (square and add)",
    "direction": "direction of the first link",
}
COST = 28
AWAY = 100
"""A triangle seen from the base of its group reads better than one seen from the tip."""


@dataclass(frozen=True)
class Link:
    """A link turned by ``angle``: its vector (along, across) turns with ``sense`` times the angle's generator."""

    angle: Angle
    along: Poly
    across: Poly
    sense: int


@dataclass(frozen=True)
class Triangle:
    """X + iY = first e^(i x) + second e^(i y); the angles share the node ``base``."""

    first: Link
    second: Link
    x: Poly
    y: Poly
    equations: tuple[PoolEquation, PoolEquation]
    elbow: Angle
    elbow_sense: int
    base: int


def candidates(view: View) -> Iterator[Candidate]:
    """Pairs of equations that close a triangle."""
    families: dict[tuple[str, ...], list[PoolEquation]] = {}
    for equation in view.of_two_angles():
        families.setdefault(tuple(sorted(a.label for a in equation.angles)), []).append(equation)
    for family in families.values():
        for pair in combinations(family, 2):
            for first, second in (pair, pair[::-1]):
                triangle = _triangle(view.state, first, second)
                if triangle is not None:
                    terms = first.terms + second.terms + (0 if triangle.base == 0 else AWAY)
                    yield Candidate(COST, terms, triangle.elbow.name, partial(_build, view.state, triangle))


def _triangle(state: State, real: PoolEquation, imaginary: PoolEquation) -> Triangle | None:
    ring = state.chain.ring
    names = [g for angle in real.angles for g in (angle.cosine, angle.sine)]
    parts_real, parts_imaginary = ring.collect(-real.poly, names), ring.collect(-imaginary.poly, names)
    if any(sum(key) > 1 for key in (*parts_real, *parts_imaginary)):
        return None
    links = []
    for i, angle in enumerate(real.angles):
        c_key = tuple(int(j == 2 * i) for j in range(4))
        s_key = tuple(int(j == 2 * i + 1) for j in range(4))
        link = _link(
            angle,
            (parts_real.get(c_key, ring.zero), parts_real.get(s_key, ring.zero)),
            (parts_imaginary.get(c_key, ring.zero), parts_imaginary.get(s_key, ring.zero)),
        )
        if link is None or (state.vanishes(link.along) and state.vanishes(link.across)):
            return None
        links.append(link)
    shared = {links[0].angle.low, links[0].angle.high} & {links[1].angle.low, links[1].angle.high}
    base = min(shared)
    ends = [link.angle.high if link.angle.low == base else link.angle.low for link in links]
    senses = [link.sense * link.angle.sign * (1 if link.angle.low == base else -1) for link in links]
    if senses[0] != senses[1]:
        return None
    if abs(ends[0] - base) > abs(ends[1] - base):
        links.reverse()
        ends.reverse()
    elbow = state.chain.angles[links[0].angle.group, min(ends), max(ends)]
    elbow_sense = senses[0] * elbow.sign * (1 if ends[0] < ends[1] else -1)
    constant = (0, 0, 0, 0)
    x: Poly = parts_real.get(constant, ring.zero)
    y: Poly = parts_imaginary.get(constant, ring.zero)
    return Triangle(
        links[0],
        links[1],
        -x,
        -y,
        (real, imaginary),
        elbow,
        elbow_sense,
        base,
    )


def _link(angle: Angle, real: tuple[Poly, Poly], imaginary: tuple[Poly, Poly]) -> Link | None:
    """The link in ``along c - sense across s`` and ``across c + sense along s``."""
    for sense in (1, -1):
        if imaginary[1] == real[0] * sense and real[1] == -imaginary[0] * sense:
            return Link(angle, real[0], imaginary[0], sense)
    return None


def _build(state: State, triangle: Triangle, names: Names) -> Outcome:
    definitions: list[Definition] = []
    first, second, elbow = triangle.first, triangle.second, triangle.elbow
    ring = state.chain.ring

    # Turn the plane so that the first link lies along its real axis.
    if not first.across:
        a, x, y, b1, b2 = first.along, triangle.x, triangle.y, second.along, second.across
        l1: Tree = state.tree(a)
    elif not first.along:
        a, x, y, b1, b2 = first.across, triangle.y, -triangle.x, second.across, -second.along
        l1 = state.tree(a)
    else:
        a1, a2 = first.along, first.across
        length = Call("sqrt", (state.tree(ring.dot((a1, a2), (a1, a2))),))
        l1 = names.short("lambda", length, definitions)
        x, y = ring.dot((a1, a2), (triangle.x, triangle.y)), ring.dot((a1, -a2), (triangle.y, triangle.x))
        b1 = ring.dot((a1, a2), (second.along, second.across))
        b2 = ring.dot((a1, -a2), (second.across, second.along))
    bent = bool(first.across) and bool(first.along)

    def scaled(poly: Poly) -> Tree:
        tree = state.tree(poly)
        return Quot(tree, l1) if bent and tree != ZERO else tree

    px = names.short("kappa", scaled(x), definitions)
    py = names.short("kappa", scaled(y), definitions)
    along_b = names.short("lambda", scaled(b1), definitions)
    across_b = names.short("lambda", scaled(b2), definitions)
    if across_b == ZERO:
        l2 = along_b
    elif along_b == ZERO:
        l2 = across_b
    else:
        l2 = names.short("lambda", Call("sqrt", (sum_of_squares(along_b, across_b),)), definitions)

    k, w, along = (Sym(f"{stem}_{elbow.label}") for stem in ("k", "w", "h"))
    cosine, sine = _elbow_pair(k, w, along_b, across_b, l2)
    if triangle.elbow_sense < 0:
        sine = opposite(sine)
    t = tolerance(1)
    rho = sum_of_squares(px, py)
    elbow_value, first_value = angle_value(elbow), angle_value(first.angle)
    equations = tuple(shown(state, equation) for equation in triangle.equations)
    triangle_step = Step(
        number=names.step(),
        unknown=elbow.name,
        rule="triangle",
        equations=equations,
        coefficients=tuple(definitions),
        inputs={"x": px, "y": py, "l1": l1, "l2": l2, "t": t},
        outputs=(k.name, w.name, along.name),
        branches=2,
        reference=elbow.terms,
        solution=(
            (k.name, Quot(sub(sub(rho, sum_of_squares(l1)), sum_of_squares(l2)), mul(number(2), l1))),
            (w.name, PlusMinus(None, Call("sqrt", (sub(sum_of_squares(l2), Pow(k, 2)),)))),
            (along.name, add(l1, k)),
            (elbow.cosine, cosine),
            (elbow.sine, sine),
            (elbow.name, elbow_value.value),
        ),
        condition=(Pow(k, 2), "<=", sum_of_squares(l2)),
        degenerate=None,
        why="the squares of the two equations add up to one that holds this angle alone",
    )
    elbow_pair = (Definition(name=elbow.cosine, value=cosine), Definition(name=elbow.sine, value=sine))
    sense = first.sense
    direction_step = Step(
        number=names.step(),
        unknown=first.angle.name,
        rule="direction",
        equations=equations,
        coefficients=(),
        inputs={
            "x": px,
            "y": py if sense > 0 else opposite(py),
            "along": along,
            "across": w if sense > 0 else opposite(w),
            "t": t,
        },
        outputs=(first.angle.cosine, first.angle.sine),
        branches=1,
        reference=first.angle.terms,
        solution=((first.angle.name, _direction(px, py, along, w, sense)),),
        condition=None,
        degenerate=(rho, "=", ZERO),
        why="the direction of the goal less the angle at the base of the triangle",
    )
    known = state.known.with_angle(edge(elbow)).with_angle(edge(first.angle))
    return Outcome((triangle_step, *elbow_pair, elbow_value, direction_step, first_value), known)


def _elbow_pair(k: Tree, w: Tree, along: Tree, across: Tree, length: Tree) -> tuple[Tree, Tree]:
    """(c, s) of the elbow from k + i w = (along + i across)(c + i s)."""
    if across == ZERO:
        return Quot(k, along), Quot(w, along)
    if along == ZERO:
        return Quot(w, across), Quot(opposite(k), across)
    squared = Pow(length, 2)
    return (
        Quot(add(mul(k, along), mul(w, across)), squared),
        Quot(sub(mul(w, along), mul(k, across)), squared),
    )


def _direction(x: Tree, y: Tree, along: Tree, across: Tree, sense: int) -> Tree:
    value = sub(Call("atan2", (y, x)), Call("atan2", (across, along)))
    return value if sense > 0 else opposite(value)
