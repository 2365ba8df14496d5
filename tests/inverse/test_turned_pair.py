"""Two equations as one turned vector: what is stated follows from the two, and what is no such vector is left alone."""

from __future__ import annotations

import pytest

from kinsym.algebra.ring import Poly
from kinsym.inverse.pool import PoolEquation
from kinsym.inverse.rules.turned_pair import Line, own_vector, promising, shared_points, turned_form, turned_pair
from kinsym.inverse.state import start
from kinsym.kinematics.chain import build_chain
from kinsym.robot.model import Task
from tests.arms import robot

CHAIN = build_chain(robot("general_3r"))
STATE, _ = start(CHAIN, Task.POSITION)
RING = CHAIN.ring
C, S, C3, S3 = (RING[name] for name in ("c2", "s2", "c3", "s3"))
A, B, D, PX, PZ = (RING[name] for name in ("a1", "a2", "d2", "p_x", "p_z"))
TURNED, OTHER = (next(angle for angle in CHAIN.angles.values() if angle.label == label) for label in "23")
POINTS = shared_points(STATE)
ONE, ZERO = RING.one, RING.zero


def equation(poly: Poly, unit: int = 1) -> PoolEquation:
    return PoolEquation(RING.reduce(poly), ZERO, unit, "", (TURNED, OTHER), ())


def pair_of(first: Poly, second: Poly):
    """The pair of two polynomials that are zero, None where the rule would not make one of them."""
    forms = [turned_form(STATE, equation(poly, unit), TURNED, POINTS) for unit, poly in enumerate((first, second), 1)]
    if None in forms or not promising(*forms):
        return None
    return turned_pair(STATE, TURNED, OTHER, *forms)


def along(line: Line) -> Poly:
    """A line at the other angle."""
    return line[0] * C3 + line[1] * S3 + line[2]


K1, K2, X, Y = A * C3 + B, D - A * S3, PX - B * S3, PZ + C3
"""k1 c + k2 s = X and k1 s - k2 c = Y."""
ONE_WAY, OTHER_WAY = K1 * C + K2 * S - X, K1 * S - K2 * C - Y
PAIRS = {
    "plain": (ONE_WAY, OTHER_WAY),
    "the other way round": (OTHER_WAY, ONE_WAY),
    "times a number": (2 * ONE_WAY, 3 * OTHER_WAY),
    "times constants": (2 * A * ONE_WAY, B * OTHER_WAY),
    "with the same constant": (A * ONE_WAY, A * OTHER_WAY),
    "not orthogonal": (ONE_WAY + 2 * OTHER_WAY, OTHER_WAY),
    "not orthogonal by constants": (B * ONE_WAY + 2 * D * OTHER_WAY, A * OTHER_WAY),
    "one component": (C3 * C - X, C3 * S - Y),
    "the other component": (C3 * S - X, C3 * C + Y),
}


@pytest.mark.parametrize("name", PAIRS)
def test_what_a_pair_states_follows_from_the_equations(name: str) -> None:
    first, second = (RING.reduce(poly) for poly in PAIRS[name])
    pair = pair_of(first, second)
    assert pair is not None
    k1, k2 = along(pair.k1), along(pair.k2)
    (x, y), (one, *less) = pair.sides, pair.sides[0].weights
    made = one[0] * first - (less[0][0] * second if less else ZERO)
    assert RING.reduce(x.scale * (k1 * C + k2 * S) - along(x.rest)) == RING.reduce(made)
    assert RING.reduce(y.scale * (k1 * S - k2 * C) - along(y.rest)) == RING.reduce(y.weights[0][0] * second)
    assert [unit for _, unit in (*pair.sides[0].weights, *y.weights)] == [1, *([2] if less else []), 2]
    assert pair.equations == (equation(first, 1), equation(second, 2))
    lengths = [len(part) for line in (pair.k1, pair.k2, x.rest, y.rest) for part in line]
    weights = [len(weight) for side in pair.sides for weight, _ in side.weights]
    assert pair.terms == sum((*lengths, *weights, len(x.scale), len(y.scale)))


@pytest.mark.parametrize(
    ("first", "second"),
    [
        # no vector turned by a right angle
        (ONE_WAY, K1 * S + K2 * C - Y),
        (ONE_WAY, C3 * OTHER_WAY),
        (ONE_WAY, ONE_WAY),
        (ONE_WAY, PX * OTHER_WAY),
        (K1 * C - X, K1 * C - Y),
        # more than linear in one of the angles
        (ONE_WAY + C * S, OTHER_WAY),
        (ONE_WAY, OTHER_WAY + C * C),
        (ONE_WAY + C3 * S3, OTHER_WAY),
        (ONE_WAY, OTHER_WAY + C3 * S3),
        (C3 * S3 * C + K2 * S - X, C3 * S3 * S - K2 * C - Y),
        (K1 * C + C3 * S3 * S - X, K1 * S - C3 * S3 * C - Y),
        # without the angle
        (X, OTHER_WAY),
        (ONE_WAY, Y),
    ],
)
def test_what_is_no_turned_vector_is_none(first: Poly, second: Poly) -> None:
    assert pair_of(first, second) is None


def test_a_length_may_stand_up_to_its_square() -> None:
    chain = build_chain(robot("sliding_prp"))
    ring, (state, _) = chain.ring, start(chain, Task.POSE)
    turned, d = next(iter(chain.angles.values())), ring["d1"]
    c, s, a = ring[turned.cosine], ring[turned.sine], ring["a1"]

    def pair(rest: Poly):
        equations = [
            PoolEquation(ring.reduce(poly), ring.zero, 1, "", (turned,), ("d1",))
            for poly in (a * c + d * s + rest, a * s - d * c)
        ]
        forms = [turned_form(state, one, turned, shared_points(state)) for one in equations]
        return turned_pair(state, turned, "d1", *forms)

    found = pair(3 * d**2 + 5)
    assert found.sides[0].rest == (ring.number(-5), ring.zero, ring.number(-3))
    assert (found.k1, found.k2) == ((a, ring.zero, ring.zero), (ring.zero, ring.one, ring.zero))
    assert pair(d**3) is None


def test_points_share_the_constants_and_nothing_else() -> None:
    first, second = POINTS
    shared = {name for name in first if first[name] == second[name]}
    assert shared == {
        name for name in first if name in {*CHAIN.robot.parameters, *(n for n, _ in CHAIN.constants.formulas())}
    }


def test_a_vector_of_its_own_depends_on_the_other_angle_and_not_on_the_pose() -> None:
    assert own_vector(RING, pair_of(ONE_WAY, OTHER_WAY))
    assert not own_vector(RING, pair_of(A * C + B * S - X, A * S - B * C - Y))
    assert not own_vector(RING, pair_of((C3 + PX) * C + K2 * S - X, (C3 + PX) * S - K2 * C - Y))
