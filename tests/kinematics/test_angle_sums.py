"""A polynomial in other sums of angles is the same polynomial."""

from __future__ import annotations

import random
from itertools import combinations, pairwise

import pytest

from kinsym.algebra.ring import Poly
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.singular.angle_sums import path, rewritten, shortest, spanning_trees
from kinsym.robot import from_inline, load
from tests.arms import robot

PLANAR = "; ".join(f"0 a{i} 0 theta{i}" for i in range(1, 5))


def chains() -> list[Chain]:
    """Groups of one to four joints, some of them turned against one another."""
    planar = build_chain(from_inline(PLANAR, convention="paul", name="planar_4r"))
    return [build_chain(load("ur5")), build_chain(robot("reversed_axes")), planar]


@pytest.mark.parametrize(("joints", "count"), [(1, 1), (2, 3), (3, 16), (4, 6)])
def test_every_spanning_tree_once_while_they_are_few(joints: int, count: int) -> None:
    """Cayley: n nodes have n^(n-2) trees; of five nodes only the chain and the five stars are taken."""
    group = next(group for chain in chains() for group in chain.groups if group.last == joints)
    trees = [frozenset(edges) for edges in spanning_trees(group)]
    assert len(trees) == len(set(trees)) == count
    for edges in trees:
        assert len(edges) == joints
        assert all(low < high for low, high in edges)
        for start, end in combinations(range(joints + 1), 2):
            steps = path(tuple(edges), start, end)
            assert [steps[0][0], steps[-1][1]] == [start, end]
            assert all(one[1] == other[0] for one, other in pairwise(steps))
            assert all((min(step), max(step)) in edges for step in steps)
            assert path(tuple(edges), end, start) == [(b, a) for a, b in reversed(steps)]
    assert path(tuple(trees[0]), 0, 0) == []


def polynomials(chain: Chain) -> list[Poly]:
    """Some of the cosines and sines of a chain, multiplied and added."""
    generator, ring = random.Random(1), chain.ring
    names = [name for angle in chain.angles.values() for name in (angle.cosine, angle.sine)]
    found = [ring[name] for name in names]
    for _ in range(6):
        one, two, three = (ring[generator.choice(names)] for _ in range(3))
        found.append(ring.reduce(2 * one * two - three + one * one))
    return found


@pytest.mark.parametrize("chain", chains(), ids=lambda chain: chain.robot.name)
def test_rewritten_it_has_the_same_value_and_only_the_angles_that_were_chosen(chain: Chain) -> None:
    values = chain.sample(random.Random(2))
    for group in chain.groups:
        for edges in list(spanning_trees(group))[::3]:
            kept = [
                angle for (index, *edge), angle in chain.angles.items() if index != group.index or (*edge,) in edges
            ]
            allowed = {name for angle in kept for name in (angle.cosine, angle.sine)}
            for poly in polynomials(chain):
                other = rewritten(chain, group, edges, poly)
                assert set(chain.ring.used(other)) <= allowed
                assert chain.ring.evaluate(other, values) == chain.ring.evaluate(poly, values)


def test_the_shortest_sums_are_found_in_every_group() -> None:
    chain = chains()[0]
    ring = chain.ring

    def of(text: str) -> Poly:
        total = ring.one
        for name in text.split():
            total = total * ring[name]
        return total

    for long, short in (
        (of("c23 c3") + of("s23 s3"), of("c2")),
        (of("s234 c34") - of("c234 s34"), of("s2")),
        (of("s5 s234 c4") - of("s5 c234 s4"), of("s5 s23")),
        (of("c2 c3") - of("s2 s3"), of("c23")),
        # of those with as many terms the one with fewer factors, then with fewer letters
        (of("c23 c3") + of("s23 s3") + of("c4 c3") - of("s4 s3"), of("c2") + of("c34")),
        (of("s5"), of("s5")),
    ):
        assert shortest(chain, ring.reduce(long)) == short
