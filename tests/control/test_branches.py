"""The names of branches are true: solutions are told apart by geometry that knows nothing of the plan."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from kinsym.deriving import derive
from kinsym.inverse.branches import branches
from kinsym.robot import from_inline
from tests import arms
from tests.control.both import case, sample

POSES = 60
# The point on the axes of the wrist, and the tip of the second link, by the number of the frame whose origin it is.
TIPS = {"puma560": (4, 4), "fanuc_s900w": (4, 4), "ur5": (5, 3)}


def frames(name: str, q: Any) -> list[Any]:
    """The frames 0 to n of a table in Paul's convention, by its own product of matrices."""
    values, found = case(name).keywords, [np.eye(4)]
    for row, angle in zip(arms.robot(name).joints, q, strict=True):
        alpha, a, d = (
            float(cell.subs({symbol: values.get(symbol.name, 0.0) for symbol in cell.free_symbols}))
            for cell in (row.alpha, row.a, row.d)
        )
        c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha)
        step = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        found.append(found[-1] @ np.array(step))
    return found


def turned_left(start: Any, end: Any) -> bool:
    """Whether the turn from one vector of a plane to another is to the left, by their angles."""
    return bool(np.sin(np.arctan2(end[1], end[0]) - np.arctan2(start[1], start[0])) > 0)


def described(name: str, q: Any) -> set[str]:
    """Which way the arm stands, from where its axes and points are."""
    at = frames(name, q)
    place, axis = [frame[:3, 3] for frame in at], [frame[:3, 2] for frame in at]
    wrist, tip = TIPS[name]
    # Facing the wrist from axis 1, is axis 2 to the right?
    left = turned_left(place[wrist][:2], axis[1][:2])
    # The arm's plane, seen so that it reaches to the right: across, up.
    right = np.cross([0.0, 0.0, 1.0], axis[1]) * (-1.0 if left else 1.0)
    plane = np.array([right, [0.0, 0.0, 1.0]])
    up = turned_left(plane @ (place[tip] - place[1]), plane @ (place[2] - place[1]))
    # About axis 5, how far is axis 6 ahead of axis 4?
    ahead = np.arctan2(np.dot(np.cross(axis[3], axis[5]), axis[4]), np.dot(axis[3], axis[5]))
    return {
        "shoulder left" if left else "shoulder right",
        "elbow up" if up else "elbow down",
        "wrist not flipped" if ahead > 0 else "wrist flipped",
    }


@pytest.mark.parametrize("name", TIPS)
def test_names_say_how_the_arm_stands(name: str) -> None:
    module, keywords = case(name).module, case(name).keywords
    seen = set()
    for seed in range(POSES):
        found = module.solve(module.fk(sample(name, seed), **keywords), **keywords)
        for q, branch in zip(found.q, found.branch, strict=True):
            assert set(module.BRANCHES[branch].split(", ")) == described(name, q)
            seen.add(branch)
    assert len(seen) == 8


def test_above_is_above_where_the_arm_reaches_forward() -> None:
    """A UR5 in front of itself: the elbow named up is the higher one."""
    module, q = case("ur5").module, [0.2, -1.2, 1.4, -1.8, -1.5, 0.3]
    found = module.solve(module.fk(q))
    heights: dict[tuple[str, ...], dict[str, float]] = {}
    for vector, branch in zip(found.q, found.branch, strict=True):
        place = frames("ur5", vector)
        ahead = np.dot(place[5][:2, 3], (place[3][:3, 3] - place[1][:3, 3])[:2]) > 0
        elbow, *others = sorted(module.BRANCHES[branch].split(", "))
        if ahead:
            heights.setdefault(tuple(others), {})[elbow] = place[2][2, 3]
    pairs = [pair for pair in heights.values() if len(pair) == 2]
    assert pairs
    assert all(pair["elbow up"] > pair["elbow down"] for pair in pairs)


@pytest.mark.parametrize("name", ["planar_rr", "scara", "planar_rrr_craig"])
def test_a_planar_elbow_is_left_or_right_of_the_way(name: str) -> None:
    module, keywords = case(name).module, case(name).keywords
    seen = set()
    for seed in range(20):
        q = sample(name, seed)
        for vector, branch in zip(*module.solve(module.fk(q, **keywords), **keywords)[:2], strict=True):
            # Bending to the right of the first link puts the elbow to its left.
            bent = np.sin(vector[1]) < 0
            assert module.BRANCHES[branch] == ("elbow left" if bent else "elbow right")
            seen.add(branch)
    assert len(seen) == 2


@pytest.mark.parametrize("name", ["stanford_paul", "cylindrical_rpp", "spherical_rrp"])
def test_the_sign_of_a_slide(name: str) -> None:
    module, keywords = case(name).module, case(name).keywords
    for seed in range(20):
        for q, branch in zip(*module.solve(module.fk(sample(name, seed), **keywords), **keywords)[:2], strict=True):
            assert ("d3 > 0" in module.BRANCHES[branch]) == (q[2] > 0)


def test_the_roots_of_a_quartic_are_called_by_their_order() -> None:
    module, keywords = case("general_pieper").module, case("general_pieper").keywords
    for seed in range(10):
        found = module.solve(module.fk(sample("general_pieper", seed), **keywords), **keywords)
        names = [module.BRANCHES[branch].split(", ")[0].split()[1] for branch in found.branch]
        order = [("first", "second", "third", "fourth").index(name) for name in names]
        assert order == sorted(order)
        assert (np.diff(found.q[:, 2]) >= -1e-12).all()


def test_the_sign_of_the_first_link_is_that_of_the_table() -> None:
    """a2 is negative on a UR5: with the opposite sign the names of the elbows change places."""
    table = "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3"
    plus, minus = (
        derive(from_inline(table, convention="paul", name="arm", bindings={"a2": Fraction(length, 2)})).branches.names
        for length in (1, -1)
    )
    assert plus == derive(from_inline(table, convention="paul", name="arm")).branches.names
    assert plus[0::2] == minus[1::2]
    assert plus[1::2] == minus[0::2]


@pytest.mark.parametrize("name", arms.NAMES)
def test_every_branch_has_a_name_of_its_own(name: str) -> None:
    found = arms.derivation(name)
    named = branches(found.solved, found.plan)
    assert len(set(named.names)) == len(named.names) == found.plan.maximum
    assert named == found.branches
    assert bool(named.meanings) == (found.plan.maximum > 1)
