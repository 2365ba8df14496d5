"""Two straight links in a plane, and the end of the second: where the algebraic and the geometric solution begin."""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.tree import Call, Sym, Tree, add, mul, sub
from kinsym.methods.draft import Draft
from kinsym.methods.planar import PlanarArm, give_angle, give_end, total_angle
from kinsym.methods.steps import AngleOf
from kinsym.methods.two_links import TwoLinks


@dataclass(frozen=True)
class PlanarLinks:
    """The links, the end of the second, known, and the angle of the end effector, None without a third link."""

    links: TwoLinks
    point: tuple[Tree, Tree]
    angle: Sym | None


def is_straight(arm: PlanarArm) -> bool:
    """Whether the arm is two links along their own x axes, with a third in the same plane if it has one."""
    links, last = arm.vectors[1:3], arm.vectors[-1]
    straight = all(vector[0] and not vector[1] for vector in links) and not any(arm.vectors[0][:2])
    return straight and (len(arm.vectors) == 3 or (arm.oriented and arm.offset() is not None and not last[1]))


def state_links(draft: Draft, arm: PlanarArm, names: tuple[str, str]) -> PlanarLinks:
    """State the forward kinematics and the end of the second link; ``names`` are what its coordinates are called."""
    three = len(arm.vectors) == 4
    x, y, _ = give_end(draft, arm, ("x_E", "y_E", "z_E") if three or names[0] == "p_x" else (*names, "z_E"))
    draft.say("The forward kinematics in the plane of the arm:")
    for name, row, symbol in zip("xy", _rows(draft, arm, len(arm.vectors)), (x, y), strict=True):
        draft.state(f"fk.{name}", row, symbol)
    angle = give_angle(draft, arm, "phi") if three else None
    point: tuple[Tree, Tree] = (x, y)
    if angle is not None:
        draft.state("fk.phi", angle, total_angle(arm))
        point = _end_of_second(draft, arm, (x, y), angle, names)
    joints = [arm.chain.angles[arm.group.index, node, node + 1] for node in (0, 1)]
    first, second = (AngleOf(joint.name, joint.cosine, joint.sine) for joint in joints)
    zero = draft.ring.zero
    l1, l2 = ((vector[0], zero) for vector in arm.vectors[1:3])
    turn = arm.chain.turn(arm.group.index, 1, 2)
    return PlanarLinks(TwoLinks(l1, l2, second, turn, first, arm.group.nodes[0][1]), point, angle)


def _end_of_second(
    draft: Draft, arm: PlanarArm, end: tuple[Tree, Tree], phi: Sym, names: tuple[str, str]
) -> tuple[Tree, Tree]:
    """The end of link 2, from the end effector and its angle and by the joints."""
    draft.say(f"With `{phi.name}` known so is `P`, the end of link 2:")
    length = draft.tree(arm.vectors[3][0])
    angle = _less_offset(arm, phi)
    found: list[Tree] = []
    for name, whole, function in zip(names, end, ("cos", "sin"), strict=True):
        # p_x and p_y mean the end effector elsewhere, which is x_E and y_E here.
        symbol = name if name in ("p_x", "p_y") else draft.fresh(name)
        part = sub(whole, mul(length, Call(function, (angle,))))
        found.append(draft.define(symbol, part, name=f"{name}.from_E"))
    for name, point, row in zip(names, found, _rows(draft, arm, 3), strict=True):
        draft.state(f"{name}.joints", point, row)
    return found[0], found[1]


def _rows(draft: Draft, arm: PlanarArm, count: int) -> tuple[Tree, Tree]:
    """The x and the y coordinate of the end of the last of ``count`` link vectors, by the joints."""
    turns = [arm.chain.turn(arm.group.index, 0, node) for node in range(1, count)]
    parts = [
        (draft.tree(v[0]), draft.tree(c), draft.tree(s)) for v, (c, s) in zip(arm.vectors[1:], turns, strict=False)
    ]
    return add(*(mul(length, c) for length, c, _ in parts)), add(*(mul(length, s) for length, _, s in parts))


def _less_offset(arm: PlanarArm, phi: Sym) -> Tree:
    """The sum of the joint angles: phi less its constant part."""
    shift = arm.offset()
    return phi if shift is None else sub(phi, shift)


def state_last(draft: Draft, arm: PlanarArm, phi: Sym | None) -> None:
    """The third angle as what is left of the angle of the end effector, if there is a third."""
    if phi is None:
        return
    rest = _less_offset(arm, phi)
    signs = [(name, draft.tree(draft.ring.number(sign))) for name, sign in arm.group.nodes]
    for name, sign in signs[:2]:
        rest = sub(rest, mul(sign, Sym(name)))
    last, sign = signs[2]
    draft.solve(last, mul(sign, rest), branches=1)
