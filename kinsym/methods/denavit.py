"""Forward kinematics by link transforms, Craig's or Paul's (lecture, slides 9 to 32)."""

from __future__ import annotations

from sympy import Expr

from kinsym.algebra.tree import ONE, ZERO, Sym, Tree
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.forward import forward_kinematics, link_transform
from kinsym.kinematics.links import Rigid
from kinsym.methods.document import INVERSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.tables import craig_table, unlocked
from kinsym.robot.model import Convention, Robot

CRAIG, PAUL = "craig", "paul"
CRAIG_TITLE, PAUL_TITLE = "Craig's link transforms", "Paul's link transforms"
_ORDER = {
    Convention.CRAIG: "a turn by `alpha` and a slide by `a` along `x` of frame `i-1`, then a turn by `theta` and a "
    "slide by `d` along `z` of frame `i`",
    Convention.PAUL: "a slide by `d` and a turn by `theta` about `z` of frame `i-1`, then a slide by `a` and a turn "
    "by `alpha` about `x` of frame `i`",
}


def craig(robot: Robot) -> MethodDerivation:
    """Link transforms, their inverses, their product and its entries in Craig's convention.

    Raises :class:`kinsym.errors.RobotError` where the table cannot be written exactly.
    """
    return _links(craig_table(unlocked(robot)), CRAIG, CRAIG_TITLE)


def paul(robot: Robot) -> MethodDerivation:
    """The same in Paul's convention."""
    robot = unlocked(robot)
    table = robot if robot.convention is Convention.PAUL else convert(robot, Convention.PAUL)
    return _links(table, PAUL, PAUL_TITLE)


def _links(robot: Robot, method: str, title: str) -> MethodDerivation:
    chain = build_chain(robot)
    draft = Draft(chain, method=method, title=title)
    draft.say(f"Row `i` of the table leads from frame `i-1` to frame `i`: {_ORDER[robot.convention]}.")
    names = []
    for number, joint in enumerate(robot.joints, start=1):
        name = f"T_{number - 1}_{number}"
        names.append(name)
        transform = link_transform(chain, joint, number)
        draft.name_matrix(name, _matrix(draft, transform))
        draft.state(name, Product((Factor(name),)), _matrix(draft, transform))
    draft.say("Their inverses:")
    for number, (joint, name) in enumerate(zip(robot.joints, names, strict=True), start=1):
        back = link_transform(chain, joint, number).inverse(chain.ring)
        draft.state(f"{name}.inverse", Product((Factor(name, INVERSE),)), _matrix(draft, back))
    _state_product(draft, chain, names)
    return draft.done()


def _state_product(draft: Draft, chain: Chain, names: list[str]) -> None:
    """The loop closure, and the entries of the pose."""
    whole = f"T_0_{len(names)}"
    robot = chain.robot
    pose = forward_kinematics(chain).pose
    draft.name_matrix(whole, Matrix(pose))
    if len(names) > 1:
        draft.say("The loop closure, base and tool left out:" if robot.base or robot.tool else "The loop closure:")
        draft.state(whole, Product((Factor(whole),)), Product(tuple(map(Factor, names))))
    draft.state(f"{whole}.entries", Product((Factor(whole),)), Matrix(pose))
    if robot.base is not None or robot.tool is not None:
        _state_ends(draft, robot, whole)
        return
    draft.say("Entry by entry, with the columns `u`, `v`, `w` and `p`:")
    for column, letter in enumerate("uvwp"):
        for row, axis in enumerate("xyz"):
            draft.state(f"{letter}_{axis}", Sym(f"{letter}_{axis}"), pose[row][column])


def _state_ends(draft: Draft, robot: Robot, whole: str) -> None:
    """The pose with base and tool around the product."""
    factors = []
    for name, fixed in (("T_B_0", robot.base), (whole, None), ("T_W_T", robot.tool)):
        if name == whole:
            factors.append(Factor(whole))
        elif fixed is not None:
            rows = tuple(tuple(_cell(draft, cell) for cell in line) for line in fixed)
            draft.name_matrix(name, Matrix(rows))
            draft.state(name, Product((Factor(name),)), Matrix(rows))
            factors.append(Factor(name))
    columns = [[Sym(f"{letter}_{axis}") for axis in "xyz"] for letter in "uvwp"]
    pose = Matrix((*(tuple(column[row] for column in columns) for row in range(3)), (ZERO, ZERO, ZERO, ONE)))
    draft.state("pose", pose, Product(tuple(factors)))


def _cell(draft: Draft, cell: Expr) -> Tree:
    """A cell of a fixed transform, through the chain's constants so that it has a value in the field."""
    chain = draft.chain
    poly = chain.constants.length(chain.ring, cell)
    return draft.tree(poly)


def _matrix(draft: Draft, transform: Rigid) -> Matrix:
    rows = tuple(
        (*map(draft.tree, line), draft.tree(moved))
        for line, moved in zip(transform.rotation, transform.translation, strict=True)
    )
    return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))
