"""What the rules that square and add have in common: the vectors, their difference, the step that follows.

The squares are formed of the names of coefficients, not of the coefficients: the sums stay short, and nothing of
the large ring is multiplied out.
"""

from __future__ import annotations

from kinsym.algebra.tree import (
    ONE,
    ZERO,
    Call,
    Num,
    Pow,
    Quot,
    Sum,
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
from kinsym.inverse.rules.base import SIZE, TAU, Names, angle_value
from kinsym.inverse.rules.turned_pair import Pair
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

Terms = tuple[Tree, Tree, Tree]
"""A line as trees."""


def quartic_inputs(vectors: list[Terms], error: Tree, suffix: str) -> dict[str, Tree]:
    """The kernel's arguments for one statement."""
    parts = (
        (f"{name}{end}{suffix}", part)
        for name, line in zip("xykl", vectors, strict=True)
        for end, part in zip(("c", "s", ""), line, strict=True)
    )
    return {**dict(parts), f"t{suffix}": error}


def difference(lines: list[Tree]) -> Tree:
    """X^2 + Y^2 - k1^2 - k2^2."""
    x, y, k1, k2 = (square(line) for line in lines)
    return total([x, y, opposite(k1), opposite(k2)])


def total(terms: list[Tree]) -> Tree:
    """The sum of the terms that are not zero."""
    kept = [term for term in terms if term != ZERO]
    return add(*kept) if kept else ZERO


def square(tree: Tree) -> Tree:
    """The square, of the tree or of its opposite if that reads better."""
    if isinstance(tree, Num):
        return mul(tree, tree)
    return Pow(negated(tree) if negative(tree) or (isinstance(tree, Sum) and negative(tree.terms[0])) else tree, 2)


def magnitude(tree: Tree) -> Tree:
    """The absolute value."""
    return Num(abs(tree.value)) if isinstance(tree, Num) else Call("abs", (tree,))


def error_of(state: State, pair: Pair) -> Tree:
    """How far the pose's tolerance moves X and Y."""
    parts = []
    for side in pair.sides:
        for weight, unit in side.weights:
            length: Tree = ONE if unit == 0 else SIZE if unit == 1 else Pow(SIZE, unit)
            above, below = mul(magnitude(state.tree(weight)), length), magnitude(state.tree(side.scale))
            parts.append(above if below == ONE else Quot(above, below))
    return mul(TAU, add(*parts))


def turn_step(names: Names, angle: Angle, vectors: list[Tree], *, error: Tree, equations: tuple[Equation, ...]) -> Step:
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
