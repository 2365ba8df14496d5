"""The largest minors of the Jacobian as products of factors; det J itself where it is square.

They are computed in the frame and at the point where they are shortest, and the factors are written in the sums of
angles and with the lengths of the table that a person would take.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

from kinsym.algebra.determinant import Rows, block_determinants, expansion
from kinsym.algebra.factors import Factored, factored
from kinsym.algebra.ring import Kind, Poly, fraction
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.angle_sums import shortest
from kinsym.kinematics.singular.screws import View, columns, views
from kinsym.robot.model import Task

#: Views of the chain that are tried: those in which its axes and points are shortest.
VIEWS = 2
#: A determinant whose expansion has more terms is not computed: its time would not be bounded.
WORK = 4000


def sparsest_jacobian(chain: Chain, task: Task) -> Rows:
    """The Jacobian of a task in the frame and at the point where its largest minors are shortest."""
    return min(_matrices(chain, task), key=lambda rows: (len(rows), _work(rows)))


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


def largest_minors(chain: Chain, rows: Rows) -> Iterator[Factored]:
    """The factors of every largest minor that is not zero, short ones first, as far as their work is bounded."""
    minors = sorted((list(chosen) for chosen in combinations(rows, len(rows[0]))), key=expansion)
    for minor in minors:
        if expansion(minor) <= WORK and all(blocks := block_determinants(chain.ring, minor)):
            yield _written(chain, blocks)


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


def _order(chain: Chain, poly: Poly) -> list[int]:
    """Later joints first, as a wrist stands before an elbow."""
    return [-chain.ring.index[name] for name in chain.ring.used(poly)]
