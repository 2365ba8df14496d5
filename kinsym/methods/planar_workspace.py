"""The workspace of two parallel axes that turn, in closed form (lecture, slide 50).

The lecture states the disc and the ring; here they follow from

    r^2 - (l1 - l2)^2 = 2 l1 l2 (1 + c2)    and    (l1 + l2)^2 - r^2 = 2 l1 l2 (1 - c2),

proved of the robot's own chain, as both right sides are never negative.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly, fraction
from kinsym.algebra.tree import ONE, ZERO, Call, PlusMinus, Pow, Quot, Sum, Sym, Tree, add, mul, sub
from kinsym.errors import DoesNotApply
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.planar import PlanarArm, give_end, planar_arm
from kinsym.methods.steps import square
from kinsym.robot.model import Robot

NAME, TITLE = "workspace", "Workspace of a planar arm with two turning joints"


@dataclass(frozen=True, kw_only=True)
class Case:
    """What the arm reaches under one relation of its lengths.

    ``relation`` reads ``l1 = l2`` or ``l1 != l2``; radii are measured from axis 1. ``border`` holds each radius of the
    border with the number of solutions there, all of which are double roots in theta2.
    """

    relation: tuple[Tree, str, Tree]
    shape: Literal["disc", "ring"]
    inner: Tree
    outer: Tree
    dexterous: Literal["origin", "empty"]
    border: tuple[tuple[Tree, int], ...]


def closed(robot: Robot) -> tuple[Case, ...]:
    """The cases that the lengths leave open: both if they are symbols, one if they are equal or both numbers.

    Raises :class:`DoesNotApply` for any other arm.
    """
    arm = _two_links(robot)
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    l1, l2 = (draft.tree(vector[0]) for vector in arm.vectors[1:])
    outer = add(l1, l2)
    disc = Case(
        relation=(l1, "=", l2),
        shape="disc",
        inner=ZERO,
        outer=outer,
        dexterous="origin",
        border=((outer, 1),),
    )
    inner: Tree = Call("abs", (sub(l1, l2),))
    annulus = Case(
        relation=(l1, "!=", l2),
        shape="ring",
        inner=inner,
        outer=outer,
        dexterous="empty",
        border=((inner, 1), (outer, 1)),
    )
    equal = _equal(arm)
    return (disc, annulus) if equal is None else (disc if equal else annulus,)


def _equal(arm: PlanarArm) -> bool | None:
    """Whether both links have one length; None where a parameter without a value decides."""
    first, second = (_value(arm, vector[0]) for vector in arm.vectors[1:])
    if arm.vectors[1][0] == arm.vectors[2][0]:
        return True
    return None if first is None or second is None else first == second


def _value(arm: PlanarArm, length: Poly) -> Fraction | None:
    """A length in numbers, where the table or its parameters have them."""
    ring, parameters = arm.chain.ring, arm.chain.robot.parameters
    total = Fraction(0)
    for monomial, coefficient in length.terms():
        term = fraction(coefficient)
        for generator, exponent in zip(ring.generators, monomial, strict=True):
            value = parameters.get(generator.name) if exponent else Fraction(1)
            if value is None:
                return None
            term *= value**exponent
        total += term
    return total


def workspace(robot: Robot) -> MethodDerivation:
    """The closed workspace of a planar RR arm, derived step by step.

    Raises :class:`DoesNotApply` for any other arm.
    """
    arm = _two_links(robot)
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    x, y, _ = give_end(draft, arm, ("x", "y", "z"))
    l1, l2 = (draft.tree(vector[0]) for vector in arm.vectors[1:])
    c2, s2 = (draft.tree(part) for part in arm.chain.turn(arm.group.index, 1, 2))
    joint = arm.group.nodes[1][0]
    draft.say("The square of the distance from axis 1 to the end effector,")
    away = add(square(x), square(y))
    product = mul(number(2), l1, l2)
    draft.state("distance", away, add(square(l1), square(l2), mul(product, c2)))
    draft.say("differs from those of the folded and of the stretched arm by")
    draft.state("folded", sub(away, square(_bracket(l1, l2))), mul(product, Sum((ONE, c2))))
    draft.state("stretched", sub(square(add(l1, l2)), away), mul(product, sub(ONE, c2)))
    draft.say(
        "Neither is ever negative, lengths being positive, and between both every value of the cosine has an angle. So "
        "the reachable workspace is the ring"
    )
    distance = Call("sqrt", (away,))
    near = draft.conclude("reachable.near", Call("abs", (sub(l1, l2),)), "<=", distance)
    far = draft.conclude("reachable.far", distance, "<=", add(l1, l2))
    cosine = Quot(sub(away, add(square(l1), square(l2))), product)
    draft.solve(joint, PlusMinus(None, Call("acos", (cosine,))), branches=2, conditions=(near, far))
    draft.say("The two solutions differ in the sign of the sine, whose square is by {folded} and {stretched}")
    draft.state(
        "border",
        Pow(mul(product, s2), 2),
        mul(sub(away, square(_bracket(l1, l2))), sub(square(add(l1, l2)), away)),
    )
    draft.say(
        "which vanishes on both borders of the ring: there the two are one double solution. On the inner border the "
        "arm is folded, and the end effector is at"
    )
    _state_folded(draft, arm, l1, l2)
    draft.say(_conclusion(arm, draft))
    return draft.done()


def _bracket(l1: Tree, l2: Tree) -> Tree:
    return sub(l1, l2)


def _state_folded(draft: Draft, arm: PlanarArm, l1: Tree, l2: Tree) -> None:
    """The folded arm, c2 = -1 and s2 = 0: proved with those put into the forward kinematics."""
    (c2, s2), (c1, s1) = (arm.chain.turn(arm.group.index, *ends) for ends in ((1, 2), (0, 1)))
    ring = draft.ring
    first, second = arm.vectors[1][0], arm.vectors[2][0]
    for name, own, other, sign in (("x", c1, s1, -1), ("y", s1, c1, 1)):
        # The second link by the sum of its angles, expanded, with the values of the folded arm.
        expanded = first * own + second * (own * c2 + sign * other * s2)
        names = (ring.used(c2)[0], ring.used(s2)[0])
        folded = ring.zero
        for (power, sines), part in ring.collect(expanded, names).items():
            folded += part * (-1) ** power if not sines else ring.zero
        symbol = draft.give(draft.fresh(f"{name}_folded"), ring.reduce(folded))
        draft.state(f"folded.{name}", symbol, mul(sub(l1, l2), draft.tree(own)))


def _conclusion(arm: PlanarArm, draft: Draft) -> str:
    names = [joint.variable for joint in arm.chain.joints]
    l1, l2 = ("L1", "L2")
    trees = [draft.tree(vector[0]) for vector in arm.vectors[1:]]
    if all(isinstance(tree, Sym) for tree in trees):
        l1, l2 = (tree.name for tree in trees if isinstance(tree, Sym))
    equal = _equal(arm)
    disc = (
        f"the ring is a disc, and the folded arm is at the origin for every `{names[0]}`, so that the end effector "
        f"takes every angle there: the dexterous workspace is the origin, and the border is the outer circle alone"
    )
    ring = (
        "a point has at most two solutions, hence at most two angles of the end effector: the dexterous workspace is "
        "empty"
    )
    if equal:
        return f"The links have one length: {disc}."
    if equal is False:
        return f"The links have different lengths: {ring}."
    return f"If `{l1} = {l2}`, {disc}. If `{l1} != {l2}`, {ring}."


def _two_links(robot: Robot) -> PlanarArm:
    arm = planar_arm(robot, TITLE)
    kinds = [joint.kind for joint in arm.chain.joints]
    if kinds != ["R", "R"]:
        raise DoesNotApply(
            f"{TITLE} does not apply to {robot.name}: its joints are {' '.join(kinds)}. The workspace of other arms is "
            f"evaluated: kinsym.workspace.reachable."
        )
    if any(arm.vectors[0][:2]) or any(vector[1] for vector in arm.vectors[1:]):
        raise DoesNotApply(f"{TITLE} does not apply to {robot.name}: its links are not straight.")
    for place, vector in enumerate(arm.vectors[1:], start=1):
        length = _value(arm, vector[0])
        if length is not None and length <= 0:
            raise DoesNotApply(
                f"{TITLE} does not apply to {robot.name}: link {place} has the length {length}, which is not positive."
            )
    return arm
