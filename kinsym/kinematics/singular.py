"""The singular set: det J as a product of factors, and what it means when one of them vanishes.

At a singular posture the joints move the end effector in fewer ways than elsewhere. J is square where a task asks for
as many velocities as there are joints, and det J tells. Where a task asks for more, the conditions are those factors of
a largest minor at whose zeros the rank of J really falls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations

from kinsym.algebra.determinant import Rows, block_determinants, expansion
from kinsym.algebra.factors import Factored, factored
from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import determinant
from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Kind, Poly, fraction
from kinsym.algebra.tree import Pow, Tree, mul
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.conditions import Arm, Condition, condition
from kinsym.kinematics.corners import corners
from kinsym.kinematics.posture import Posture
from kinsym.kinematics.screws import View, columns, views
from kinsym.kinematics.trees import shortest
from kinsym.kinematics.zeros import parts
from kinsym.robot.model import Task

#: Views of the chain that are tried: those in which its axes and points are shortest.
VIEWS = 2
#: A determinant whose expansion has more terms is not computed: its time would not be bounded.
WORK = 4000


@dataclass(frozen=True, kw_only=True)
class SingularSet:
    """The singular postures of an arm for its task.

    ``square`` tells that det J equals ``constant`` times the product of the conditions' powers; the rows of J are those
    of the task, for position and one axis J has the turn about that axis as its last column. Otherwise the task asks
    for more than the joints can move, and the conditions are where the rank of J falls.
    ``exhaustive`` tells that there is no singular posture without one of the conditions, ``split`` that no factor can
    be split further. Without conditions ``missing`` says why none is known; it is empty where the arm has none.
    """

    task: Task
    square: bool
    constant: Tree
    conditions: tuple[Condition, ...]
    exhaustive: bool
    split: bool
    missing: str = ""

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
    rows = min(_matrices(chain, task), key=lambda rows: (len(rows), _work(rows)))
    square = len(rows) == len(rows[0]) and (task is Task.POSITION_AXIS or len(base) == len(rows))
    minors = _products(chain, rows)
    product = next(minors, None)
    if product is None:
        return _unknown(chain, task, "the determinant of the Jacobian has too many terms to look for factors")
    constant = product.constant
    if square and task is not Task.POSITION_AXIS:
        constant = constant * _sign(determinant(base), _value(chain, product, ordinary))
    found = list(_conditions(arm, product))
    kept = {poly for one in found for poly in one.polys}
    lost = [poly for poly, _ in product.factors if poly not in kept]
    at_corners, exhaustive = corners(arm, lost, kept, minors) if lost else ([], True)
    return SingularSet(
        task=task,
        square=square and not lost,
        constant=nested(ring, constant),
        conditions=(*found, *at_corners),
        exhaustive=exhaustive and all(one.whole for one in found),
        split=product.complete,
    )


def _unknown(chain: Chain, task: Task, reason: str) -> SingularSet:
    one = nested(chain.ring, chain.ring.one)
    return SingularSet(
        task=task, square=False, constant=one, conditions=(), exhaustive=False, split=False, missing=reason
    )


def _matrices(chain: Chain, task: Task) -> Iterator[Rows]:
    """The Jacobian of the task in several frames, rows of zeros left out."""
    for view in sorted(views(chain), key=lambda view: view.terms)[:VIEWS]:
        points = [view.end] if task in (Task.POSITION, Task.POSITION_AXIS) else view.points
        for point in points:
            yield _rows(chain, task, view, point)


def _rows(chain: Chain, task: Task, view: View, point: tuple[Poly, Poly, Poly]) -> Rows:
    ring = chain.ring
    found = columns(ring, view.screws, point)
    if task is Task.POSITION_AXIS:
        found.append((ring.zero, ring.zero, ring.zero, *view.approach))
    rows = [list(row) for row in zip(*found, strict=True)]
    if task is Task.POSITION:
        rows = rows[:3]
    if task is Task.ORIENTATION:
        rows = rows[3:]
    return [row for row in rows if any(row)]


def _work(rows: Rows) -> int:
    """The number of terms of the shortest largest minor that has any."""
    count = len(rows[0])
    return min(filter(None, (expansion(list(chosen)) for chosen in combinations(rows, count))), default=0)


def _products(chain: Chain, rows: Rows) -> Iterator[Factored]:
    """The factors of every largest minor that is not zero, short ones first, as far as their work is bounded."""
    minors = sorted((list(chosen) for chosen in combinations(rows, len(rows[0]))), key=expansion)
    for minor in minors:
        if expansion(minor) <= WORK and all(blocks := block_determinants(chain.ring, minor)):
            yield _written(chain, blocks)


def _conditions(arm: Arm, product: Factored) -> Iterator[Condition]:
    """The factors at whose zeros the rank of J falls, short ones first."""
    for poly, power in product.factors:
        found = condition(arm, [(part,) for part in parts(arm.chain, poly)])
        if found is not None:
            yield replace(found, power=power)


def _order(chain: Chain, poly: Poly) -> list[int]:
    """Later joints first, as a wrist stands before an elbow."""
    return [-chain.ring.index[name] for name in chain.ring.used(poly)]


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


def _written(chain: Chain, blocks: list[Poly]) -> Factored:
    """The factors of a product in the sums of angles that make them short, the shortest factor first."""
    product = _in_lengths(chain, factored(chain.ring, [shortest(chain, block) for block in blocks]))
    factors = [(shortest(chain, poly), power) for poly, power in product.factors]
    factors.sort(key=lambda factor: (len(factor[0]), _order(chain, factor[0])))
    return replace(product, factors=tuple(factors))


def _in_lengths(chain: Chain, product: Factored) -> Factored:
    """The factors in cosines and sines alone with the lengths of the table as coefficients."""
    lengths = {
        abs(fraction(entry.LC))
        for joint in chain.joints
        for entry in joint.after.translation
        if entry and entry.is_ground
    }
    ring = chain.ring
    constant, factors = product.constant, []
    for poly, power in product.factors:
        numbers = [abs(fraction(value)) for value in poly.itercoeffs()]
        plain = all(ring.generators[ring.index[name]].kind in (Kind.COSINE, Kind.SINE) for name in ring.used(poly))
        scale = _scale(numbers, lengths) if plain and len(poly) > 1 else Fraction(1)
        factors.append((poly * ring.number(scale), power))
        constant = constant * ring.number((1 / scale) ** power)
    return replace(product, constant=constant, factors=tuple(factors))


def _scale(coefficients: list[Fraction], lengths: set[Fraction]) -> Fraction:
    """The factor that makes the most coefficients lengths of the table; 1 if that is fewer than two."""
    best, most = Fraction(1), 1
    for length in sorted(lengths):
        for coefficient in coefficients:
            scale = length / coefficient
            count = sum(value * scale in lengths for value in coefficients)
            if count > most:
                best, most = scale, count
    return best
