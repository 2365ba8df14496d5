"""The polynomial of degree four of Pieper's third case (lecture, slides 55 and 58).

Multiplied out, (r - k3)^2/(4 a1^2) + (z - k4)^2/s^2 alpha1 = k1^2 + k2^2 is quadratic in the cosine and sine of theta3,

    kappa1 c^2 + kappa2 c s + kappa3 c + kappa4 s + kappa5 = 0,

and with c = (1 - u^2)/(1 + u^2), s = 2u/(1 + u^2) of degree four in u. With d3 in place of theta3 it is of degree
four in d3 itself.
"""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.nested import nested, number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ONE, ZERO, Call, Pow, Sym, Tree, add, mul, sub
from kinsym.errors import DoesNotApply
from kinsym.methods.draft import Draft
from kinsym.methods.steps import TWO, AngleOf, tangent
from kinsym.methods.words import Words, short
from kinsym.methods.wrist_point import angle_of


@dataclass(frozen=True)
class Quadratic:
    """k1 to k4 by name and in the chain's ring, a1 and s alpha1 in that ring, r and z by name."""

    symbols: tuple[str, ...]
    k: tuple[Poly, ...]
    a1: Poly
    sine: Poly
    r: Sym
    z: Sym

    def eliminant(self, words: Words, k: list[Poly], sine: Poly) -> Poly:
        """s^2 (r - k3)^2 + 4 a1^2 ((z - k4)^2 - s^2 (k1^2 + k2^2)) in the ring of words."""
        mul = words.mul
        four = 4 * mul(words.lift(self.a1), words.lift(self.a1))
        squared = mul(sine, sine)
        r, z = words[self.r.name] - k[2], words[self.z.name] - k[3]
        both = mul(k[0], k[0]) + mul(k[1], k[1])
        return words.reduce(mul(squared, mul(r, r)) + mul(four, mul(z, z) - mul(squared, both)))


def solve_quartic(draft: Draft, unknown: str, given: Quadratic) -> None:
    """State the polynomial and solve for theta3, or for d3."""
    ring = draft.ring
    sliding = draft.chain.robot.joints[2].kind == "P"
    names = (unknown,) if sliding else (angle_of(draft.chain, unknown).cosine, angle_of(draft.chain, unknown).sine)
    draft.say(f"As polynomials in `{unknown}`," if sliding else f"In the cosine and sine of `{unknown}`,")
    named: dict[str, None] = {}
    lines: list[list[tuple[tuple[int, ...], Tree]]] = []
    for index, part in enumerate(given.k, start=1):
        terms = []
        for key, coefficient in sorted(ring.collect(part, names).items(), reverse=True):
            stem = "gamma" if not any(key) else "mu" if key[0] else "nu"
            power = str(key[0]) if sliding and key[0] > 1 else ""
            value = short(draft, f"{stem}{index}{'_' * bool(power)}{power}", coefficient)
            terms.append((key, value))
            if isinstance(value, Sym):
                named[value.name] = None
        lines.append(terms)
        monomials = (mul(value, *_powers(names, key)) for key, value in terms)
        draft.state(f"k{index}.{unknown}", Sym(given.symbols[index - 1]), add(*monomials))
    # The sine of a twist keeps its name where its square would become 1 - cos^2.
    plain = given.sine.is_ground
    word = draft.fresh("sine")
    written = {} if plain else {word: draft.tree(given.sine)}
    words = Words(ring, [name for name in (*named, given.r.name, given.z.name, *written) if name not in ring])
    k = [_line(words, names, terms, draft, part) for terms, part in zip(lines, given.k, strict=True)]
    eliminant = given.eliminant(words, k, words.lift(given.sine) if plain else words[word])
    parts = words.collect(eliminant, names)
    if all(not any(key) for key in parts):
        raise DoesNotApply(f"{unknown} does not occur in the eliminant of {draft.chain.robot.name}.")
    if sliding:
        draft.say(f"{{case3}} is, multiplied by its denominators, a polynomial of degree four in `{unknown}`:")
        state_in_length(draft, unknown, {key: nested(words, part, written) for key, part in parts.items()})
    else:
        draft.say("{case3} is, multiplied by its denominators,")
        state_in_angle(
            draft,
            angle_of(draft.chain, unknown),
            {key: nested(words, part, written) for key, part in parts.items()},
        )


def _powers(names: tuple[str, ...], key: tuple[int, ...]) -> list[Tree]:
    return [Sym(name) if power == 1 else Pow(Sym(name), power) for name, power in zip(names, key, strict=True) if power]


def _line(
    words: Words, names: tuple[str, ...], terms: list[tuple[tuple[int, ...], Tree]], draft: Draft, part: Poly
) -> Poly:
    """One of k1 to k4 in the ring of words: a coefficient with a name stands for itself."""
    plain = draft.ring.collect(part, names)
    total = words.zero
    for key, value in terms:
        new = isinstance(value, Sym) and value.name not in draft.ring
        factor = words[value.name] if new else words.lift(plain[key])  # type: ignore[union-attr]
        for name, power in zip(names, key, strict=True):
            factor = factor * words[name] ** power
        total += factor
    return words.reduce(total)


def state_in_angle(draft: Draft, angle: AngleOf, parts: dict[tuple[int, ...], Tree]) -> None:
    """A quadratic equation in the cosine and sine of an angle, by its coefficients, and the polynomial in u."""
    unknown = angle.name
    keys = ((2, 0), (1, 1), (1, 0), (0, 1), (0, 0))
    kappa: list[Tree] = []
    for index, key in enumerate(keys, start=1):
        part = parts.get(key)
        kappa.append(draft.define(draft.fresh(f"kappa{index}"), part) if part else ZERO)
    c, s = angle.c, angle.s
    terms: tuple[Tree, ...] = (Pow(c, 2), mul(c, s), c, s, ONE)
    draft.state(f"{unknown}.equation", add(*(mul(value, term) for value, term in zip(kappa, terms, strict=True))), ZERO)
    u = tangent(draft, angle)
    a, b, p, q, e = kappa
    powers: list[tuple[Tree, Tree]] = [
        (add(a, mul(number(-1), p), e), Pow(u, 4)),
        (mul(TWO, sub(q, b)), Pow(u, 3)),
        (mul(TWO, sub(e, a)), Pow(u, 2)),
        (mul(TWO, add(q, b)), u),
        (add(a, p, e), ONE),
    ]
    draft.say(f"It is a polynomial of degree four in `{u.name}`:")
    draft.state(f"{unknown}.quartic", add(*(mul(value, power) for value, power in powers)), ZERO)
    draft.solve(unknown, mul(TWO, Call("atan", (u,))), branches=4)


def state_in_length(draft: Draft, unknown: str, parts: dict[tuple[int, ...], Tree]) -> None:
    """A polynomial in a prismatic variable, by its coefficients."""
    terms = []
    for (power,), part in sorted(parts.items(), reverse=True):
        value = draft.define(draft.fresh(f"kappa{power}"), part)
        terms.append(mul(value, *_powers((unknown,), (power,))))
    draft.state(f"{unknown}.quartic", add(*terms), ZERO)
