"""Reduction to a polynomial by u = tan(theta/2) (lecture, slide 55).

Of a robot's closed form these are the equations that hold one angle: a c + b s = e, which becomes quadratic in u, and
the squares of two equations in two angles, added so that one goes out, which become a polynomial of degree four.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from sympy import Integer

from kinsym.algebra.nested import nested
from kinsym.algebra.tree import Call, PlusMinus, Sym, Tree, symbols
from kinsym.errors import DoesNotApply
from kinsym.inverse.plan import Definition, Plan, Step, Window
from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import NO_LIMIT
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.from_plan import give_tangents
from kinsym.methods.quartic import state_in_angle, state_in_length
from kinsym.methods.steps import AngleOf, Written, half_angle
from kinsym.methods.tables import unlocked
from kinsym.methods.words import Words
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Convention, Joint, Robot

NAME, TITLE = "half_angle", "Reduction to a polynomial"
LINEAR = ("linear", "linear_pole")
RULES = (*LINEAR, "quartic")


def reduction(robot: Robot) -> MethodDerivation:
    """Each equation ``a c + b s = e`` of the robot's closed form as a polynomial in the tangent of half its angle.

    Raises :class:`DoesNotApply` where no step of the closed form has that shape.
    """
    robot = unlocked(robot)
    chain = build_chain(robot)
    plan = derive_plan(chain, robot.task or fitting_task(chain, chain), NO_LIMIT)
    if not any(step.rule in RULES for step in plan.steps):
        raise DoesNotApply(
            f"{TITLE} does not apply to {robot.name}: no step of its closed form is one equation a c + b s = e, or "
            f"squares added."
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
    draft.say("Of an equation that is linear in cosine and sine of `theta`,")
    half_angle(draft, Written(angle.name, angle.cosine, angle.sine), Sym("a"), Sym("b"), right)
    return draft.done()


def _state(draft: Draft, plan: Plan) -> None:
    """The quantities that lead to each such equation, and its polynomial."""
    give_tangents(draft, plan)
    last = max(number for number, item in enumerate(plan.items) if isinstance(item, Step) and item.rule in RULES)
    after = dict(pairwise(step.unknown for step in plan.steps))
    for item in plan.items[: last + 1]:
        match item:
            case Window():
                for definition in item.definitions:
                    draft.define(definition.name, definition.value)
            case Definition():
                if item.name not in draft.witnesses[0].angles and item.name not in draft.witnesses[0].numbers:
                    draft.define(item.name, item.value)
            case Step():
                _state_step(draft, item, after.get(item.unknown, ""))


def _state_step(draft: Draft, step: Step, following: str) -> None:
    """One step, and the polynomial it makes; ``following`` is what the step behind it finds."""
    if step.rule not in RULES:
        for definition in step.coefficients:
            draft.define(definition.name, definition.value)
        draft.say(f"With `{step.unknown}` known,")
        return
    linear = step.rule in LINEAR
    draft.say(f"{'One equation holds' if linear else 'Two equations hold'} `{step.unknown}`:")
    for number, part in enumerate(step.equations[: 1 if linear else 2], start=1):
        draft.state(f"{step.unknown}.from{number}", part.lhs, part.rhs)
    for definition in step.coefficients:
        draft.define(definition.name, definition.value)
    c, s = step.outputs[:2]
    if step.rule == "quartic":
        _state_quartic(draft, AngleOf(step.unknown, c, s), step, following)
        return
    half_angle(draft, AngleOf(step.unknown, c, s), *_coefficients(step))


def _state_quartic(draft: Draft, angle: AngleOf, step: Step, following: str) -> None:
    """The squares of two equations, added, as a polynomial of degree four: in u, or in the length that follows."""
    (statement,) = [value for name, value in step.solution if name == "0"][:1]
    sliding = angle.cosine not in symbols(statement)
    unknown = following if sliding else angle.name
    draft.say(f"Squared and added they hold `{unknown}` alone:")
    draft.state(f"{unknown}.squares", draft.tree(draft.ring.zero), statement)
    names = dict.fromkeys(symbols(statement))
    words = Words(draft.ring, [name for name in names if name not in draft.ring])
    names_of = (following,) if sliding else (angle.cosine, angle.sine)
    parts = words.collect(words.of_tree(statement), names_of)
    trees = {key: nested(words, part) for key, part in parts.items()}
    draft.say("Multiplied out this is")
    if sliding:
        state_in_length(draft, following, trees)
    else:
        state_in_angle(draft, angle, trees)


def _coefficients(step: Step) -> tuple[Tree, Tree, Tree]:
    """a, b and e of a step whose solution is Atan2(b, a) ± Atan2(root, e)."""
    match step.solution[0][1]:
        case PlusMinus(Call("atan2", (b, a)), Call("atan2", (_, e))):
            return a, b, e
        case formula:
            raise TypeError(f"{formula} is no solution of a c + b s = e")
