"""The verdict: which axes miss each other, what change would help (tried out), and what degree remains."""

from __future__ import annotations

import pytest

from kinsym.deadline import Deadline
from kinsym.errors import NoClosedForm
from kinsym.inverse import search as solver
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.inverse.verdict import Verdict
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.robot import from_inline
from kinsym.robot.model import Convention, Robot

GENERAL = (
    "pi/2 a1 l1 theta1; pi/2 a2 l2 theta2; pi/2 a3 l3 theta3; pi/2 a4 l4 theta4; pi/2 a5 l5 theta5; 0 a6 l6 theta6"
)
OFFSET_WRIST = "pi/2 0 l1 theta1; 0 a2 0 theta2; pi/2 0 0 theta3; -pi/2 0 l4 theta4; pi/2 0 0.1 theta5; 0 0 l6 theta6"


def arm(table: str, convention: str = "paul") -> Robot:
    """A robot of an inline table."""
    return from_inline(table, convention=convention, name="arm")


def search(robot: Robot, deadline: float | None = None) -> Plan:
    """The closed form of a robot for its task."""
    chain = build_chain(robot)
    return derive_plan(chain, robot.task or fitting_task(chain, chain), Deadline(deadline))


def verdict_on(robot: Robot) -> Verdict:
    """The verdict of a search that must fail."""
    with pytest.raises(NoClosedForm) as caught:
        search(robot)
    found = caught.value.verdict
    assert isinstance(found, Verdict)
    assert str(caught.value) == str(found)
    return found


def test_a_general_arm() -> None:
    found = verdict_on(arm(GENERAL))
    assert found.left == tuple(f"theta{i}" for i in range(1, 7))
    assert found.found == ()
    assert found.degree == 16
    assert [(miss.first, miss.second, miss.name) for miss in found.misses] == [(4, 5, "a4"), (5, 6, "a5"), (4, 6, "l5")]
    meet, parallel = found.remedies
    assert (meet.axes, meet.effect) == ((4, 5, 6), "meet")
    assert (parallel.axes, parallel.effect) == ((4, 5, 6), "be parallel")
    text = str(found)
    assert "With a4 = a5 = l5 = 0 axes 4, 5, 6 would meet" in text
    assert "with alpha4 = alpha5 = 0 axes 4, 5, 6 would be parallel" in text
    assert "up to 16 solutions" in text


def test_a_number_is_called_by_its_place() -> None:
    found = verdict_on(arm(OFFSET_WRIST))
    assert "axes 4 and 6 miss by d5 = 1/10. With d5 = 0 axes 4, 5, 6 would meet" in str(found)


@pytest.mark.parametrize("table", [GENERAL, OFFSET_WRIST])
def test_every_change_that_is_named_helps(table: str) -> None:
    found = verdict_on(arm(table))
    assert found.table is not None
    assert found.remedies
    for change in found.remedies:
        assert search(change.made(found.table)).maximum >= 4


def test_a_deadline_ends_the_trials_too() -> None:
    robot = arm(GENERAL)
    with pytest.raises(NoClosedForm) as caught:
        search(robot, deadline=20.0)
    found = caught.value.verdict
    assert isinstance(found, Verdict)

    def late(chain: object, task: object) -> bool:
        Deadline(1e-9).check()
        return True

    assert "No time was left" in str(Verdict(found.chain, found.task, found.left, found.found, late))


def test_a_change_is_tried_out_by_a_search_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that may look at no state finds nothing, whatever is changed."""
    monkeypatch.setattr(solver, "TRIAL", 0)
    assert verdict_on(arm(OFFSET_WRIST)).remedies == ()


def test_a_change_that_does_not_help_is_not_named() -> None:
    found = verdict_on(arm(GENERAL))
    assert Verdict(found.chain, found.task, found.left, found.found, lambda chain, task: False).remedies == ()
    assert "No single triple" in str(
        Verdict(found.chain, found.task, found.left, found.found, lambda chain, task: False)
    )


def test_craig_and_paul_say_the_same() -> None:
    rows = [row.split() for row in GENERAL.split(";")]
    before = [["0", "0"], *(row[:2] for row in rows[:-1])]
    craig = "; ".join(" ".join((*first, *row[2:])) for first, row in zip(before, rows, strict=True))
    assert str(verdict_on(arm(craig, "craig"))) == str(verdict_on(arm(GENERAL)))


def test_screws_say_the_same() -> None:
    from kinsym.kinematics.convert import convert

    assert "axes 4 and 6 miss by" in str(verdict_on(convert(arm(OFFSET_WRIST), Convention.SCREW)))


@pytest.mark.parametrize(("slides", "degree"), [((), 16), ((4,), 16), ((2, 4), 8)])
def test_the_degree_that_remains(slides: tuple[int, ...], degree: int) -> None:
    """Raghavan and Roth 1993: 6R and 5R1P 16, 4R2P 8."""
    rows = [
        f"deg({30 + 7 * i}) a{i} l{i} theta{i}" if i not in slides else f"deg({30 + 7 * i}) a{i} d{i} 0.2"
        for i in range(1, 7)
    ]
    found = verdict_on(arm("; ".join(rows)))
    assert found.degree == degree
    assert f"up to {degree} solutions" in str(found)
