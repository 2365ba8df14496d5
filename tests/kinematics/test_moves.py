"""Groups of parallel axes move points as the joints one by one do, and back again."""

from __future__ import annotations

import random

import pytest

from kinsym.algebra.field import PRIME
from kinsym.algebra.ring import Poly, Vector
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.moves import Moves
from kinsym.kinematics.singular.posture import posture
from tests.arms import robot

NAMES = ("ur5", "scara", "stanford_paul", "reversed_axes", "sliding_rpr", "elbow_6r_screw", "framed")
CHAINS = {name: build_chain(robot(name)) for name in NAMES}
EVERY = pytest.mark.parametrize("chain", CHAINS.values(), ids=CHAINS)


def whole(chain: Chain) -> list[Moves]:
    """The groups with what follows their last joints."""
    return [Moves(chain.ring, group.whole(chain.ring), chain.turn) for group in chain.groups]


def at(chain: Chain, values: dict[str, int], vector: Vector) -> list[int]:
    return [chain.ring.evaluate(entry, values) for entry in vector]


def square(numbers: list[int]) -> int:
    return sum(number * number for number in numbers) % PRIME


def drawn(chain: Chain, seed: int) -> Vector:
    """A vector of numbers."""
    generator = random.Random(seed)
    x, y, z = (chain.ring.number(generator.randrange(-9, 10)) for _ in range(3))
    return x, y, z


@EVERY
def test_all_groups_lead_from_the_base_to_the_end(chain: Chain) -> None:
    values = chain.sample(random.Random(1))
    here = posture(chain, values)
    zero, one = chain.ring.zero, chain.ring.one
    point: Vector = (zero, zero, zero)
    columns: list[Vector] = [(one, zero, zero), (zero, one, zero), (zero, zero, one)]
    for move in reversed(whole(chain)):
        point, columns = move.point(point), [move.direction(column) for column in columns]
    base = chain.base
    assert at(chain, values, base.apply(chain.ring, point)) == list(here.end)
    rows = [[chain.ring.dot(row, column) for column in columns] for row in base.rotation]
    assert [at(chain, values, row) for row in rows] == [list(row) for row in here.turned]


@EVERY
def test_back_is_the_inverse(chain: Chain) -> None:
    values, vector = chain.sample(random.Random(2)), drawn(chain, 3)
    for move in whole(chain):
        for there, back in ((move.point, move.point_back), (move.direction, move.direction_back)):
            assert at(chain, values, back(there(vector))) == at(chain, values, vector)
            assert at(chain, values, there(back(vector))) == at(chain, values, vector)


@EVERY
def test_squared_distances_are_those_of_the_points(chain: Chain) -> None:
    values, vector = chain.sample(random.Random(4)), drawn(chain, 5)
    ring = chain.ring
    squared: Poly = ring.dot(vector, vector)
    for move in whole(chain):
        origin: Vector = (ring.zero, ring.zero, ring.zero)
        assert at(chain, values, move.point(origin)) == at(chain, values, move.reach)
        assert ring.evaluate(move.reach_squared, values) == square(at(chain, values, move.reach))
        assert square(at(chain, values, move.back_reach)) == square(at(chain, values, move.reach))
        for there, length in (
            (move.point(vector), move.point_squared(vector, squared)),
            (move.point_back(vector), move.point_back_squared(vector, squared)),
        ):
            assert ring.evaluate(length, values) == square(at(chain, values, there))


@EVERY
def test_a_group_that_is_cut_off_ends_where_its_joint_begins(chain: Chain) -> None:
    values = chain.sample(random.Random(6))
    here = posture(chain, values)
    zero = chain.ring.zero
    for position in range(len(chain.joints)):
        point: Vector = (zero, zero, zero)
        parts = [Moves(chain.ring, group.whole(chain.ring), chain.turn) for group in chain.groups_before(position)]
        for move in reversed(parts):
            point = move.point(point)
        assert at(chain, values, chain.base.apply(chain.ring, point)) == list(here.points[position])
