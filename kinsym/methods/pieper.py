"""Pieper's solution: six joints, the last three axes meet in a point (lecture, slides 56 to 58; Pieper 1968).

With r = P.P and z the height of the wrist point P

    r = (k1 c2 + k2 s2) 2 a1 + k3,   z = (k1 s2 - k2 c2) s alpha1 + k4

where k1 to k4 hold theta3 alone. If a1 = 0 then r = k3, if s alpha1 = 0 then z = k4; otherwise squares are added and
theta3 is the root of a polynomial of degree four in the tangent of its half. A joint 3 that slides has d3 in its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from sympy import Integer

from kinsym.algebra.nested import nested, number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import ZERO, Call, PlusMinus, Pow, Quot, Sym, Tree, add, mul, opposite, sub
from kinsym.errors import DoesNotApply, RobotError
from kinsym.kinematics.chain import build_chain
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.euler import state_wrist_of
from kinsym.methods.quartic import Quadratic, solve_quartic
from kinsym.methods.reversed_arm import reversed_arm
from kinsym.methods.steps import Row, half_angle, one_row, quotient, square, two_rows
from kinsym.methods.tables import craig_table, needs_wrist, unlocked
from kinsym.methods.words import short
from kinsym.methods.wrist_point import WristPoint, angle_of, needs_shoulder, state_wrist_point, turned
from kinsym.robot.model import Robot

NAME, TITLE = "pieper", "Pieper's solution"
_NONE = Integer(0)


@dataclass(frozen=True)
class Shoulder:
    """What the equations for r and z are made of, in the ring of words: k1 to k4 by name, a1 and s alpha1.

    ``values`` are k1 to k4 in the chain's ring, polynomials in theta3 or d3 alone.
    """

    k: tuple[Poly, Poly, Poly, Poly]
    a1: Poly
    sine: Poly
    values: tuple[Poly, ...]


def pieper(robot: Robot) -> MethodDerivation:
    """Pieper's solution of a robot whose last three axes meet, or whose first three do, seen from its end.

    Raises :class:`DoesNotApply` with the axes that miss each other, or the joint that slides.
    """
    robot = unlocked(robot)
    arm = _with_wrist(robot)
    chain = build_chain(craig_table(arm))
    needs_shoulder(chain, TITLE)
    draft = Draft(chain, method=NAME, title=TITLE)
    if arm is not robot:
        draft.say(
            "The first three axes meet, not the last. So the arm is solved from its end: its joints in reverse order, "
            "with the opposite signs, make the inverse of its pose, and `u`, `v`, `w` and `p` are here the columns of "
            "that."
        )
    point = state_wrist_point(draft)
    shoulder = _state_r_and_z(draft, point)
    _find_third(draft, point, shoulder)
    _find_second(draft, point, shoulder)
    _find_first(draft, point)
    state_wrist_of(draft)
    return draft.done()


def _with_wrist(robot: Robot) -> Robot:
    """The robot, or where its first three axes meet instead of the last the same arm from its end."""
    try:
        needs_wrist(robot, TITLE)
    except DoesNotApply as reason:
        try:
            other = reversed_arm(robot)
            needs_wrist(other, TITLE)
            needs_shoulder(build_chain(other), TITLE)
        except (DoesNotApply, RobotError):
            raise reason from None
        return other
    return robot


def _state_r_and_z(draft: Draft, point: WristPoint) -> Shoulder:
    """r and z of P, in which theta1 does not occur, and their parts k1 to k4."""
    words, names = point.words, point.names
    draft.say("The square `r` of the length of `P`, and its height `z`, do not depend on joint 1:")
    r = draft.define(names["r"], add(*(Pow(part, 2) for part in point.position)), name="r.P")
    z = draft.define(names["z"], point.position[2], name="z.P")
    g = [Sym(names[f"g{i}"]) for i in (1, 2, 3)]
    draft.state("r.g", r, add(*(Pow(part, 2) for part in g)))
    draft.state("z.g", z, g[2])
    a1, sine, turn = _second_row(draft, point)
    parts, both = _parts(point, a1, sine, turn)
    factor = nested(words, 2 * a1)
    draft.state("r.f", r, add(nested(words, parts[2]), mul(factor, nested(words, both))))
    draft.say(f"With the parts that hold `{draft.chain.robot.joints[2].variable}` alone under names of their own:")
    for i, part in enumerate(parts, start=1):
        draft.define(names[f"k{i}"], nested(words, part))
    k = tuple(words[names[f"k{i}"]] if part else words.zero for i, part in enumerate(parts, start=1))
    k1, k2, k3, k4 = (nested(words, part) for part in k)
    c, s = (nested(words, part) for part in turn)
    draft.say("The lecture's two equations are then")
    draft.state("r", r, add(mul(add(mul(k1, c), mul(k2, s)), factor), k3))
    draft.state("z", z, add(mul(sub(mul(k1, s), mul(k2, c)), nested(words, sine)), k4))
    meaning = {names[f"f{i}"]: entry for i, entry in enumerate(point.f, start=1)}
    return Shoulder(k, a1, sine, tuple(words.expand(part, meaning) for part in parts))


def _second_row(draft: Draft, point: WristPoint) -> tuple[Poly, Poly, tuple[Poly, Poly]]:
    """a1, sin(alpha1), and cosine and sine of the second row's angle, in the ring of words."""
    chain, row = draft.chain, draft.chain.robot.joints[1]
    a1 = point.words.lift(chain.constants.length(chain.ring, row.a or _NONE))
    sine = point.words.lift(chain.constants.angle(chain.ring, row.alpha or _NONE)[1])
    if not a1 and not sine:
        raise DoesNotApply(
            f"{TITLE} does not apply to {chain.robot.name}: axes 1 and 2 are one line (a1 = 0 and sin(alpha1) = 0)."
        )
    c, s = map(point.words.lift, turned(chain, row))
    return a1, sine, (c, s)


def _parts(
    point: WristPoint, a1: Poly, sine: Poly, turn: tuple[Poly, Poly]
) -> tuple[tuple[Poly, Poly, Poly, Poly], Poly]:
    """k1 to k4 over f, what r and z leave when their terms in theta2 are taken away; and f1 c2 - f2 s2."""
    words, (c2, s2) = point.words, turn
    f1, f2 = (words[point.names[name]] if f else words.zero for name, f in zip(("f1", "f2"), point.f, strict=False))
    both = words.mul(f1, c2) - words.mul(f2, s2)
    k3 = words.reduce(words.dot(point.g, point.g) - 2 * a1 * both)
    k4 = words.reduce(point.g[2] - words.mul(sine, words.mul(f1, s2) + words.mul(f2, c2)))
    return (f1, -f2, k3, k4), both


def _find_third(draft: Draft, point: WristPoint, shoulder: Shoulder) -> None:
    """theta3, or d3, by the case of the lecture that the table is."""
    joint = draft.chain.robot.joints[2]
    k = shoulder.values
    unknown = joint.variable or ""
    r, z = Sym(point.names["r"]), Sym(point.names["z"])
    k3, k4 = (nested(point.words, part) for part in shoulder.k[2:])
    if not shoulder.a1:
        draft.say(f"Case 1 of the lecture, `a1 = 0`: `r` does not depend on joint 2, and `{unknown}` follows from")
        draft.state("case1", r, k3)
        _one_unknown(draft, unknown, r, k[2], "r")
    elif not shoulder.sine:
        draft.say(
            f"Case 2 of the lecture, `sin alpha1 = 0`: `z` does not depend on joint 2, and `{unknown}` follows from"
        )
        draft.state("case2", z, k4)
        _one_unknown(draft, unknown, z, k[3], "z")
    else:
        _general_case(draft, point, shoulder)


def _one_unknown(draft: Draft, unknown: str, known: Tree, part: Poly, letter: str) -> None:
    """``known = part`` where the part is linear in the cosine and sine of theta3, or quadratic in d3."""
    ring, chain = draft.ring, draft.chain
    if chain.robot.joints[2].kind == "P":
        parts = ring.collect(part, (unknown,))
        square_part, linear, rest = (parts.get((power,), ring.zero) for power in (2, 1, 0))
        if not square_part and not linear:
            raise _no_third(draft, unknown, letter)
        away = sub(known, draft.tree(rest))
        if not square_part:
            draft.solve(unknown, quotient(away, draft.tree(linear)), branches=1)
            return
        half = ring.mul(linear, ring.number(Fraction(1, 2)))
        radicand = sub(add(square(draft.tree(half)), known), draft.tree(rest)) if half else away
        real = draft.require(f"{unknown}.real", radicand, ">=", ZERO)
        left = opposite(draft.tree(half)) if half else None
        draft.solve(unknown, PlusMinus(left, Call("sqrt", (radicand,))), branches=2, conditions=(real,))
        return
    angle = angle_of(chain, unknown)
    parts = ring.collect(part, (angle.cosine, angle.sine))
    a, b, rest = (parts.get(key, ring.zero) for key in ((1, 0), (0, 1), (0, 0)))
    if not a and not b:
        raise _no_third(draft, unknown, letter)
    mu, nu, gamma = (short(draft, stem, value) for stem, value in (("mu3", a), ("nu3", b), ("gamma3", rest)))
    e = sub(known, gamma)
    if not isinstance(e, Sym):
        e = draft.define(draft.fresh("kappa3"), e)
    half_angle(draft, angle, mu, nu, e)


def _no_third(draft: Draft, unknown: str, letter: str) -> DoesNotApply:
    cause = {
        "r": "the wrist point lies on axis 3, or its distance from axes 1 and 2 does not depend on joint 3",
        "z": "axes 1, 2 and 3 are parallel, or the wrist point lies on axis 3",
    }[letter]
    return DoesNotApply(
        f"{TITLE} does not apply to {draft.chain.robot.name}: {letter} does not depend on {unknown}; {cause}."
    )


def _general_case(draft: Draft, point: WristPoint, shoulder: Shoulder) -> None:
    """Squares of both equations added: theta2 goes out."""
    words = point.words
    names = [nested(words, part) for part in shoulder.k]
    r, z = Sym(point.names["r"]), Sym(point.names["z"])
    a1, sine = nested(words, shoulder.a1), nested(words, shoulder.sine)
    draft.say("Case 3 of the lecture, neither: both equations divided by their factors, squared and added give")
    draft.state(
        "case3",
        add(
            Quot(square(sub(r, names[2])), mul(number(4), square(a1))), quotient(square(sub(z, names[3])), square(sine))
        ),
        add(square(names[0]), square(names[1])),
    )
    symbols = tuple(point.names[f"k{i}"] for i in (1, 2, 3, 4))
    solve_quartic(
        draft, draft.chain.robot.joints[2].variable or "", Quadratic(symbols, shoulder.values, *_constants(draft), r, z)
    )


def _constants(draft: Draft) -> tuple[Poly, Poly]:
    """a1 and sin(alpha1) in the chain's ring."""
    chain, row = draft.chain, draft.chain.robot.joints[1]
    return (
        chain.constants.length(chain.ring, row.a or _NONE),
        chain.constants.angle(chain.ring, row.alpha or _NONE)[1],
    )


def _find_second(draft: Draft, point: WristPoint, shoulder: Shoulder) -> None:
    """theta2 from r and z, which are then linear in its cosine and sine."""
    words = point.words
    row = draft.chain.robot.joints[1]
    angle = angle_of(draft.chain, row.variable or "")
    k1, k2 = shoulder.k[:2]
    k3, k4 = (nested(words, part) for part in shoulder.k[2:])
    c2, s2 = map(words.lift, turned(draft.chain, row))
    r, z = Sym(point.names["r"]), Sym(point.names["z"])

    def row_of(along: Poly, across: Poly, known: Tree) -> Row:
        """``along cos + across sin = known`` of the cell's angle, in cosine and sine of the joint's own."""
        parts = words.collect(words.mul(along, c2) + words.mul(across, s2), (angle.cosine, angle.sine))
        return Row(parts.get((1, 0), words.zero), parts.get((0, 1), words.zero), known)

    draft.say(f"`{angle.name}` then follows from {{r}} and {{z}},")
    if not shoulder.a1:
        one_row(draft, words, angle, row_of(-k2 * shoulder.sine, k1 * shoulder.sine, sub(z, k4)))
    elif not shoulder.sine:
        one_row(draft, words, angle, row_of(2 * shoulder.a1 * k1, 2 * shoulder.a1 * k2, sub(r, k3)))
    else:
        x = Quot(sub(r, k3), nested(words, 2 * shoulder.a1))
        y = quotient(sub(z, k4), nested(words, shoulder.sine))
        two_rows(draft, words, angle, row_of(k1, k2, x), row_of(-k2, k1, y))


def _find_first(draft: Draft, point: WristPoint) -> None:
    """theta1 from the first two entries of P."""
    words, names = point.words, point.names
    row = draft.chain.robot.joints[0]
    angle = angle_of(draft.chain, row.variable or "")
    g1, g2 = words[names["g1"]], words[names["g2"]]
    c1, s1 = map(words.lift, turned(draft.chain, row))
    rows = []
    for along, across, known in ((g1, -g2, point.position[0]), (g2, g1, point.position[1])):
        parts = words.collect(words.mul(along, c1) + words.mul(across, s1), (angle.cosine, angle.sine))
        rows.append(Row(parts.get((1, 0), words.zero), parts.get((0, 1), words.zero), known))
    draft.say(f"`{angle.name}` follows from {{point.g}}:")
    two_rows(draft, words, angle, rows[0], rows[1])
