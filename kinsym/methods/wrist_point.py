"""The wrist point of an arm whose last three axes meet: P = T_0_1 T_1_2 T_2_3 P_3_O4 (lecture, slide 56).

    f = T_2_3 P_3_O4,   g = T_1_2 f,   P = (c1 g1 - s1 g2, s1 g1 + c1 g2, g3)

in Craig's convention. The lecture lays frame {0} so that alpha0 = a0 = d1 = 0; another base is moved to the left.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Integer

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Vector, identity
from kinsym.algebra.tree import ONE, Sym, Tree, add, mul, sub
from kinsym.errors import DoesNotApply
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import link_transform, own_angle
from kinsym.kinematics.links import Rigid, offset, turn_z
from kinsym.methods.document import Factor, Matrix, Product
from kinsym.methods.draft import Draft
from kinsym.methods.steps import AngleOf
from kinsym.methods.words import Words
from kinsym.robot.model import Joint

_NONE = Integer(0)


@dataclass(frozen=True)
class WristPoint:
    """What is stated of the wrist point: the ring with f, g, k as names, what f is, the row of joint 2."""

    words: Words
    f: Vector
    """The entries of f in the chain's ring."""
    names: dict[str, str]
    """f1 to k4, r and z as they are called here."""
    g: tuple[Poly, Poly, Poly]
    """The entries of g in the ring of words, over f."""
    position: tuple[Tree, Tree, Tree]
    """The entries of P, known."""


def angle_of(chain: Chain, variable: str) -> AngleOf:
    """A joint's angle with the names of its cosine and sine."""
    for angle in chain.angles.values():
        if angle.terms == ((variable, 1),):
            return AngleOf(angle.name, angle.cosine, angle.sine)
    raise KeyError(variable)


def turned(chain: Chain, joint: Joint) -> tuple[Poly, Poly]:
    """Cosine and sine of the angle cell of a row, joint variable and offset together."""
    ring = chain.ring
    sign, rest = offset(joint.theta or _NONE, joint)
    c, s = chain.constants.angle(ring, rest)
    if joint.kind != "R":
        return c, s
    c1, s1 = own_angle(chain, joint.variable or "")
    s1 = s1 * sign
    return ring.mul(c1, c) - ring.mul(s1, s), ring.mul(s1, c) + ring.mul(c1, s)


def head(chain: Chain) -> Rigid:
    """Where frame {0} of the lecture lies: base, alpha0, a0 and d1 together."""
    ring = chain.ring
    first = chain.robot.joints[0]
    slide = chain.constants.length(ring, offset(first.d or _NONE, first)[1])
    return chain.base.then(ring, Rigid(identity(ring), (ring.zero, ring.zero, slide)))


def measured(chain: Chain) -> Vector:
    """P in the lecture's frame {0}, from the pose of the end effector."""
    ring = chain.ring
    columns = [tuple(ring[f"{column}_{row}"] for row in "xyz") for column in "uvwp"]
    away = chain.joints[-1].after.inverse(ring).translation
    point = tuple(
        ring.reduce(columns[3][i] + sum((columns[k][i] * away[k] for k in range(3)), ring.zero)) for i in range(3)
    )
    x, y, z = head(chain).inverse(ring).apply(ring, point)
    return x, y, z


def state_wrist_point(draft: Draft) -> WristPoint:
    """State P, f and g."""
    chain, ring = draft.chain, draft.ring
    rows = chain.robot.joints
    names = {name: draft.fresh(name) for name in ("f1", "f2", "f3", "g1", "g2", "g3", "k1", "k2", "k3", "k4", "r", "z")}
    words = Words(ring, tuple(names.values()))
    before, turn = ", ".join(f"`{row.variable}`" for row in rows[3:5]), rows[5].variable
    draft.say(
        f"In Craig's convention, the last three axes meeting, the origins of frames 4, 5 and 6 are one point `P`, "
        f"which {before} and `{turn}` do not move. From the pose of the end effector:"
    )
    position = tuple(
        draft.define(draft.fresh(f"P_{row}"), draft.tree(entry))
        for row, entry in zip("xyz", measured(chain), strict=True)
    )
    if head(chain) != Rigid.unit(ring):
        draft.say(
            "Frame 0 is laid so that `alpha0 = a0 = d1 = 0`; what the table has of them, and its base, is taken "
            "off `P`."
        )
    first = Rigid(turn_z(ring, *turned(chain, rows[0])), (ring.zero,) * 3)
    second, third, fourth = (link_transform(chain, rows[i], i + 1) for i in (1, 2, 3))
    tip = fourth.translation
    for name, link in (("T_0_1", first), ("T_1_2", second), ("T_2_3", third)):
        draft.name_matrix(name, _matrix(draft, link))
        draft.state(name, Product((Factor(name),)), _matrix(draft, link))
    homogeneous = Matrix((*((entry,) for entry in position), (ONE,)))
    draft.name_matrix("P_0_O4", homogeneous)
    point = Matrix((*((draft.tree(entry),) for entry in tip), (ONE,)))
    chainlinks = (Factor("T_0_1"), Factor("T_1_2"), Factor("T_2_3"))
    draft.state("point", Product((Factor("P_0_O4"),)), Product((*chainlinks, point)))
    f = third.apply(ring, tip)
    draft.say("From the inside out, `f = T_2_3 P_3_O4`:")
    for i in range(3):
        draft.define(names[f"f{i + 1}"], draft.tree(f[i]))
    inner = tuple(words[names[f"f{i + 1}"]] if f[i] else words.zero for i in range(3))
    rotation = tuple(tuple(map(words.lift, row)) for row in second.rotation)
    g = Rigid(rotation, tuple(map(words.lift, second.translation))).apply(words, inner)  # type: ignore[arg-type]
    draft.say("Then `g = T_1_2 f`:")
    for i in range(3):
        draft.define(names[f"g{i + 1}"], nested(words, g[i]))
    c1, s1 = (draft.tree(part) for part in turned(chain, rows[0]))
    g1, g2, g3 = (Sym(names[f"g{i}"]) for i in (1, 2, 3))
    column = Matrix(
        ((sub(mul(c1, g1), mul(s1, g2)),), (add(mul(s1, g1), mul(c1, g2)),), (g3,), (ONE,)),
    )
    draft.state("point.g", Product((Factor("P_0_O4"),)), column)
    return WristPoint(words, f, names, g, position)  # type: ignore[arg-type]


def _matrix(draft: Draft, link: Rigid) -> Matrix:
    rows = tuple(
        (*map(draft.tree, line), draft.tree(moved)) for line, moved in zip(link.rotation, link.translation, strict=True)
    )
    zero, one = draft.tree(draft.ring.zero), ONE
    return Matrix((*rows, (zero, zero, zero, one)))


def needs_shoulder(chain: Chain, method: str) -> None:
    """Raise :class:`DoesNotApply` unless joints 1 and 2 turn; joint 3 may slide."""
    for number, joint in enumerate(chain.robot.moving[:2], start=1):
        if joint.kind == "P":
            raise DoesNotApply(
                f"{method} does not apply to {chain.robot.name}: joint {number} slides, and the lecture finds theta2 "
                f"and theta1 from r, z and P after joint 3."
            )
