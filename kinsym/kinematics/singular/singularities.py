"""The singular set: det J as a product of factors, and what it means when one of them vanishes.

At a singular posture the joints move the end effector in fewer ways than elsewhere. J is square where a task asks for
as many velocities as there are joints, and det J tells. Where a task asks for more, the conditions are those factors of
a largest minor at whose zeros the rank of J really falls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from kinsym.algebra.factors import Factored
from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import determinant
from kinsym.algebra.nested import nested
from kinsym.algebra.tree import Pow, Tree, mul
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.conditions import Arm, Condition, condition
from kinsym.kinematics.singular.double_conditions import double_conditions
from kinsym.kinematics.singular.given import given_conditions
from kinsym.kinematics.singular.minors import largest_minors, sparsest_jacobian
from kinsym.kinematics.singular.posture import Posture
from kinsym.kinematics.singular.zeros import parts
from kinsym.robot.model import Task


@dataclass(frozen=True, kw_only=True)
class SingularSet:
    """The singular postures of an arm for its task.

    ``square`` tells that det J equals ``constant`` times the product of the conditions' powers; the rows of J are those
    of the task, for position and one axis J has the turn about that axis as its last column. Otherwise the task asks
    for more than the joints can move, and the conditions are where the rank of J falls.
    ``exhaustive`` tells that there is no singular posture without one of the conditions, ``split`` that no factor can
    be split further. Without conditions ``missing`` says why none is known; it is empty where the arm has none.
    ``given`` are factors of ``constant`` that depend on locked joints alone: where one is zero every posture is
    singular.
    """

    task: Task
    square: bool
    constant: Tree
    conditions: tuple[Condition, ...]
    exhaustive: bool
    split: bool
    missing: str = ""
    given: tuple[Condition, ...] = ()

    @property
    def listed(self) -> tuple[Condition, ...]:
        """The conditions on the joints that move, then those on the values of locked ones."""
        return *self.conditions, *self.given

    @property
    def determinant(self) -> Tree:
        """The product, constant first."""
        return mul(
            self.constant,
            *(part.values[0] if part.power == 1 else Pow(part.values[0], part.power) for part in self.conditions),
        )


def singular_set(chain: Chain, task: Task) -> SingularSet:
    """The singular set of a chain for a task; in bounded time, so that a factor may be left unsplit or none be found.

    >>> from kinsym.kinematics.chain import build_chain
    >>> from kinsym.robot import load
    >>> found = singular_set(build_chain(load("puma560")), Task.POSE)
    >>> [(condition.meaning.name, *condition.polys) for condition in found.conditions]
    [('wrist', s5), ('elbow', c3*d4 + s3*a3), ('shoulder', c2*a2 + c23*a3 - s23*d4)]
    """
    ring = chain.ring
    arm = Arm(chain, task)
    ordinary = arm.ordinary[0]
    if arm.loses(ordinary):
        return _unknown(chain, task, "the joints can move without moving the end effector, at every posture")
    base = [row for row in ordinary.jacobian(task) if any(row)]
    rows = sparsest_jacobian(chain, task)
    square = len(rows) == len(rows[0]) and (task is Task.POSITION_AXIS or len(base) == len(rows))
    minors = largest_minors(chain, rows)
    product = next(minors, None)
    if product is None:
        return _unknown(chain, task, "the determinant of the Jacobian has too many terms to look for factors")
    constant = product.constant
    if square and task is not Task.POSITION_AXIS:
        constant = constant * _sign(determinant(base), _value(chain, product, ordinary))
    found = list(_conditions(arm, product))
    kept = {poly for one in found for poly in one.polys}
    lost = [poly for poly, _ in product.factors if poly not in kept]
    doubled, exhaustive = double_conditions(arm, lost, found, minors) if lost else ([], True)
    return SingularSet(
        task=task,
        square=square and not lost,
        constant=nested(ring, constant),
        conditions=(*found, *doubled),
        exhaustive=exhaustive and all(one.whole for one in found),
        split=product.complete,
        given=tuple(given_conditions(arm, product.fixed, square=square and not lost)),
    )


def _unknown(chain: Chain, task: Task, reason: str) -> SingularSet:
    one = nested(chain.ring, chain.ring.one)
    return SingularSet(
        task=task, square=False, constant=one, conditions=(), exhaustive=False, split=False, missing=reason
    )


def _conditions(arm: Arm, product: Factored) -> Iterator[Condition]:
    """The factors at whose zeros the rank of J falls, short ones first."""
    for poly, power in product.factors:
        found = condition(arm, [(part,) for part in parts(arm.chain, poly)])
        if found is not None:
            yield replace(found, power=power)


def _sign(base: int, value: int) -> int:
    """1, or -1 where the plane of an arm is seen from its other side because rows of zeros were left out."""
    if base not in (value, -value % PRIME):
        raise ArithmeticError("the factors do not multiply to the determinant of the Jacobian")
    return 1 if base == value else -1


def _value(chain: Chain, product: Factored, posture: Posture) -> int:
    """The product at one posture, modulo the prime."""
    value = chain.ring.evaluate(product.constant, posture.values)
    for poly, power in product.factors:
        value = value * pow(chain.ring.evaluate(poly, posture.values), power, PRIME) % PRIME
    return value
