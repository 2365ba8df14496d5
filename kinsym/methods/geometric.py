"""The geometric solution: triangles and the law of cosines (lecture, slide 54).

Two links and the way from the shoulder to the wrist point make a triangle, whose angle at the elbow is pi less the
angle between the links. A solution exists if and only if abs(l1 - l2) <= distance <= l1 + l2; the lecture prints the
right half of that alone.
"""

from __future__ import annotations

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import Call, Pi, PlusMinus, Sym, Tree, add, mul, opposite, sub
from kinsym.errors import DoesNotApply
from kinsym.kinematics.chain import build_chain
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.elbow import solve_elbow
from kinsym.methods.planar import planar_arm
from kinsym.methods.planar_links import is_straight, state_last, state_links
from kinsym.methods.steps import quotient, square
from kinsym.methods.tables import unlocked
from kinsym.methods.two_links import TwoLinks, solve_two_links
from kinsym.robot.model import Robot

NAME, TITLE = "geometric", "Geometric solution"


def geometric(robot: Robot) -> MethodDerivation:
    """The geometric solution of a planar arm with two or three turning joints, or of the elbow of an arm that has one.

    Raises :class:`DoesNotApply` where no two neighbouring axes are parallel, so that there is no triangle.
    """
    robot = unlocked(robot)
    chain = build_chain(robot)
    if len(chain.groups) == 1:
        arm = planar_arm(robot, TITLE)
        if [joint.kind for joint in chain.joints] not in (["R"] * 2, ["R"] * 3) or not is_straight(arm):
            raise DoesNotApply(
                f"{TITLE} does not apply to {robot.name}: it is not two or three straight links that turn."
            )
        draft = Draft(chain, method=NAME, title=TITLE)
        stated = state_links(draft, arm, ("x", "y"))
        draft.say("The origin, the elbow and the end of link 2 are a triangle. By the law of cosines")
        state_triangle(draft, stated.links, *stated.point)
        state_first(draft, stated.links, *stated.point)
        state_last(draft, arm, stated.angle)
        return draft.done()
    return solve_elbow(robot, NAME, TITLE, _triangle_in_space)


def _triangle_in_space(draft: Draft, links: TwoLinks, known: tuple[Tree, Tree]) -> None:
    """The triangle of shoulder, elbow and wrist, its sides straight or bent."""
    if not links.first[1] and len(links.first[0]) == 1 and all(map(_is_one_length, links.second)):
        state_bent(draft, links, *known)
        return
    if links.first[1] or links.second[1] or len(links.first[0]) > 1 or len(links.second[0]) > 1:
        draft.say("One of the links is bent, its parts at right angles; the law of cosines of the triangle:")
        solve_two_links(draft, links, known)
        return
    draft.say("Shoulder, elbow and wrist are a triangle. By the law of cosines")
    state_triangle(draft, links, *known)
    state_first(draft, links, *known)


def _is_one_length(part: Poly) -> bool:
    return len(part) == 1


def state_bent(draft: Draft, links: TwoLinks, x: Tree, y: Tree) -> None:
    """The triangle where the second link is bent: its straight line, and the angle of that to its first part."""
    joint, c, s = links.between.name, *(draft.tree(part) for part in links.turn)
    l1, along, across = (draft.tree(part) for part in (links.first[0], *links.second))
    draft.say(
        "The second link is bent. The straight line from the elbow to the wrist has a length and stands at an angle to "
        "the link's first part:"
    )
    l2 = draft.define(draft.fresh("l"), Call("sqrt", (add(square(along), square(across)),)))
    delta = draft.define_angle(draft.fresh("delta"), Call("atan2", (across, along)))
    _scale(draft, delta, l2)
    turned: Tree = Sym(joint) if links.turn[1] == draft.ring[links.between.sine] else opposite(Sym(joint))
    sides = add(square(l1), square(l2))
    away = add(square(x), square(y))
    draft.say("Shoulder, elbow and wrist are a triangle with this line as a side. By the law of cosines")
    inner = Call("cos", (sub(Pi(), add(turned, delta)),))
    draft.state("cosines", away, sub(sides, mul(number(2), l1, l2, inner)))
    value = quotient(sub(away, sides), mul(number(2), l1, l2))
    draft.state(f"{joint}.c", Call("cos", (add(turned, delta),)), value)
    near = draft.require("exists.near", Call("abs", (sub(l1, l2),)), "<=", Call("sqrt", (away,)))
    far = draft.require("exists.far", Call("sqrt", (away,)), "<=", add(l1, l2))
    before = opposite(delta) if turned == Sym(joint) else delta
    draft.solve(joint, PlusMinus(before, Call("acos", (value,))), branches=2, conditions=(near, far))
    base, height = add(l1, sub(mul(along, c), mul(across, s))), add(mul(along, s), mul(across, c))
    _state_shoulder(draft, links, (x, y), Call("atan2", (height, base)))


def _scale(draft: Draft, angle: Sym, length: Sym) -> None:
    """A direction as the cosine and sine of the angle."""
    for witness in draft.witnesses:
        cosine, sine = witness.angles[angle.name]
        shorter = inverse(witness.numbers[length.name])
        witness.angles[angle.name] = (cosine * shorter % PRIME, sine * shorter % PRIME)


def state_triangle(draft: Draft, links: TwoLinks, x: Tree, y: Tree) -> None:
    """The law of cosines, the angle at the elbow, and when there is a triangle."""
    l1, l2 = draft.tree(links.first[0]), draft.tree(links.second[0])
    inner = Call("cos", (sub(Pi(), Sym(links.between.name)),))
    away = add(square(x), square(y))
    sides = add(square(l1), square(l2))
    draft.state("cosines", away, sub(sides, mul(number(2), l1, l2, inner)))
    draft.state("supplement", inner, mul(number(-1), links.between.c))
    value = quotient(sub(away, sides), mul(number(2), l1, l2))
    draft.state(f"{links.between.name}.c", links.between.c, value)
    distance = Call("sqrt", (away,))
    near = draft.require("exists.near", Call("abs", (sub(l1, l2),)), "<=", distance)
    far = draft.require("exists.far", distance, "<=", add(l1, l2))
    draft.solve(links.between.name, PlusMinus(None, Call("acos", (value,))), branches=2, conditions=(near, far))


def state_first(draft: Draft, links: TwoLinks, x: Tree, y: Tree) -> None:
    """The first angle: the direction of the wrist less the angle of the triangle at the shoulder."""
    l1, l2 = draft.tree(links.first[0]), draft.tree(links.second[0])
    c, s = (draft.tree(part) for part in links.turn)
    _state_shoulder(draft, links, (x, y), Call("atan2", (mul(l2, s), add(l1, mul(l2, c)))))


def _state_shoulder(draft: Draft, links: TwoLinks, known: tuple[Tree, Tree], corner: Tree) -> None:
    x, y = known
    draft.say("The direction of the wrist, and the angle of the triangle at the shoulder:")
    beta = draft.define_angle(draft.fresh("beta"), Call("atan2", (y, x)))
    psi = draft.define_angle(draft.fresh("psi"), corner)
    inside = draft.require(f"{links.x.name}.unique", add(square(x), square(y)), "!=", number(0))
    value = sub(beta, psi)
    draft.solve(links.x.name, value if links.flip > 0 else sub(psi, beta), branches=1, conditions=(inside,))
