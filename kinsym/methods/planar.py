"""Arms whose axes are all parallel: link vectors in a plane (lecture, slides 7, 16, 52 to 54)."""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.algebra.nested import number
from kinsym.algebra.ring import Poly, Vector, apply, transpose
from kinsym.algebra.tree import Pi, Quot, Sym, Tree, add, mul, opposite
from kinsym.errors import DoesNotApply
from kinsym.inverse.state import COLUMNS
from kinsym.kinematics.chain import Chain, Group, build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.draft import Draft
from kinsym.methods.tables import unlocked
from kinsym.robot.model import Robot

#: Cosine and sine of a quarter turn, half a turn and three quarters, beside the angle.
_QUARTERS: tuple[tuple[int, int, Tree], ...] = (
    (1, 0, number(0)),
    (0, 1, Quot(Pi(), number(2))),
    (-1, 0, Pi()),
    (0, -1, opposite(Quot(Pi(), number(2)))),
)


@dataclass(frozen=True)
class PlanarArm:
    """One group of parallel axes with all joints in it; ``oriented`` tells that its task gives the angle as well."""

    chain: Chain
    group: Group
    oriented: bool

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """The link vectors by node, each in the frame that its node turns."""
        return self.group.arms

    def angle(self, node: int) -> Tree:
        """The angle of a node as the sum of joint angles."""
        return add(*(mul(number(sign), Sym(name)) for name, sign in self.group.nodes[:node]))

    def measured(self) -> tuple[Poly, Poly, Poly]:
        """The end effector in the plane of the arm, from the pose."""
        ring = self.chain.ring
        point = (ring["p_x"], ring["p_y"], ring["p_z"])
        x, y, z = self.chain.base.inverse(ring).apply(ring, point)
        return x, y, z

    def direction(self) -> tuple[Poly, Poly]:
        """Cosine and sine of the angle of the end effector's x axis in the plane of the arm, from the pose."""
        ring = self.chain.ring
        x, y, _ = apply(ring, transpose(self.chain.base.rotation), (ring["u_x"], ring["u_y"], ring["u_z"]))
        return x, y

    def offset(self) -> Tree | None:
        """The constant part of the angle of the end effector; None if it is no multiple of a quarter turn."""
        ring = self.chain.ring
        x, y = self.group.turned[0][0], self.group.turned[1][0]
        return next((angle for c, s, angle in _QUARTERS if (x, y) == (ring.number(c), ring.number(s))), None)


def planar_arm(robot: Robot, method: str) -> PlanarArm:
    """The arm in a plane.

    Raises :class:`DoesNotApply` with two axes that are not parallel.
    """
    chain = build_chain(unlocked(robot))
    if len(chain.groups) > 1:
        first, second = (chain.numbers[group.joints[0]] for group in chain.groups[:2])
        raise DoesNotApply(
            f"{method} does not apply to {robot.name}: axes {first} and {second} are not parallel, so the arm does not "
            f"move in a plane."
        )
    if not any(joint.kind == "R" for joint in chain.joints):
        raise DoesNotApply(f"{method} does not apply to {robot.name}: no joint of it turns.")
    task = robot.task or fitting_task(chain, chain)
    return PlanarArm(chain, chain.groups[0].whole(chain.ring), "uvw" in COLUMNS[task])


def give_end(draft: Draft, arm: PlanarArm, names: tuple[str, str, str] = ("x_E", "y_E", "z_E")) -> tuple[Sym, ...]:
    """The coordinates of the end effector under names of their own."""
    return tuple(draft.give(draft.fresh(name), entry) for name, entry in zip(names, arm.measured(), strict=True))


def give_angle(draft: Draft, arm: PlanarArm, name: str) -> Sym | None:
    """The angle of the end effector, if the task gives it; it is not printed."""
    if not arm.oriented or arm.offset() is None:
        return None
    symbol = draft.fresh(name)
    x, y = arm.direction()
    for witness in draft.witnesses:
        witness.angles[symbol] = (draft.ring.evaluate(x, witness.numbers), draft.ring.evaluate(y, witness.numbers))
    return Sym(symbol)


def total_angle(arm: PlanarArm) -> Tree:
    """The angle of the end effector as the sum of joint angles."""
    shift = arm.offset()
    joints = arm.angle(arm.group.last)
    return joints if shift is None or shift == number(0) else add(joints, shift)
