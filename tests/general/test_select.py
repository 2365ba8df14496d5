"""Which cuts can be used, which arms get the general solver, and which are still refused."""

from __future__ import annotations

import pytest

from kinsym.deriving import derive
from kinsym.errors import NoClosedForm
from kinsym.general.arm import six_joints
from kinsym.general.plan import Cut
from kinsym.general.ranks import candidates, usable
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline, load
from kinsym.robot.model import Robot
from tests.general.arms import cobot, derived, random_robot


def cuts_of(robot: Robot) -> list[Cut]:
    arm = six_joints(build_chain(robot))
    assert arm is not None
    return usable(arm)


def test_every_cut_goes_round_the_whole_loop() -> None:
    for cut in candidates():
        assert cut.order[5] == cut.dropped
        assert sorted(cut.order) == sorted(cut.links) == [1, 2, 3, 4, 5, 6]
        # forward the link Kk follows the joint Nk, backward the inverted link is the one before it
        shift = 5 if cut.backward else 0
        assert all((joint - 1 + shift) % 6 + 1 == link for joint, link in zip(cut.order, cut.links, strict=True))


@pytest.mark.parametrize(
    ("name", "count", "bordered"), [("xarm6", 12, 0), ("crx10ia", 4, 2), ("jaco", 4, 0), ("gen2", 4, 0)]
)
def test_cobots_have_few_usable_cuts(name: str, count: int, bordered: int) -> None:
    cuts = cuts_of(cobot(name))
    assert (len(cuts), sum(cut.bordered for cut in cuts)) == (count, bordered)


def test_any_cut_of_a_general_arm_can_be_used() -> None:
    assert len(cuts_of(random_robot(1))) == 24


@pytest.mark.parametrize("slide", range(1, 7))
def test_a_sliding_joint_is_neither_dropped_nor_suppressed(slide: int) -> None:
    cuts = cuts_of(random_robot(slide, (slide,)))
    assert len(cuts) >= 12
    assert all(slide not in (cut.dropped, cut.suppressed) for cut in cuts)


def test_the_best_cut_comes_with_another_way_round() -> None:
    plan = derived("random1").general
    assert plan is not None
    assert derived("random1").plan is None
    first, second = plan.cuts
    assert (first.dropped, first.backward) != (second.dropped, second.backward)
    assert plan.why.startswith("no closed form for theta1")


def test_the_choice_is_the_same_every_time() -> None:
    assert derive(cobot("crx10ia")).general == derived("crx10ia").general


def test_a_closed_form_is_preferred() -> None:
    derivation = derive(load("puma560"))
    assert derivation.general is None
    assert derivation.plan is not None


def test_an_arm_of_less_mobility_is_refused() -> None:
    """Axes 1 and 2 are one line."""
    with pytest.raises(NoClosedForm, match="only 5 independent ways"):
        derive(
            from_inline(
                "0 0 0.1 theta1; 0.7 0.3 0.2 theta2; 1.1 0.2 0.3 theta3; 0.4 0.3 0.1 theta4; "
                "-1 0.2 0.2 theta5; 0.5 0.1 0.3 theta6",
                convention="paul",
                name="coaxial",
            )
        )
