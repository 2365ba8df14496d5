"""Forward kinematics by successive screws: T = A_1 ... A_n [u0 v0 w0 q0] (lecture, slides 33 to 45).

A_i is the displacement about the screw of joint i, a unit vector s along the axis and the point s0 of it that is
nearest to the origin (Rodrigues' formula; lecture, slide 34 and 2.65). It is proved against the motion of the chain.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from kinsym.algebra.ring import Poly, Vector
from kinsym.algebra.tree import ONE, ZERO, Call, Pow, Sym, Tree, add, mul, negated, sub
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.forward import link_transform, own_angle
from kinsym.kinematics.links import Rigid
from kinsym.methods.document import TRANSPOSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.proof import Witness
from kinsym.methods.screw_arm import ScrewArm, screw_robot
from kinsym.robot.model import Robot

NAME, TITLE = "screws", "Successive screws, forward"


def screws(robot: Robot) -> MethodDerivation:
    """Forward kinematics of a robot by successive screws.

    Raises :class:`kinsym.errors.RobotError` where the robot's axes cannot be written exactly.
    """
    arm = ScrewArm(build_chain(screw_robot(robot)))
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    state_screws(draft, arm)
    draft.say("The end effector is where these displacements, the last joint's first, move its home pose:")
    everything = range(1, len(arm.chain.joints) + 1)
    state_products(draft, arm)
    home = arm.home
    columns = {"u": home.u0, "v": home.v0, "w": home.w0}
    for column, cells in columns.items():
        state_column(draft, arm, column, tuple(f"R{i}" for i in everything), arm.vector(cells))
    position = tuple(Sym(f"p_{row}") for row in "xyz")
    draft.name_matrix("q", Matrix((*((entry,) for entry in position), (ONE,))))
    draft.name_matrix("q0", _homogeneous(draft, arm.vector(home.q0)))
    factors = (*(Factor(f"A{i}") for i in everything), Factor("q0"))
    draft.state("q", Product((Factor("q"),)), Product(factors))
    moved = arm.moved_point(0, len(arm.chain.joints), arm.vector(home.q0))
    for row, entry in zip("xyz", moved, strict=True):
        symbol = draft.give(draft.fresh(f"q_{row}"), draft.ring[f"p_{row}"])
        draft.state(symbol.name, symbol, draft.tree(entry))
    return draft.done()


def state_column(draft: Draft, arm: ScrewArm, column: str, factors: Sequence[str], home: Vector) -> None:
    """A column of the orientation: R_1 ... R_n of its home direction, and its entries."""
    draft.name_matrix(column, Matrix(tuple((Sym(f"{column}_{row}"),) for row in "xyz")))
    draft.name_matrix(f"{column}0", draft.column(home))
    draft.state(column, Product((Factor(column),)), Product((*map(Factor, factors), Factor(f"{column}0"))))
    moved = arm.moved_direction(0, len(arm.chain.joints), home)
    for row, entry in zip("xyz", moved, strict=True):
        draft.state(f"{column}_{row}", Sym(f"{column}_{row}"), draft.tree(entry))


def _homogeneous(draft: Draft, point: Vector) -> Matrix:
    return Matrix((*((draft.tree(entry),) for entry in point), (ONE,)))


def state_screws(draft: Draft, arm: ScrewArm) -> None:
    """The home pose, the screws, the general displacement and each joint's own."""
    home = arm.home
    draft.say("At the reference pose all joint variables are zero. There the end effector has the axes and the origin")
    for name, cells in (("u0", home.u0), ("v0", home.v0), ("w0", home.w0), ("q0", home.q0)):
        _row(draft, name, arm.vector(cells))
    draft.say("and the joints have the screws, a unit vector along the axis and the point of it nearest to the origin,")
    for number in range(1, len(arm.chain.joints) + 1):
        direction, through = arm.axis(number)
        _row(draft, f"s_{number}", direction)
        _row(draft, f"s0_{number}", _foot(arm, direction, through))
    _state_general(draft, arm)
    draft.say("For the joints of this arm:")
    for number, joint in enumerate(arm.chain.robot.joints, start=1):
        link = link_transform(arm.chain, joint, number)
        draft.state(f"A{number}", Product((Factor(f"A{number}"),)), displacement_matrix(draft, link, joint.variable))


def name_displacements(draft: Draft, arm: ScrewArm) -> None:
    """A_i and R_i under their names, without a word."""
    for number, joint in enumerate(arm.chain.robot.joints, start=1):
        whole = displacement_matrix(draft, link_transform(arm.chain, joint, number), joint.variable)
        draft.name_matrix(f"A{number}", whole)
        draft.name_matrix(f"R{number}", Matrix(tuple(row[:3] for row in whole.rows[:3])))


def displacement_matrix(draft: Draft, link: Rigid, variable: str | None) -> Matrix:
    """A displacement, its moves along circles written as the lecture does: a2 (1 - c3)."""
    rows = tuple(
        (*map(draft.tree, line), versine(draft, moved, variable))
        for line, moved in zip(link.rotation, link.translation, strict=True)
    )
    return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))


def versine(draft: Draft, poly: Poly, variable: str | None) -> Tree:
    """``k (1 - c) + l s`` where the terms without the angle are the opposite of those with its cosine."""
    ring = draft.ring
    if variable is None or variable in ring:
        return draft.tree(poly)
    c, s = (ring.used(part)[0] for part in own_angle(draft.chain, variable))
    parts = ring.collect(poly, (c, s))
    k = parts.get((0, 0))
    if not k or parts.get((1, 0)) != -k:
        return draft.tree(poly)
    rest = draft.tree(parts.get((0, 1), ring.zero))
    return add(mul(draft.tree(k), sub(ONE, Sym(c))), mul(rest, Sym(s)))


def state_products(draft: Draft, arm: ScrewArm) -> None:
    """The products of the displacements of joints whose axes are parallel, where their angles add up."""
    name_displacements(draft, arm)
    starts = arm.starts
    for first, stop in pairwise(starts):
        if stop - first > 1:
            state_product(draft, arm, first, stop)


def state_product(draft: Draft, arm: ScrewArm, first: int, stop: int) -> None:
    """``A_i ... A_k`` as one matrix."""
    ring = arm.chain.ring
    zero, one = ring.zero, ring.one
    units: tuple[Vector, Vector, Vector] = ((one, zero, zero), (zero, one, zero), (zero, zero, one))
    columns = [arm.moved_direction(first, stop, unit) for unit in units]
    columns.append(arm.moved_point(first, stop, (zero, zero, zero)))
    rows = tuple(tuple(draft.tree(column[i]) for column in columns) for i in range(3))
    name = "".join(f"A{i}" for i in range(first + 1, stop + 1))
    factors = tuple(Factor(f"A{i}") for i in range(first + 1, stop + 1))
    draft.state(name, Product(factors), Matrix((*rows, (ZERO, ZERO, ZERO, ONE))))


def _row(draft: Draft, name: str, vector: Vector) -> None:
    """A constant vector, written as a row."""
    row = Matrix((tuple(draft.tree(entry) for entry in vector),))
    draft.name_matrix(name, draft.column(vector))
    draft.state(name, Product((Factor(name, TRANSPOSE),)), row)


def _foot(arm: ScrewArm, direction: Vector, through: Vector) -> Vector:
    ring = arm.chain.ring
    along = ring.dot(direction, through)
    x, y, z = (ring.reduce(p - along * s) for p, s in zip(through, direction, strict=True))
    return x, y, z


def _state_general(draft: Draft, arm: ScrewArm) -> None:
    """The displacement of any screw, proved for every joint of the arm."""
    names = {name: draft.fresh(name) for name in ("theta", "d", *(f"{s}_{x}" for s in ("s", "so") for x in "xyz"))}
    general = general_displacement(names)
    draft.say(
        f"A turn by `{names['theta']}` about a screw and a slide by `{names['d']}` along it move points by a matrix "
        f"`A`, in which `v({names['theta']}) = 1 - cos {names['theta']}`:"
    )
    for number, joint in enumerate(arm.chain.robot.joints, start=1):
        link = displacement_matrix(draft, link_transform(arm.chain, joint, number), joint.variable)
        direction, through = arm.axis(number)
        screw = (direction, _foot(arm, direction, through))
        draft.name_matrix(f"A{number}", link)
        draft.name_matrix("A", link)
        for witness in draft.witnesses:
            _give_screw(draft, witness, names, joint.variable or "", screw)
        draft.check(f"the screw of joint {number}", Product((Factor("A"),)), general)
    draft.state("A", Product((Factor("A"),)), general)


def _give_screw(
    draft: Draft, witness: Witness, names: dict[str, str], variable: str, screw: tuple[Vector, Vector]
) -> None:
    """The general screw's names stand for those of one joint."""
    for letter, vector in zip(("s", "so"), screw, strict=True):
        for row, entry in zip("xyz", vector, strict=True):
            witness.numbers[names[f"{letter}_{row}"]] = draft.ring.evaluate(entry, witness.numbers)
    turns = variable in witness.angles
    witness.angles[names["theta"]] = witness.angles[variable] if turns else (1, 0)
    witness.numbers[names["d"]] = 0 if turns else witness.numbers[variable]


def general_displacement(names: dict[str, str]) -> Matrix:
    """Rodrigues' rotation about s through s0, and d along s (lecture, 2.65)."""
    theta, d = Sym(names["theta"]), Sym(names["d"])
    s = [Sym(names[f"s_{row}"]) for row in "xyz"]
    so = [Sym(names[f"so_{row}"]) for row in "xyz"]
    v, cosine, sine = (Call(function, (theta,)) for function in ("v", "cos", "sin"))
    third = {(0, 1): (-1, 2), (0, 2): (1, 1), (1, 0): (1, 2), (1, 2): (-1, 0), (2, 0): (-1, 1), (2, 1): (1, 0)}

    def entry(i: int, j: int) -> Tree:
        if i == j:
            return add(mul(Pow(s[i], 2), v), cosine)
        sign, k = third[i, j]
        term = mul(s[k], sine)
        return add(mul(s[i], s[j], v), term if sign > 0 else negated(term))

    rows = []
    for i in range(3):
        terms: list[Tree] = [mul(d, s[i])]
        for j in range(3):
            factor = mul(sub(Pow(s[i], 2), ONE), v) if i == j else entry(i, j)
            terms.append(negated(mul(so[j], factor)))
        rows.append((*(entry(i, j) for j in range(3)), add(*terms)))
    return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))
