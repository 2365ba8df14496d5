"""A spherical wrist by Z-Y-Z Euler angles (lecture, slides 25, 26 and 58).

    R_Z(phi) R_Y(eta) R_Z(psi) C = R_4_6,

C a constant rotation, fits every wrist whose neighbouring axes are at right angles: phi, eta and psi are theta4, theta5
and theta6 up to a sign and quarter turns.
"""

from __future__ import annotations

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Rotation, apply, identity, matmul, transpose
from kinsym.algebra.tree import (
    ZERO,
    Call,
    PlusMinus,
    Pow,
    Prod,
    Quot,
    Sum,
    Sym,
    Tree,
    add,
    mul,
    opposite,
    sub,
)
from kinsym.errors import DoesNotApply
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.forward import own_angle
from kinsym.kinematics.links import turn_z
from kinsym.methods.document import TRANSPOSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.euler_fit import Fit, Turn, fitted
from kinsym.methods.steps import AngleOf, Row, one_row, two_rows
from kinsym.methods.tables import craig_table, needs_wrist, unlocked
from kinsym.methods.wrist_point import angle_of
from kinsym.robot.model import Robot

NAME, TITLE = "zyz", "Wrist by Z-Y-Z Euler angles"
_METHOD = "the wrist by Z-Y-Z Euler angles"


def zyz(robot: Robot) -> MethodDerivation:
    """The last three joints of a spherical wrist, or all three of a wrist alone, from its rotation.

    Raises :class:`DoesNotApply` where axes do not meet, or neighbours are not at right angles.
    """
    robot = unlocked(robot)
    needs_wrist(robot, _METHOD, alone=True)
    chain = build_chain(craig_table(robot))
    draft = Draft(chain, method=NAME, title=TITLE)
    if not state_wrist_of(draft):
        raise DoesNotApply(f"{_METHOD} does not apply to {robot.name}: {_not_square(chain)}.")
    return draft.done()


def state_wrist_of(draft: Draft) -> bool:
    """The three last angles from the rotation that the joints before leave to them; False if not by Z-Y-Z angles."""
    chain, ring = draft.chain, draft.ring
    count = len(chain.joints)
    first, last = count - 3, count
    label = f"R_{first}_{last}"
    before = f"R_0_{first}"
    whole = f"R_0_{last}"
    for i in (first, first + 1):
        if chain.joints[i].after.rotation[2][2] in (ring.one, -ring.one):
            raise DoesNotApply(
                f"{_METHOD} does not apply to {chain.robot.name}: axes {chain.numbers[i]} and {chain.numbers[i + 1]} "
                f"are parallel."
            )
    wrist = _rotation(chain, first, last)
    fit = fitted(ring, wrist, [own_angle(chain, joint.variable) for joint in chain.joints[first:]])
    head = _rotation(chain, 0, first, base=True)
    tail = transpose(chain.joints[-1].after.rotation)
    pose = transpose(tuple(tuple(ring[f"{column}_{row}"] for row in "xyz") for column in "uvw"))  # type: ignore[arg-type]
    target = tuple(tuple(ring.dot(line, column) for column in zip(*tail, strict=True)) for line in pose)
    for name, rotation in ((before, head), (whole, target)):
        draft.name_matrix(name, _matrix(draft, rotation))  # type: ignore[arg-type]
    moved = first or chain.base.rotation != identity(ring)
    seen = (
        f" seen from frame {first} at `{chain.joints[first].variable} = 0`, where the joints before it are known"
        if moved
        else ""
    )
    draft.say(f"What the wrist has to turn by is the rotation of the end effector{seen}:")
    reduced = Product((Factor(before, TRANSPOSE), Factor(whole)) if moved else (Factor(whole),))
    draft.name_matrix(label, reduced)
    if moved:
        draft.state(label, Product((Factor(label),)), reduced)
    entries = tuple(tuple(draft.fresh(f"r{i}{j}") for j in (1, 2, 3)) for i in (1, 2, 3))
    for witness in draft.witnesses:
        for names, values in zip(entries, witness.matrices[label], strict=True):
            witness.numbers.update(zip(names, values, strict=True))
    known = Matrix(tuple(tuple(Sym(name) for name in row) for row in entries))
    draft.state(f"{label}.joints", known, _matrix(draft, wrist))
    joints = [joint.variable for joint in chain.joints[first:]]
    if fit is None:
        _solve_skew(draft, wrist, entries, joints)
    else:
        _solve(draft, fit, entries, joints)
    return fit is not None


def _solve(draft: Draft, fit: Fit, entries: tuple[tuple[str, ...], ...], joints: list[str]) -> None:
    """The Euler angles from the entries, and the joints from these."""
    names = [draft.fresh(name) for name in ("phi", "eta", "psi")]
    draft.say("Its axes are at right angles, so that it is a product of Z-Y-Z Euler angles, with")
    phi, eta, psi = (
        draft.define_angle(name, turn.tree(joint)) for name, turn, joint in zip(names, fit.turns, joints, strict=True)
    )
    back = transpose(fit.behind)
    x = [[_entry(entries, back, i, j) for j in range(3)] for i in range(3)]
    pattern = (
        (
            sub(mul(cos(phi), cos(eta), cos(psi)), mul(sin(phi), sin(psi))),
            sub(opposite(mul(cos(phi), cos(eta), sin(psi))), mul(sin(phi), cos(psi))),
            mul(cos(phi), sin(eta)),
        ),
        (
            add(mul(sin(phi), cos(eta), cos(psi)), mul(cos(phi), sin(psi))),
            sub(mul(cos(phi), cos(psi)), mul(sin(phi), cos(eta), sin(psi))),
            mul(sin(phi), sin(eta)),
        ),
        (opposite(mul(sin(eta), cos(psi))), mul(sin(eta), sin(psi)), cos(eta)),
    )
    draft.state("zyz", Matrix(tuple(map(tuple, x))), Matrix(pattern))
    across = add(Pow(_unsigned(x[2][0]), 2), Pow(_unsigned(x[2][1]), 2))
    draft.say("The last column and the last row give, for either sign of the root,")
    root = PlusMinus(None, Call("sqrt", (across,)))
    draft.state("eta.root", sin(eta), root)
    draft.state("eta.solution", eta, Call("atan2", (root, x[2][2])))
    draft.solve(joints[1], _put(fit.turns[1], Call("atan2", (root, x[2][2]))), branches=2)
    regular = draft.require("wrist.regular", sin(eta), "!=", ZERO)
    turns = (
        (joints[0], fit.turns[0], Call("atan2", (Quot(x[1][2], sin(eta)), Quot(x[0][2], sin(eta))))),
        (joints[2], fit.turns[2], Call("atan2", (Quot(x[2][1], sin(eta)), Quot(opposite(x[2][0]), sin(eta))))),
    )
    for joint, turn, value in turns:
        draft.solve(joint, _put(turn, value), branches=1, conditions=(regular,))
    draft.say(
        f"Where {{wrist.regular}} fails axes {draft.chain.numbers[-3]} and {draft.chain.numbers[-1]} are one line, and "
        f"only a sum or difference of `{joints[0]}` and `{joints[2]}` is known."
    )


def _solve_skew(draft: Draft, wrist: Rotation, entries: tuple[tuple[str, ...], ...], joints: list[str]) -> None:
    """Axes that are not at right angles: theta5 from the last entry, its neighbours from the last column and row."""
    ring = draft.ring
    first, middle, last = (angle_of(draft.chain, joint) for joint in joints)

    def row(angle: AngleOf, i: int, j: int) -> Row:
        parts = ring.collect(wrist[i][j], (angle.cosine, angle.sine))
        a, b, rest = (parts.get(key, ring.zero) for key in ((1, 0), (0, 1), (0, 0)))
        return Row(a, b, sub(Sym(entries[i][j]), draft.tree(rest)))

    draft.say(f"Neighbouring axes are not at right angles. The last entry holds `{middle.name}` alone,")
    one_row(draft, ring, middle, row(middle, 2, 2))
    draft.say(f"the last column `{first.name}` beside it, the last row `{last.name}`:")
    two_rows(draft, ring, first, row(first, 0, 2), row(first, 1, 2))
    two_rows(draft, ring, last, row(last, 2, 0), row(last, 2, 1))


def cos(angle: Tree) -> Tree:
    """The cosine of an angle, written out."""
    return Call("cos", (angle,))


def sin(angle: Tree) -> Tree:
    """The sine of an angle, written out."""
    return Call("sin", (angle,))


def _entry(entries: tuple[tuple[str, ...], ...], back: Rotation, i: int, j: int) -> Tree:
    """Entry (i, j) of R_4_6 C^-1; C holds one 1 or -1 a row."""
    k = next(k for k in range(3) if back[k][j])
    name = Sym(entries[i][k])
    return name if back[k][j].coeff(1) > 0 else opposite(name)


def _unsigned(tree: Tree) -> Tree:
    return opposite(tree) if isinstance(tree, Prod) else tree


def _put(turn: Turn, value: Tree) -> Tree:
    """The joint, with a formula in place of its Euler angle."""
    back = turn.back(Sym("angle"))
    return _replaced(back, value)


def _replaced(tree: Tree, value: Tree) -> Tree:
    if tree == Sym("angle"):
        return value
    if tree == opposite(Sym("angle")):
        return opposite(value)
    return add(*(_replaced(term, value) for term in tree.terms)) if isinstance(tree, Sum) else tree


def _matrix(draft: Draft, rotation: Rotation) -> Matrix:
    return Matrix(tuple(tuple(nested(draft.ring, entry) for entry in row) for row in rotation))


def _rotation(chain: Chain, first: int, last: int, *, base: bool = False) -> Rotation:
    """The rotation of some joints; the constant behind the last of them belongs to it if it comes from the base."""
    ring = chain.ring
    total = chain.base.rotation if base else identity(ring)
    for position in range(first, last):
        joint = chain.joints[position]
        if joint.kind == "R":
            c, s = own_angle(chain, joint.variable)
            total = matmul(ring, total, turn_z(ring, c, s * joint.sign))
        if base or position < last - 1:
            total = matmul(ring, total, joint.after.rotation)
    return total


def _not_square(chain: Chain) -> str:
    """Which neighbouring axes of the wrist are not at right angles."""
    ring, first = chain.ring, len(chain.joints) - 3
    numbers = chain.numbers
    skew = [
        f"axes {numbers[i]} and {numbers[i + 1]}"
        for i in (first, first + 1)
        if apply(ring, chain.joints[i].after.rotation, (ring.zero, ring.zero, ring.one))[2]
    ]
    return f"{' and '.join(skew)} are not at right angles" if skew else "its offsets are no quarter turns"
