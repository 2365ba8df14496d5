"""The algebraic (trigonometric) solution (lecture, slides 52 and 53).

For two or three parallel axes that turn it is written as the lecture does: the wrist point, squares, kappa, Delta. For
any other arm it is the closed form that :mod:`kinsym.inverse` finds, each of its equations proved once more.
"""

from __future__ import annotations

from kinsym.algebra.ring import Poly
from kinsym.algebra.tree import Call, Sym, Tree, add, mul, sub
from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.from_plan import state_plan
from kinsym.methods.planar import PlanarArm, give_angle, give_end, planar_arm, total_angle
from kinsym.methods.steps import AngleOf
from kinsym.methods.tables import unlocked
from kinsym.methods.two_links import TwoLinks, solve_two_links
from kinsym.robot.model import Robot

NAME, TITLE = "algebraic", "Algebraic solution"
POINTS = 24
"""More points than usual: those at which a root of the plan is not in the field are given up."""


def algebraic(robot: Robot) -> MethodDerivation:
    """The algebraic solution of a robot in closed form.

    Raises :class:`kinsym.errors.NoClosedForm` with what is left where there is none.
    """
    robot = unlocked(robot)
    chain = build_chain(robot)
    if len(chain.groups) == 1 and [joint.kind for joint in chain.joints] in (["R"] * 2, ["R"] * 3):
        arm = planar_arm(robot, TITLE)
        if is_straight(arm):
            return _planar(arm)
    draft = Draft(chain, method=NAME, title=TITLE, points=POINTS)
    state_plan(draft, derive_plan(chain, robot.task or fitting_task(chain, chain), NO_LIMIT))
    return draft.done()


def is_straight(arm: PlanarArm) -> bool:
    """Whether the arm is two links along their own x axes, with a third in the same plane if it has one."""
    links, last = arm.vectors[1:3], arm.vectors[-1]
    straight = all(vector[0] and not vector[1] for vector in links) and not any(arm.vectors[0][:2])
    return straight and (len(arm.vectors) == 3 or (arm.oriented and arm.offset() is not None and not last[1]))


def _planar(arm: PlanarArm) -> MethodDerivation:
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    links, known = wrist_of_plane(draft, arm, ("p_x", "p_y"))
    point = "P" if len(arm.vectors) == 4 else "the end effector"
    draft.say(f"The distance from the origin to {point} does not depend on the first angle, so squares are added:")
    solve_two_links(draft, links, known, kappa="kappa", determinant="Delta")
    state_last(draft, arm)
    return draft.done()


def wrist_of_plane(draft: Draft, arm: PlanarArm, names: tuple[str, str]) -> tuple[TwoLinks, tuple[Tree, Tree]]:
    """The end of the second link, from the end effector and by the joints."""
    chain = arm.chain
    whole = len(arm.vectors) == 3
    x, y, _ = give_end(draft, arm, (*names, "z_E") if whole and names[0] == "x" else ("x_E", "y_E", "z_E"))
    joints = [AngleOf(angle.name, angle.cosine, angle.sine) for angle in _single(arm)]
    turns = [chain.turn(arm.group.index, 0, node) for node in range(1, len(arm.vectors))]
    known: tuple[Tree, Tree] = (x, y)
    rows = [add(*(mul(draft.tree(v[0]), draft.tree(t[k])) for v, t in _pairs(arm, turns))) for k in (0, 1)]
    draft.say("The forward kinematics in the plane of the arm:")
    for name, row, symbol in zip("xy", rows, (x, y), strict=True):
        draft.state(f"fk.{name}", row, symbol)
    if len(arm.vectors) == 4:
        phi = give_angle(draft, arm, "phi")
        if phi is not None:
            draft.state("fk.phi", phi, total_angle(arm))
            last = draft.tree(arm.vectors[3][0])
            angle = sub(phi, arm.offset() or draft.tree(draft.ring.zero))
            draft.say("With phi known so is P, the end of link 2:")
            parts = (sub(x, mul(last, Call("cos", (angle,)))), sub(y, mul(last, Call("sin", (angle,)))))
            known = tuple(  # type: ignore[assignment]
                draft.define(name, part, name=f"{name}.from_E") for name, part in zip(names, parts, strict=True)
            )
    short = [add(*(mul(draft.tree(v[0]), draft.tree(t[k])) for v, t in _pairs(arm, turns)[:2])) for k in (0, 1)]
    if len(arm.vectors) == 4:
        for row, point in zip(short, known, strict=True):
            draft.state(f"{_name(point)}.joints", point, row)
    zero: Poly = draft.ring.zero
    sign = arm.group.nodes[0][1]
    links = TwoLinks(
        (arm.vectors[1][0], zero),
        (arm.vectors[2][0], zero),
        joints[1],
        chain.turn(arm.group.index, 1, 2),
        joints[0],
        sign,
    )
    return links, known


def state_last(draft: Draft, arm: PlanarArm) -> None:
    """The third angle as what is left of the angle of the end effector."""
    if len(arm.vectors) < 4:
        return
    nodes = arm.group.nodes
    phi = Sym("phi")
    rest = sub(phi, arm.offset() or draft.tree(draft.ring.zero))
    for name, sign in nodes[:2]:
        rest = sub(rest, mul(draft.tree(draft.ring.number(sign)), Sym(name)))
    draft.solve(nodes[2][0], mul(draft.tree(draft.ring.number(nodes[2][1])), rest), branches=1)


def _name(tree: Tree) -> str:
    return tree.name if isinstance(tree, Sym) else "p"


def _pairs(arm: PlanarArm, turns: list[tuple[Poly, Poly]]) -> list[tuple[tuple[Poly, Poly, Poly], tuple[Poly, Poly]]]:
    return list(zip(arm.vectors[1:], turns, strict=True))


def _single(arm: PlanarArm) -> list[AngleOf]:
    found = (arm.chain.angles[arm.group.index, node, node + 1] for node in range(arm.group.last))
    return [AngleOf(angle.name, angle.cosine, angle.sine) for angle in found]
