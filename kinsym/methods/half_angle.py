"""Reduction to a polynomial by u = tan(theta/2) (lecture, slide 55).

Of a robot's closed form these are the equations that hold one angle, a c + b s = e, which become quadratic in u, and
Pieper's two equations in two angles, which become a polynomial of degree four (:mod:`kinsym.methods.pieper`).
"""

from __future__ import annotations

from fractions import Fraction

from sympy import Integer

from kinsym.algebra.tree import Sym, Tree
from kinsym.errors import DoesNotApply
from kinsym.inverse.plan import Definition, Plan, Step, Window
from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.steps import AngleOf, Written, half_angle
from kinsym.methods.tables import unlocked
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Convention, Joint, Robot

NAME, TITLE = "half_angle", "Reduction to a polynomial"
RULES = ("linear", "linear_pole")


def reduction(robot: Robot) -> MethodDerivation:
    """Each equation ``a c + b s = e`` of the robot's closed form as a polynomial in the tangent of half its angle.

    Raises :class:`DoesNotApply` where no step of the closed form has that shape.
    """
    robot = unlocked(robot)
    chain = build_chain(robot)
    plan = derive_plan(chain, robot.task or fitting_task(chain, chain), NO_LIMIT)
    if not any(step.rule in RULES for step in plan.steps):
        raise DoesNotApply(
            f"{TITLE} does not apply to {robot.name}: no step of its closed form is one equation a c + b s = e."
        )
    draft = Draft(chain, method=NAME, title=TITLE)
    _state(draft, plan)
    return draft.done()


def general() -> MethodDerivation:
    """The reduction of ``a cos(theta) + b sin(theta) = c``, as the lecture prints it.

    It is proved of a link that turns with its end at (a, -b), whose x coordinate is c.
    """
    zero, one = Integer(0), Integer(1)
    a, b = symbol("a"), symbol("b")
    joint = Joint(kind="R", variable="theta", alpha=zero, a=a, d=zero, theta=symbol("theta"))
    tool = ((one, zero, zero, zero), (zero, one, zero, -b), (zero, zero, one, zero), (zero, zero, zero, one))
    parameters: dict[str, Fraction | None] = {"a": None, "b": None}
    link = Robot(name="link", title="", convention=Convention.PAUL, joints=(joint,), parameters=parameters, tool=tool)
    chain = build_chain(link)
    draft = Draft(chain, method=NAME, title=TITLE)
    right = draft.give("c", chain.ring["p_x"])
    angle = chain.angles[0, 0, 1]
    half_angle(draft, Written(angle.name, angle.cosine, angle.sine), Sym("a"), Sym("b"), right)
    return draft.done()


def _state(draft: Draft, plan: Plan) -> None:
    """The quantities that lead to each such equation, and its polynomial."""
    last = max(number for number, item in enumerate(plan.items) if isinstance(item, Step) and item.rule in RULES)
    for item in plan.items[: last + 1]:
        match item:
            case Window():
                for definition in item.definitions:
                    draft.define(definition.name, definition.value)
            case Definition():
                if item.name not in draft.witnesses[0].angles:
                    draft.define(item.name, item.value)
            case Step():
                _state_step(draft, item)


def _state_step(draft: Draft, step: Step) -> None:
    if step.rule not in RULES:
        for definition in step.coefficients:
            draft.define(definition.name, definition.value)
        draft.say(f"With `{step.unknown}` known,")
        return
    draft.say(f"One equation holds `{step.unknown}` alone:")
    for part in step.equations[:1]:
        draft.state(f"{step.unknown}.from", part.lhs, part.rhs)
    for definition in step.coefficients:
        draft.define(definition.name, definition.value)
    c, s = step.outputs[:2]
    a, b, e = (_input(step, name) for name in ("a", "b", "e"))
    half_angle(draft, AngleOf(step.unknown, c, s), a, b, e)


def _input(step: Step, name: str) -> Tree:
    return step.inputs[name]
