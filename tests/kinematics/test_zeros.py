"""Postures on the zeros of polynomials belong to an arm, and what is restricted to a part keeps its value."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

from kinsym.algebra.field import PRIME, turn
from kinsym.algebra.ring import Poly
from kinsym.emit.text.formula import TextPrinter
from kinsym.kinematics.chain import Chain, build_chain, chain_to_solve
from kinsym.kinematics.singular import minors
from kinsym.kinematics.singular.double_conditions import _restricted
from kinsym.kinematics.singular.posture import Posture, posture
from kinsym.kinematics.singular.zeros import Part, Zero, parts, postures, somewhere
from kinsym.robot import from_inline, load
from kinsym.robot.model import Task
from tests.arms import robot

WRITE = TextPrinter()
#: Groups of up to three joints; axes against one another; slides inside a group and alone; names in another order.
CHAINS = {name: build_chain(load(name)) for name in ("ur5", "scorbot_5r", "stanford_paul", "scara")}
CHAINS |= {name: build_chain(robot(name)) for name in ("reversed_axes", "sliding_rpr")}
BACKWARDS = "pi/2 0 d1 theta5; 0 a2 0 theta4; 0 a3 0 theta3; pi/2 a4 0 theta2; 0 0 d5 theta1"
CHAINS["backwards"] = build_chain(from_inline(BACKWARDS, convention="paul", name="backwards"))
EVERY = pytest.mark.parametrize("chain", CHAINS.values(), ids=CHAINS)


def belong_together(chain: Chain, values: dict[str, int]) -> bool:
    """Whether the cosines and sines are those of angles, and sums of angles those of their terms."""
    for (group, low, high), angle in chain.angles.items():
        total = (1, 0)
        for edge in pairwise(range(low, high + 1)):
            own = chain.angles[group, *edge]
            total = turn(total, (values[own.cosine], values[own.sine]), own.sign)
        c, s = values[angle.cosine], values[angle.sine] * angle.sign % PRIME
        if (c, s) != total or (c * c + s * s) % PRIME != 1:
            return False
    return True


def zeros(chain: Chain) -> list[Zero]:
    """Every value of an angle or a slide that makes a cosine, a sine or a length vanish, alone and two at once."""
    ring = chain.ring
    names = [name for angle in chain.angles.values() for name in (angle.cosine, angle.sine)]
    names += [joint.variable for joint in chain.joints if joint.kind == "P"]
    single = [part for name in names for part in parts(chain, ring[name])]
    first, last = chain.angles[min(chain.angles)], chain.angles[max(chain.angles)]
    other = Part(ring.reduce(ring[first.cosine] * 2 - ring[first.sine] * ring[last.cosine]))
    return [*((part,) for part in single), (other,), (parts(chain, ring[last.sine])[1], other)]


@EVERY
def test_postures_lie_on_every_part_and_are_postures_of_the_arm(chain: Chain) -> None:
    for zero in zeros(chain):
        found = postures(chain, zero, 2)
        assert len(found) == 2
        for one in found:
            assert belong_together(chain, dict(one.values))
            for part in zero:
                assert chain.ring.evaluate(part.poly, one.values) == 0
                assert not part.variable or holds(chain, part, one)
        assert found[0].values != found[1].values
    for one in somewhere(chain, 2):
        assert belong_together(chain, dict(one.values))


def holds(chain: Chain, part: Part, where: Posture) -> bool:
    """Whether the joint or the sum of joints has the value that a part names."""
    for angle in chain.angles.values():
        if angle.name == part.variable:
            point = [(1, 0), (0, 1), (PRIME - 1, 0), (0, PRIME - 1)][part.quarters]
            return (where.values[angle.cosine], where.values[angle.sine]) == point
    return where.values[part.variable] == 0


def test_parts_are_told_as_values_of_joints() -> None:
    def told(chain: Chain, poly: Poly) -> list[str]:
        return [
            f"{WRITE(left)} {sign} {WRITE(right)}"
            for part in parts(chain, poly)
            for left, sign, right in [part.relation or ()]
        ]

    ur5, stanford = CHAINS["ur5"], CHAINS["stanford_paul"]
    assert told(ur5, ur5.ring["s5"]) == ["theta5 = 0", "theta5 = pi"]
    assert told(ur5, ur5.ring["c234"]) == ["theta234 = pi/2", "theta234 = -pi/2"]
    assert told(stanford, stanford.ring["d3"]) == ["d3 = 0"]
    (whole,) = parts(ur5, ur5.ring["s5"] + ur5.ring["c5"])
    assert (whole.relation, whole.variable) == (None, "")


@EVERY
def test_restricted_to_a_part_it_has_the_value_there_without_the_joint(chain: Chain) -> None:
    ring, generator = chain.ring, random.Random(3)
    names = [name for angle in chain.angles.values() for name in (angle.cosine, angle.sine)]
    drawn = (tuple(ring[generator.choice(names)] for _ in range(3)) for _ in range(5))
    polys = [ring.reduce(one * two - three) for one, two, three in drawn]
    for (part,) in (zero for zero in zeros(chain) if len(zero) == 1 and zero[0].variable):
        where = postures(chain, (part,), 1)[0].values
        for poly in (one for one in polys if one):
            found = _restricted(chain, part, poly)
            assert not set(ring.used(found)) & set(ring.used(part.poly))
            assert ring.evaluate(found, where) in (value := ring.evaluate(poly, where), -value % PRIME)
            assert not found or found.LC > 0


def test_a_joint_about_the_end_frame_is_one_more_row_of_the_table() -> None:
    """The arm that has one is solved where position and axis are asked for."""
    table = "pi/2 a1 d1 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; -pi/2 0 d4 theta4; pi/2 0 0 theta5"
    short, long = (from_inline(text, convention="paul") for text in (table, f"{table}; 0 0 0 theta6"))
    spun, whole = chain_to_solve(short, "theta6"), build_chain(long)
    assert [(group.joints, group.nodes) for group in spun.groups] == [
        (group.joints, group.nodes) for group in whole.groups
    ]
    assert spun.numbers == whole.numbers
    values = whole.sample(random.Random(4))
    assert posture(spun, values) == posture(whole, values)
    assert posture(spun, values).jacobian(Task.POSE) != posture(build_chain(short), values).jacobian(Task.POSE)


def test_a_jacobian_is_looked_at_in_two_views_of_the_arm(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those with the fewest terms: what is asked of more is time."""
    asked = []
    rows = minors._rows
    monkeypatch.setattr(
        minors, "_rows", lambda chain, task, view, point: asked.append(view) or rows(chain, task, view, point)
    )
    minors.sparsest_jacobian(CHAINS["ur5"], Task.POSE)
    different = list(dict.fromkeys(asked))
    assert len(different) == 2
    assert max(view.terms for view in different) <= sorted(view.terms for view in minors.views(CHAINS["ur5"]))[1]
