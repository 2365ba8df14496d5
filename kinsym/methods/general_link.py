"""One link in general: the transform of a row of a table from its four elementary ones (lecture, slides 12 to 15)."""

from __future__ import annotations

from kinsym.algebra.tree import ONE, ZERO, Call, Sym, Tree, replaced
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.elementary import FACTORS, elementary
from kinsym.kinematics.forward import link_transform
from kinsym.kinematics.links import Rigid
from kinsym.methods.document import INVERSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.robot.expressions import symbol
from kinsym.robot.model import Convention, Joint, Robot

NAME = "general_link"
TITLES = {Convention.CRAIG: "A link in Craig's convention", Convention.PAUL: "A link in Paul's convention"}
_BEFORE, _OWN = "im1", "i"
LINK = "T_im1_i"
"""The transform from frame i-1 to frame i, by its name in a derivation."""


def general_link(convention: Convention) -> MethodDerivation:
    """The link transform of a row, its factors and its inverse, with letters for the four cells of the row."""
    index = _BEFORE if convention is Convention.CRAIG else _OWN
    cells = {"alpha": f"alpha_{index}", "a": f"a_{index}", "d": "d_i", "theta": "theta_i"}
    joint = Joint(kind="R", variable="theta_i", **{name: symbol(cell) for name, cell in cells.items()})
    robot = Robot(
        name=f"{convention.value}_link",
        title="",
        convention=convention,
        joints=(joint,),
        parameters={cells[name]: None for name in ("alpha", "a", "d")},
    )
    chain = build_chain(robot)
    draft = Draft(chain, method=NAME, title=TITLES[convention])
    written = _cosines_and_sines(draft, cells)
    draft.say(
        f"Row `i` of a table has the cells {', '.join(f'`{cell}`' for cell in cells.values())}. Its four steps are"
    )
    factors = Product(tuple(_state_step(draft, transform, cells[name]) for transform, name in FACTORS[convention]))
    draft.say(
        "each about or along an axis as the steps before have moved it, so that they are multiplied on the right:"
    )
    draft.name_matrix(LINK, factors)
    draft.state(f"{LINK}.factors", Product((Factor(LINK),)), factors)
    link = link_transform(chain, joint, 1)
    draft.state(LINK, Product((Factor(LINK),)), _matrix(draft, link, written))
    draft.say("Its inverse has the transposed rotation:")
    draft.state(f"{LINK}.inverse", Product((Factor(LINK, INVERSE),)), _matrix(draft, link.inverse(chain.ring), written))
    return draft.done()


def _cosines_and_sines(draft: Draft, cells: dict[str, str]) -> dict[str, Tree]:
    """The chain's names for cosine and sine of both angles, written as functions; the twist becomes an angle."""
    chain = draft.chain
    twist = chain.constants.angle(chain.ring, symbol(cells["alpha"]))
    for witness in draft.witnesses:
        c, s = (chain.ring.evaluate(part, witness.numbers) for part in twist)
        witness.angles[cells["alpha"]] = (c, s)
    turn = chain.angles[0, 0, 1]
    names = {turn.cosine: ("cos", "theta"), turn.sine: ("sin", "theta")}
    for part, function in zip(twist, ("cos", "sin"), strict=True):
        names[chain.ring.used(part)[0]] = (function, "alpha")
    return {name: Call(function, (Sym(cells[cell]),)) for name, (function, cell) in names.items()}


def _state_step(draft: Draft, transform: str, cell: str) -> Factor:
    """One of the four steps, under the name of what it does to which cell."""
    rows = elementary(transform, angle=cell) if transform.startswith("R") else elementary(transform, length=cell)
    factor = Factor(f"{transform}_of_{cell}")
    draft.name_matrix(factor.name, Matrix(rows))
    draft.state(factor.name, Product((factor,)), Matrix(rows))
    return factor


def _matrix(draft: Draft, link: Rigid, written: dict[str, Tree]) -> Matrix:
    rows = tuple(
        tuple(replaced(draft.tree(entry), written) for entry in (*line, moved))
        for line, moved in zip(link.rotation, link.translation, strict=True)
    )
    return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))
