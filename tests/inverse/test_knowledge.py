"""What follows from solved angles and slides: sums of angles between nodes that are joined, and what is left."""

from __future__ import annotations

import random
from itertools import combinations

import pytest

from kinsym.algebra.field import PRIME
from kinsym.inverse.knowledge import Knowledge
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline, load

TABLE = "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; pi 0 d4 0.3; 0 a5 0 theta5; 0 a6 0 theta6"
CHAIN = build_chain(from_inline(TABLE, convention="paul", name="four_parallel"))
NOTHING = Knowledge(CHAIN)
#: Nodes 0 to 4, of which 1, 3 and 4 are one part and 0 and 2 another one; in the first group nothing.
TWO_PARTS = NOTHING.with_angle((1, 1, 4)).with_angle((1, 3, 4)).with_angle((1, 0, 2))


def test_a_group_of_four_joints_and_a_slide() -> None:
    assert [(group.last, len(group.joints)) for group in CHAIN.groups] == [(1, 1), (4, 5)]


def test_parts_are_called_by_their_lowest_node() -> None:
    assert [NOTHING.representative(1, node) for node in range(5)] == [0, 1, 2, 3, 4]
    assert [TWO_PARTS.representative(1, node) for node in range(5)] == [0, 1, 0, 1, 1]
    assert [TWO_PARTS.representative(0, node) for node in range(2)] == [0, 1]
    assert NOTHING.edges == frozenset()


def test_an_angle_is_known_where_its_nodes_are_joined() -> None:
    known = {(group, low, high) for (group, low, high), angle in CHAIN.angles.items() if TWO_PARTS.knows(angle)}
    assert known == {(1, 0, 2), (1, 1, 3), (1, 1, 4), (1, 3, 4)}


def test_paths_go_by_solved_angles_and_are_the_shortest() -> None:
    assert TWO_PARTS.path(1, 1, 3) == [(1, 4), (4, 3)]
    assert TWO_PARTS.path(1, 3, 1) == [(3, 4), (4, 1)]
    assert TWO_PARTS.path(1, 0, 2) == [(0, 2)]
    assert TWO_PARTS.path(1, 2, 2) == []
    more = TWO_PARTS.with_angle((1, 1, 3))
    assert more.path(1, 1, 3) == [(1, 3)]
    assert more.path(1, 3, 4) == [(3, 4)]


@pytest.mark.parametrize("known", [NOTHING, TWO_PARTS, TWO_PARTS.with_angle((1, 0, 3))])
def test_a_turn_is_the_same_however_it_is_written(known: Knowledge) -> None:
    """In known angles and one more, the one between the lowest nodes of two parts."""
    values = CHAIN.sample(random.Random(1))
    for start, end in [*combinations(range(5), 2), (3, 0), (4, 2), (2, 2)]:
        written = known.turn(1, start, end)
        plain = CHAIN.turn(1, start, end)
        assert [CHAIN.ring.evaluate(p, values) for p in written] == [CHAIN.ring.evaluate(p, values) for p in plain]
        used = {name for poly in written for name in CHAIN.ring.used(poly)}
        unknown = {a.label for a in CHAIN.angles.values() if {a.cosine, a.sine} & used and not known.knows(a)}
        assert len(unknown) == (known.representative(1, start) != known.representative(1, end))
    c, s = (CHAIN.ring.evaluate(poly, values) for poly in known.turn(1, 1, 2))
    assert (c * c + s * s) % PRIME == 1


def test_a_group_is_solved_with_all_its_turns_and_slides() -> None:
    first, group = CHAIN.groups
    every = TWO_PARTS.with_angle((1, 2, 3))
    assert not every.solved(group)
    assert every.with_length("d4").solved(group)
    assert not TWO_PARTS.with_length("d4").solved(group)
    assert not every.with_length("d4").solved(first)
    assert every.with_angle((0, 0, 1)).solved(first)


def test_what_is_left_is_told_in_the_order_of_the_table() -> None:
    assert NOTHING.unknowns() == ("theta1", "theta2", "theta3", "d4", "theta5", "theta6")
    assert TWO_PARTS.with_length("d4").unknowns() == ("theta1", "theta2", "theta3", "theta5")
    assert TWO_PARTS.with_angle((1, 2, 3)).with_angle((0, 0, 1)).unknowns() == ("d4",)
    scara = Knowledge(build_chain(load("scara")))
    assert scara.with_angle((0, 0, 3)).unknowns() == scara.unknowns()
