"""The elbow of an arm in space: two links that turn about parallel axes, in a plane that the joints before them choose.

The wrist point is seen in that plane; the triangle of shoulder, elbow and wrist gives the angle at the elbow by the law
of cosines, its corner at the shoulder the angle before it. A link that is bent (a3 and d4) may have a length that is a
root, which has a value at half of the points at which a statement is proved.
"""

from __future__ import annotations

from collections.abc import Callable

from kinsym.algebra.tree import Tree
from kinsym.errors import DoesNotApply
from kinsym.inverse.state import COLUMNS
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import POINTS_FOR_ROOTS, Draft
from kinsym.methods.screw_arm import screw_robot, wrist_of
from kinsym.methods.screws_inverse import ScrewWork
from kinsym.methods.two_links import TwoLinks
from kinsym.robot.model import Robot

Links = Callable[[Draft, TwoLinks, tuple[Tree, Tree]], None]


def solve_elbow(robot: Robot, method: str, title: str, triangle: Links) -> MethodDerivation:
    """The joints that lead to the wrist, with the elbow by ``triangle``.

    Raises :class:`DoesNotApply` where the arm has no two links in a plane.
    """
    whole = build_chain(robot)
    table = screw_robot(robot)
    columns = COLUMNS[robot.task or fitting_task(whole, whole)]
    wrist = wrist_of(table, columns)
    draft = Draft(wrist.arm.chain, method=method, title=title, points=POINTS_FOR_ROOTS)
    found: list[TwoLinks] = []

    def once(draft: Draft, links: TwoLinks, known: tuple[Tree, Tree]) -> None:
        found.append(links)
        triangle(draft, links, known)

    work = ScrewWork(draft, wrist, columns, matrices=False)
    work.solver.links = once
    work.begin()
    work.solve_position()
    if not found:
        work.solve_orientation()
    if not found:
        raise DoesNotApply(
            f"{title} does not apply to {robot.name}: it has no elbow, two links that turn about parallel axes and "
            f"carry a point that the other joints leave alone."
        )
    if work.solver.unknown:
        draft.say("What is left turns the end effector about the wrist.")
    return draft.done()
