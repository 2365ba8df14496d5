"""The steps by which the lecture's methods find one unknown from equations that hold it alone.

An angle enters as ``a c + b s = e`` with c, s its cosine and sine. One such equation gives it by a reference angle or
by u = tan(theta/2) (lecture, slide 55), two give both c and s by Cramer's rule.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.nested import nested, number
from kinsym.algebra.ring import Poly, Ring
from kinsym.algebra.tree import (
    ONE,
    ZERO,
    Call,
    Num,
    Pi,
    PlusMinus,
    Pow,
    Quot,
    Sum,
    Sym,
    Tree,
    add,
    mul,
    negative,
    opposite,
    sub,
    sum_of_squares,
)
from kinsym.methods.document import Equation
from kinsym.methods.draft import Draft

TWO = number(2)


@dataclass(frozen=True)
class AngleOf:
    """An angle with the names of its cosine and sine: theta23, c23, s23."""

    name: str
    cosine: str
    sine: str

    @property
    def label(self) -> str:
        """The digits: 23; the name of an angle that no joint has."""
        return self.cosine[1:] if self.cosine[1:2].isdigit() else self.name

    @property
    def c(self) -> Tree:
        """The cosine."""
        return Sym(self.cosine)

    @property
    def s(self) -> Tree:
        """The sine."""
        return Sym(self.sine)


class Written(AngleOf):
    """An angle whose cosine and sine are written out: cos(theta)."""

    @property
    def c(self) -> Tree:
        """The cosine."""
        return Call("cos", (Sym(self.name),))

    @property
    def s(self) -> Tree:
        """The sine."""
        return Call("sin", (Sym(self.name),))


@dataclass(frozen=True)
class Row:
    """``a c + b s = e``; the coefficients are polynomials, what is on the right is as it is printed."""

    a: Poly
    b: Poly
    e: Tree


def square(tree: Tree) -> Tree:
    """``tree^2``; a number is worked out and a sign drops."""
    return sum_of_squares(tree) if isinstance(tree, Num) or negative(tree) else Pow(tree, 2)


def quotient(above: Tree, below: Tree) -> Tree:
    """``above/below``, a divisor of one or minus one left out."""
    if below == ONE or above == ZERO:
        return above
    return opposite(above) if below == number(-1) else Quot(above, below)


def half_angle(draft: Draft, angle: AngleOf, a: Tree, b: Tree, e: Tree) -> None:
    """``a c + b s = e`` by u = tan(theta/2): a quadratic equation in u (lecture, slide 55)."""
    name = angle.name
    linear = draft.state(f"{name}.equation", add(mul(a, angle.c), mul(b, angle.s)), e)
    u = tangent(draft, angle)
    draft.say(f"Put into {{{linear.name}}}, multiplied by `1 + {u.name}^2`, and collected:")
    squared = Pow(u, 2)
    draft.state(
        f"{name}.substituted",
        add(mul(a, sub(ONE, squared)), mul(TWO, b, u)),
        mul(e, Sum((ONE, squared))),
    )
    total = add(a, e)
    collected = add(mul(total, squared), opposite(mul(TWO, b, u)), sub(e, a))
    draft.state(f"{name}.collected", collected, ZERO)
    radicand = sub(sum_of_squares(b, a), sum_of_squares(e))
    real = draft.require(f"{name}.real", sum_of_squares(a, b), ">=", sum_of_squares(e))
    both = draft.require(f"{name}.finite", total, "!=", ZERO) if not isinstance(total, Num) else None
    if both is not None:
        draft.say(
            f"Where {{{both.name}}} fails `{name} = pi` is a root, which `{u.name}` cannot show; the equation is then "
            f"linear in `{u.name}` and gives the other root."
        )
    root = quotient(PlusMinus(None if b == ZERO else b, Call("sqrt", (radicand,))), total)
    draft.state(f"{name}.roots", u, root)
    conditions = (real,) if both is None else (real, both)
    draft.solve(name, mul(TWO, Call("atan", (root,))), branches=2, conditions=conditions)


def tangent(draft: Draft, angle: AngleOf) -> Sym:
    """u = tan(theta/2), and cosine and sine by it."""
    u = draft.fresh(f"u_{angle.label}")
    draft.define(u, Call("tan", (Quot(Sym(angle.name), TWO),)))
    below = Sum((ONE, Pow(Sym(u), 2)))
    draft.state(f"{angle.name}.cosine", Call("cos", (Sym(angle.name),)), Quot(sub(ONE, Pow(Sym(u), 2)), below))
    draft.state(f"{angle.name}.sine", Call("sin", (Sym(angle.name),)), Quot(mul(TWO, Sym(u)), below))
    return Sym(u)


def one_row(draft: Draft, ring: Ring, angle: AngleOf, row: Row) -> None:
    """``a c + b s = e`` by an arc cosine or sine where one coefficient is zero, by two arc tangents otherwise."""
    a, b = nested(ring, row.a), nested(ring, row.b)
    if row.e == ZERO:
        _homogeneous(draft, angle, a, b)
    elif ZERO in (a, b):
        cosine = b == ZERO
        value = quotient(row.e, a if cosine else b)
        limit = draft.require(f"{angle.name}.real", Call("abs", (value,)), "<=", ONE)
        if cosine:
            draft.solve(angle.name, PlusMinus(None, Call("acos", (value,))), branches=2, conditions=(limit,))
        else:
            first = Call("asin", (value,))
            draft.solve(angle.name, first, branches=2, conditions=(limit,), also=sub(Pi(), first))
    else:
        radius = sum_of_squares(a, b)
        root = Call("sqrt", (sub(radius, sum_of_squares(row.e)),))
        real = draft.require(f"{angle.name}.real", radius, ">=", sum_of_squares(row.e))
        solution = PlusMinus(Call("atan2", (b, a)), Call("atan2", (root, row.e)))
        draft.solve(angle.name, solution, branches=2, conditions=(real,))


def _homogeneous(draft: Draft, angle: AngleOf, a: Tree, b: Tree) -> None:
    """``a c + b s = 0``: two angles that differ by half a turn."""
    y, x = (a, opposite(b)) if not negative(a) else (opposite(a), b)
    free = draft.require(f"{angle.name}.unique", sum_of_squares(x, y), "!=", ZERO)
    second = Call("atan2", (opposite(y), opposite(x)))
    draft.solve(angle.name, Call("atan2", (y, x)), branches=2, conditions=(free,), also=second)


def two_rows(draft: Draft, ring: Ring, angle: AngleOf, first: Row, second: Row, *, determinant: str = "") -> None:
    """Two equations in cosine and sine by Cramer's rule; ``determinant`` gives it a name."""
    below = ring.reduce(ring.mul(first.a, second.b) - ring.mul(second.a, first.b))
    parts = [second.b, -first.b, -second.a, first.a]
    common = below
    for part in parts:
        common = common.gcd(part)
    if common.LC < 0:
        common = -common
    # Over the rationals a common divisor has no number of its own, which would leave c = 2 k/(2 a).
    scale = below.quo(common)
    numbers = [part.quo(common) for part in parts]
    content = scale.content()
    scale, numbers = scale.quo_ground(content), [part.quo_ground(content) for part in numbers]
    if scale.LC < 0:
        scale, numbers = -scale, [-part for part in numbers]
    trees = [nested(ring, part) for part in numbers]
    c = _combined(trees[:2], first.e, second.e)
    s = _combined(trees[2:], first.e, second.e)
    divisor = nested(ring, scale)
    conditions: tuple[Equation, ...] = ()
    if isinstance(divisor, Num):
        draft.state(f"{angle.name}.c", angle.c, quotient(c, divisor))
        draft.state(f"{angle.name}.s", angle.s, quotient(s, divisor))
        y, x = angle.s, angle.c
    elif not isinstance(divisor, Sum):
        conditions = (draft.require(f"{angle.name}.unique", divisor, "!=", ZERO),)
        draft.solve(angle.name, Call("atan2", (Quot(s, divisor), Quot(c, divisor))), branches=1, conditions=conditions)
        return
    else:
        if determinant:
            divisor = draft.define(draft.fresh(determinant), divisor)
        conditions = (draft.require(f"{angle.name}.unique", divisor, "!=", ZERO),)
        draft.state(f"{angle.name}.c", angle.c, Quot(c, divisor))
        draft.state(f"{angle.name}.s", angle.s, Quot(s, divisor))
        y, x = angle.s, angle.c
    draft.solve(angle.name, Call("atan2", (y, x)), branches=1, conditions=conditions)


def _combined(weights: list[Tree], first: Tree, second: Tree) -> Tree:
    """``w1 e1 + w2 e2``, a term without a minus sign first."""
    terms = [mul(weight, e) for weight, e in zip(weights, (first, second), strict=True) if weight != ZERO]
    terms = [term for term in terms if term != ZERO]
    if len(terms) == 2 and negative(terms[0]) and not negative(terms[1]):
        terms.reverse()
    return add(*terms)
