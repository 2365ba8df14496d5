"""The plan of a general six-joint arm: which loop is cut where; all the rest is the same for every arm.

The arm is T = B M1(q1) L1 M2(q2) L2 ... M6(q6) L6, where Mi turns about or slides along the local z axis by
``sign * q``. With G = L6 T^-1 B in the place of L6 it is a closed loop of six joints, M1 L1 M2 L2 ... M6 G = I.

A *cut* opens the loop behind the joint that is dropped and goes round it, forward or backward, as
N0 K0 N1 K1 N2 K2 N3 K3 N4 K4 N5 K5 = I with N5 the dropped joint:

    forward,  e dropped   Nk = M_{e+1+k},       Kk = L_{e+1+k}         (numbers modulo 6 in 1..6, L6 means G)
    backward, e dropped   Nk = M_{e-1-k}^-1,    Kk = L_{e-2-k}^-1

N2 is suppressed: its angle is the unknown of the polynomial. Of N3 and N4 one is *x*, whose half-angle monomials
X^2, X, 1 make the square system (d^2, d, 1 if it slides), the other is *y*: x is N3, or N4 if ``shift``. N1, N0 are
eliminated linearly, the dropped joint comes last.

An arm with two sliding joints has no such cut; ``suppressed`` then names the revolute joints from which to go round
(orientation alone: four angles), best first.

Solutions are sorted by theta1, then theta2 and so on, each rounded to a multiple of 1e-6 (lengths in units of the
scale), so that rounding errors in coordinates that agree by symmetry do not decide the order.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kinsym.algebra.tree import Tree
from kinsym.inverse.plan import Nonzero
from kinsym.robot.model import Task


@dataclass(frozen=True, kw_only=True)
class Cut:
    """One way to open the loop; see the head of the module.

    ``bordered`` tells that the matrix loses two ranks at every root instead of one, because the arm is symmetric
    to its own mirror image; its determinant is then replaced by that of the matrix with one more row and column.
    """

    dropped: int
    backward: bool
    shift: bool
    bordered: bool

    @staticmethod
    def before(suppressed: int) -> Cut:
        """The cut that goes forward and suppresses a joint.

        >>> Cut.before(4).suppressed
        4
        """
        return Cut(dropped=(suppressed - 4) % 6 + 1, backward=False, shift=False, bordered=False)

    @property
    def order(self) -> tuple[int, ...]:
        """The joints N0 .. N5 by their numbers 1..6.

        >>> Cut(dropped=5, backward=False, shift=False, bordered=True).order
        (6, 1, 2, 3, 4, 5)
        """
        step = -1 if self.backward else 1
        return tuple((self.dropped - 1 + step * (k + 1)) % 6 + 1 for k in range(6))

    @property
    def links(self) -> tuple[int, ...]:
        """The numbers 1..6 of the links K0 .. K5, of which 6 is G; backward they are inverted.

        >>> Cut(dropped=2, backward=True, shift=False, bordered=False).links
        (6, 5, 4, 3, 2, 1)
        """
        return tuple((number - 2) % 6 + 1 for number in self.order) if self.backward else self.order

    @property
    def suppressed(self) -> int:
        """The joint whose angle is the unknown of the polynomial."""
        return self.order[2]


@dataclass(frozen=True, kw_only=True)
class Link:
    """The constant transform after a joint, over parameters and named constants: rotation rows and translation."""

    rotation: tuple[tuple[Tree, ...], ...]
    translation: tuple[Tree, ...]

    @property
    def entries(self) -> tuple[Tree, ...]:
        """The twelve entries: rotation row by row, then the translation."""
        return (*(entry for row in self.rotation for entry in row), *self.translation)

    @property
    def places(self) -> tuple[tuple[tuple[int, int], Tree], ...]:
        """The same with their row and column in a 3 x 4 matrix."""
        rows = zip(self.rotation, self.translation, strict=True)
        return tuple(((i, j), value) for i, (row, p) in enumerate(rows) for j, value in enumerate((*row, p)))


@dataclass(frozen=True, kw_only=True)
class GeneralPlan:
    """The inverse kinematics of a six-joint arm without a closed form.

    kinds       one letter a joint, for example ``"RRPRRR"``.
    signs       +1 or -1: how the joint variable enters its motion.
    base        B.
    links       L1 .. L6.
    cuts        the best and, where there is one, a second that drops or goes round otherwise; empty for two sliding
                joints.
    suppressed  for two sliding joints the revolute joints to go round from, best first; empty otherwise.
    virtual     the sixth joint is no joint of the robot: it turns the tool about an axis through its origin and is left
                out of the answer. The axis is the tool's own, and the task leaves the turn open, or there is a gate.
    gate        the task fixes more than the joints can choose: of the solutions with the sixth joint those count in
                which it stands still, in the end with the robot's own joints alone.
    maximum     the largest number of solutions.
    nonzero, size, tau   as in :class:`kinsym.inverse.plan.Plan`.
    why         why there is no closed form.
    """

    task: Task
    kinds: str
    signs: tuple[int, ...]
    base: Link
    links: tuple[Link, ...]
    cuts: tuple[Cut, ...]
    suppressed: tuple[int, ...] = ()
    virtual: bool = False
    gate: bool = False
    maximum: int = 16
    nonzero: tuple[Nonzero, ...] = ()
    size: Tree
    tau: Fraction = Fraction(1, 2**46)
    why: str

    @property
    def spin(self) -> bool:
        """Whether the task leaves the turn of the sixth joint open."""
        return self.virtual and not self.gate

    @property
    def transforms(self) -> tuple[Link, ...]:
        """B, L1 .. L6."""
        return (self.base, *self.links)
