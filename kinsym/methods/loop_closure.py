"""Vector loop closure: the link vectors of an arm in a plane add up to its end effector (lecture, slides 7 and 16)."""

from __future__ import annotations

from kinsym.algebra.ring import Vector
from kinsym.algebra.tree import ZERO, Call, Sym, Tree, add, mul, sub
from kinsym.methods.document import MethodDerivation
from kinsym.methods.draft import Draft
from kinsym.methods.planar import PlanarArm, give_angle, give_end, planar_arm, total_angle
from kinsym.robot.model import Robot

NAME, TITLE = "loop_closure", "Vector loop closure"


def loop_closure(robot: Robot) -> MethodDerivation:
    """Forward kinematics of an arm with parallel axes from its loop of vectors.

    Raises :class:`DoesNotApply` with two axes that are not parallel.
    """
    arm = planar_arm(robot, TITLE)
    draft = Draft(arm.chain, method=NAME, title=TITLE)
    end = give_end(draft, arm)
    draft.say(
        "In the plane of the arm its link vectors, each turned by the joints before it, lead to the end effector:"
    )
    _state_vectors(draft, arm, end)
    angle = give_angle(draft, arm, "Theta_E")
    if angle is not None:
        draft.state("loop.theta", angle, total_angle(arm))
    draft.say("Along `x` and `y` this is")
    for name, symbol, written in zip("xy", end, _rows(draft, arm, written=True), strict=False):
        draft.state(f"loop.{name}", written, symbol)
    draft.say("or, with cosines and sines of sums of angles under names,")
    for definition in _named_angles(draft, arm):
        draft.state(*definition)
    for name, symbol, row in zip("xy", end, _rows(draft, arm, written=False), strict=False):
        draft.state(name, row, symbol)
    height = arm.chain.ring.reduce(sum((vector[2] for vector in arm.vectors), arm.chain.ring.zero))
    if height:
        draft.state("z", draft.tree(height), end[2])
    return draft.done()


def _state_vectors(draft: Draft, arm: PlanarArm, end: tuple[Sym, ...]) -> None:
    """The sum of vectors, proved along x and along y."""
    names = [(node, _vector_name(draft, vector, node)) for node, vector in _links(arm)]
    left = add(*(Sym(name) for _, name in names))
    total = Sym(draft.fresh("chi_vec"))
    for row in (0, 1):
        for witness in draft.witnesses:
            for node, name in names:
                witness.numbers[name] = witness.value(_turned(draft, arm, node, written=False)[row])
            witness.numbers[total.name] = witness.numbers[end[row].name]
        draft.check("the loop of vectors", left, total)
    draft.state("loop.vector", left, total)


def _links(arm: PlanarArm) -> list[tuple[int, Vector]]:
    """The link vectors that are not zero in the plane, with their nodes."""
    return [(node, vector) for node, vector in enumerate(arm.vectors) if vector[0] or vector[1]]


def _vector_name(draft: Draft, vector: Vector, node: int) -> str:
    """Named by its length where that is a symbol: l1_vec."""
    tree = draft.tree(vector[0])
    plain = isinstance(tree, Sym) and not vector[1]
    return draft.fresh(f"{tree.name}_vec" if plain and isinstance(tree, Sym) else f"r{node}_vec")


def _turned(draft: Draft, arm: PlanarArm, node: int, *, written: bool) -> tuple[Tree, Tree]:
    """A link vector in the frame of the plane; ``written`` writes cos(theta1 + theta2) out."""
    x, y = (draft.tree(entry) for entry in arm.vectors[node][:2])
    if not node:
        return x, y
    if written:
        angle = arm.angle(node)
        c: Tree = Call("cos", (angle,))
        s: Tree = Call("sin", (angle,))
    else:
        c, s = (draft.tree(part) for part in arm.chain.turn(arm.group.index, 0, node))
    return sub(mul(x, c), mul(y, s)), add(mul(x, s), mul(y, c))


def _rows(draft: Draft, arm: PlanarArm, *, written: bool) -> tuple[Tree, Tree]:
    turned = [_turned(draft, arm, node, written=written) for node, _ in _links(arm)]
    rows = [add(*(pair[row] for pair in turned if pair[row] != ZERO)) for row in (0, 1)]
    return rows[0], rows[1]


def _named_angles(draft: Draft, arm: PlanarArm) -> list[tuple[str, Sym, Tree]]:
    """What c12 and s12 mean, for the angles that occur."""
    result: list[tuple[str, Sym, Tree]] = []
    for node, _ in _links(arm):
        angle = arm.chain.angles.get((arm.group.index, 0, node))
        if angle is None:
            continue
        total = add(*(mul(draft.tree(draft.ring.number(sign)), Sym(name)) for name, sign in angle.terms))
        result.append((angle.cosine, Sym(angle.cosine), Call("cos", (total,))))
        result.append((angle.sine, Sym(angle.sine), Call("sin", (total,))))
    return result
