"""One linear equation a c + b s = e whose border is a pole: a wrist of equal twists, 30 or 60 degrees, near s5 = 0.

There e = p where an entry x of the pose's rotation is 1 or -1, with |p| = |(a, b)| (outer axes of the wrist in line).
The plain rule takes e from x, which knows nothing of a small angle: 1 - x loses half of its digits. The other two
entries of the column have them: 1 - x = (y^2 + z^2)/(1 + x). The two roots meet where y = z = 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import Call, Definition, PlusMinus, Tree, opposite, sub, sum_of_squares
from kinsym.inverse.plan import Step
from kinsym.inverse.rules.base import TAU, Candidate, LinearForm, Names, Outcome, View, angle_value, edge, shown
from kinsym.inverse.rules.squares import magnitude, square
from kinsym.inverse.state import State

TITLES = {"linear_pole": "one linear equation a c + b s = e, whose roots meet where two axes are in line"}
COST = 29


@dataclass(frozen=True)
class Pole:
    """``e = alpha + beta x`` is ``p = alpha + sense beta`` at the pole ``x = sense``."""

    alpha: Poly
    beta: Poly
    entry: str
    sense: int


def candidates(view: View) -> Iterator[Candidate]:
    """Linear forms with one constant factor and a right side that holds one entry of the rotation."""
    for forms in view.linear.values():
        for form in forms:
            pole = _pole(view.state, form)
            if pole is not None:
                yield Candidate(COST, form.terms, form.angle.name, partial(_build, view.state, form, pole))


def _pole(state: State, form: LinearForm) -> Pole | None:
    ring = state.chain.ring
    radius = form.a if not form.b else form.b if not form.a else ring.zero
    if not radius or not ring.is_constant(radius):
        return None
    entries = [name for name in ring.used(form.e) if not ring.is_constant(ring[name])]
    if len(entries) != 1 or entries[0][:2] not in ("u_", "v_", "w_"):
        return None
    parts = ring.collect(form.e, entries)
    if set(parts) != {(0,), (1,)}:
        return None
    alpha, beta = parts[(0,)], parts[(1,)]
    for sense in (1, -1):
        if any(state.vanishes(alpha + beta * sense + radius * sign) for sign in (1, -1)):
            return Pole(alpha, beta, entries[0], sense)
    return None


def _build(state: State, form: LinearForm, pole: Pole, names: Names) -> Outcome:
    angle = form.angle
    definitions: list[Definition] = []

    def named(tree: Tree) -> Tree:
        return names.short("kappa", tree, definitions)

    a, b = named(state.tree(form.a)), named(state.tree(form.b))
    p = named(state.tree(pole.alpha + pole.beta * pole.sense))
    x, *across = (state.tree(state.chain.ring[name]) for name in _column(pole.entry))
    x = x if pole.sense > 0 else opposite(x)
    e, radius = named(state.tree(form.e)), sum_of_squares(a, b)
    root = Call("sqrt", (sub(radius, square(e)),))
    step = Step(
        number=names.step(),
        unknown=angle.name,
        rule="linear_pole",
        equations=(shown(state, form.equation),),
        coefficients=tuple(definitions),
        inputs={
            "a": a,
            "b": b,
            "p": p,
            "k": magnitude(state.tree(pole.beta)),
            "x": x,
            "y": across[0],
            "z": across[1],
            "t": TAU,
        },
        outputs=(angle.cosine, angle.sine),
        branches=2,
        reference=angle.terms,
        solution=((angle.name, PlusMinus(Call("atan2", (b, a)), Call("atan2", (root, e)))),),
        condition=(radius, ">=", square(e)),
        degenerate=None,
        why="one equation holds this angle alone; its root is taken of the two entries that vanish with it",
    )
    return Outcome((step, angle_value(angle)), state.known.with_angle(edge(angle)))


def _column(entry: str) -> tuple[str, str, str]:
    """An entry of a column and the two others."""
    column, row = entry.split("_")
    others = [f"{column}_{other}" for other in "xyz" if other != row]
    return entry, others[0], others[1]
