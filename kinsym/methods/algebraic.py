"""The algebraic (trigonometric) solution (lecture, slides 52 and 53).

For two or three parallel axes that turn it is written as the lecture does: the wrist point, squares, kappa, Delta. For
any other arm it is the closed form that :mod:`kinsym.inverse` finds, each of its equations proved once more.
"""

from __future__ import annotations

from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import POINTS_FOR_ROOTS, Draft
from kinsym.methods.from_plan import state_plan
from kinsym.methods.planar import PlanarArm, planar_arm
from kinsym.methods.planar_links import is_straight, state_last, state_links
from kinsym.methods.tables import unlocked
from kinsym.methods.two_links import solve_two_links
from kinsym.robot.model import Robot

NAME, TITLE = "algebraic", "Algebraic solution"


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
    draft = Draft(chain, method=NAME, title=TITLE, points=POINTS_FOR_ROOTS)
    state_plan(draft, derive_plan(chain, robot.task or fitting_task(chain, chain), NO_LIMIT))
    return draft.done()


def _planar(arm: PlanarArm) -> MethodDerivation:
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    stated = state_links(draft, arm, ("p_x", "p_y"))
    point = "the end effector" if stated.angle is None else "`P`"
    draft.say(f"The distance from the origin to {point} does not depend on the first angle, so squares are added:")
    solve_two_links(draft, stated.links, stated.point, kappa="kappa", determinant="Delta")
    state_last(draft, arm, stated.angle)
    return draft.done()
