"""Sums and differences of solved angles are those of the joints, whichever of them were solved."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import combinations, permutations

import pytest

from kinsym.algebra.residues import residue_of
from kinsym.algebra.tree import Num, Prod, Sum, Sym, Tree
from kinsym.inverse.assemble import _angle, _joint_values, _sum
from kinsym.inverse.knowledge import Knowledge
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.singular.angle_sums import spanning_trees
from kinsym.robot import from_inline

#: Axes 2 to 4 are parallel, the third against the others, and joint 4 enters with a minus sign; d5 slides along them.
TABLE = "pi/2 0 d1 theta1; pi a2 0 theta2; pi a3 0 theta3; 0 a4 0 -theta4; 0 0 d5 0.3"
CHAIN = build_chain(from_inline(TABLE, convention="paul", name="against"))
GROUP = CHAIN.groups[1]
VALUES = CHAIN.sample(random.Random(12))


def test_signs_differ() -> None:
    assert {sign for _, sign in GROUP.nodes} == {1, -1}
    assert GROUP.last == 3


@pytest.mark.parametrize("nodes", list(permutations(range(4), 3)), ids=str)
def test_cosine_and_sine_of_a_sum_by_those_of_its_parts(nodes: tuple[int, int, int]) -> None:
    start, middle, end = nodes
    parts = [_angle(CHAIN, 1, *edge) for edge in ((start, middle), (middle, end), (start, end))]
    cosine, sine = _sum(CHAIN, 1, nodes, (parts[0], parts[1], parts[2]))
    assert (cosine.name, sine.name) == (parts[2].cosine, parts[2].sine)
    assert [residue_of(one.value, VALUES) for one in (cosine, sine)] == [VALUES[cosine.name], VALUES[sine.name]]


def number(tree: Tree, values: dict[str, Fraction]) -> Fraction:
    """A sum of names with signs."""
    match tree:
        case Num(value):
            return value
        case Sym(name):
            return values[name]
        case Sum(terms):
            return sum((number(term, values) for term in terms), Fraction(0))
        case Prod((first, second)):
            return number(first, values) * number(second, values)
    raise TypeError(tree)


@pytest.mark.parametrize("edges", list(spanning_trees(GROUP)), ids=str)
def test_joints_are_sums_of_the_angles_that_were_solved(edges: tuple[tuple[int, int], ...]) -> None:
    joints = {joint.variable: Fraction(random.Random(joint.variable).randrange(1, 99)) for joint in CHAIN.joints}
    known = Knowledge(CHAIN).with_angle((0, 0, 1)).with_length("d5")
    nodes = [Fraction(0)]
    for variable, sign in GROUP.nodes:
        nodes.append(nodes[-1] + sign * joints[variable])
    values = {"theta1": joints["theta1"], "d5": joints["d5"]}
    for low, high in edges:
        known = known.with_angle((1, low, high))
    for low, high in combinations(range(4), 2):
        angle = CHAIN.angles[1, low, high]
        values[angle.name] = (nodes[high] - nodes[low]) * angle.sign
    solved = {CHAIN.angles[1, low, high].name for low, high in edges}
    found = list(_joint_values(CHAIN, known))
    assert [value.variable for value in found] == [joint.variable for joint in CHAIN.joints]
    for value in found:
        assert number(value.value, values) == joints[value.variable]
        alone = value.variable in {"theta1", "d5"} | solved
        assert value.wrapped is not alone
        assert isinstance(value.value, Sym) == alone
