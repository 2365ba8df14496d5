"""The coverage benchmark sees what it is there to see: its oracle is right and independent, its counts count faults."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from kinsym.check.solvers import Solutions, Solver
from kinsym.check.table import TableKinematics
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import from_inline, load, to_toml
from kinsym.robot.model import Robot, Task
from tests.arms import robot as shape
from tests.benchmarks import peers
from tests.benchmarks.coverage.arms import CLASSES, arm, moves
from tests.benchmarks.coverage.measure import DISTANCES, Effort, Result, Trial, measure, parameters, solver
from tests.benchmarks.coverage.oracle import Floats, Screws, distinct, gaps, multistart
from tests.benchmarks.coverage.table import GALLERY, document, joined, section_of, shortcomings

SMALL = Effort(poses=2, starts=60, seed=1)


@pytest.mark.parametrize("name", CLASSES)
def test_arms_are_the_same_for_a_seed_and_can_move(name: str) -> None:
    texts = [to_toml(arm(name, number, 1)) for number in range(4)]
    assert texts == [to_toml(arm(name, number, 1)) for number in range(4)]
    assert len(set(texts)) == 4
    assert to_toml(arm(name, 1, 2)) != texts[1]
    assert all(moves(arm(name, number, 1)) for number in range(4))


def test_even_arms_name_their_lengths_and_odd_ones_do_not() -> None:
    assert arm("general 6R", 0, 1).parameters
    assert not arm("general 6R", 1, 1).parameters


@pytest.mark.parametrize(
    "robot",
    [
        load("kuka_kr6_r900"),
        load("nao_left_leg"),
        load("gudel_fp1"),
        load("katana_450"),
        shape("framed"),
        shape("single"),
    ],
    ids=lambda robot: robot.name,
)
def test_screws_reach_the_pose_of_the_table(robot: Robot) -> None:
    values = parameters(robot)
    screws = Screws(robot, values)
    q = np.linspace(-0.8, 1.9, screws.count)
    wanted = np.array(TableKinematics(robot, values).forward(q.tolist()), dtype=np.float64)
    assert np.abs(screws.forward(q) - wanted).max() < 1e-12
    step = 1e-6 * np.eye(screws.count)
    slope = (screws.forward(q + step) - screws.forward(q - step))[:, :3, 3].T / 2e-6
    assert np.abs(screws.jacobian(q)[:3] - slope).max() < 1e-8


def test_starts_find_the_eight_solutions_of_a_puma() -> None:
    screws = Screws(load("puma560"))
    q = np.array([[0.4, -0.9, 0.3, 1.1, 0.8, -0.5]])
    (found,) = multistart(screws, Task.POSE, q, 150, np.random.default_rng(1))
    assert len(found) == 8
    assert gaps(screws, q, found).min() < 1e-9
    assert np.abs(screws.forward(found) - screws.forward(q)).max() < 1e-10


def test_starts_leave_a_locked_joint_where_it_is() -> None:
    screws = Screws(load("kuka_iiwa"))
    q = np.array([[0.3, 0.9, -0.4, 1.1, 0.8, -0.5, 0.7]])
    (found,) = multistart(screws, Task.POSE, q, 150, np.random.default_rng(1))
    assert screws.free.tolist().count(False) == 1
    assert len(found) == 8
    assert (found[:, ~screws.free] == q[:, ~screws.free]).all()


@pytest.mark.parametrize("name", ["kuka_iiwa", "ufactory_xarm6"])
def test_an_arm_with_a_lock_and_one_without_a_closed_form_lose_nothing(name: str) -> None:
    result = measure(GALLERY, load(name), SMALL)
    assert result.kind == {"kuka_iiwa": "closed form", "ufactory_xarm6": "degree 16"}[name]
    assert result.there == result.found > 0
    assert shortcomings([result]) == ["None."]


def test_a_full_turn_apart_is_the_same() -> None:
    screws = Screws(load("scara"), {"a1": Fraction(1), "a2": Fraction(1), "d1": Fraction(1), "d4": Fraction(1)})
    q = np.array([[0.1, 0.2, 0.3, 0.4], [0.1 + 2 * np.pi, 0.2, 0.3, 0.4 - 2 * np.pi], [0.1, 0.2, 0.4, 0.4]])
    assert len(distinct(screws, q)) == 2


class Spoiled(Solver):
    """A solver whose first answers are tampered with."""

    name = "spoiled"

    def __init__(self, inner: Solver, how: str) -> None:
        self.inner, self.how = inner, how

    def inverse(self, poses: Floats, reference: Floats) -> Solutions:
        q, count = self.inner.inverse(poses, reference)
        if self.how == "loses":
            q, count = q[:, 1:], count - 1
        elif self.how == "repeats":
            q[:, 1] = q[:, 0]
        elif self.how == "errs":
            q[:, 0, 0] += 1e-3
        elif self.how == "breaks":
            q[:, 0, 0] = np.inf
        return q, count


@pytest.mark.parametrize(
    ("how", "wanted"),
    [
        ("nothing", {"lost": 0, "wrong": 0, "copies": 0, "broken": 0}),
        ("loses", {"lost": 2, "wrong": 0, "copies": 0, "broken": 0}),
        ("repeats", {"lost": 2, "wrong": 0, "copies": 2, "broken": 0}),
        ("errs", {"lost": 2, "wrong": 2, "copies": 0, "broken": 0}),
        ("breaks", {"lost": 2, "wrong": 0, "copies": 0, "broken": 2}),
    ],
)
def test_faults_are_counted(how: str, wanted: dict[str, int], tmp_path: Path) -> None:
    robot = load("planar_rr")
    schedule, values = build_schedule(derive(robot)), parameters(robot)
    result = Result(group=GALLERY, name=robot.name, kind="closed form")
    Trial(robot, schedule, values, Spoiled(solver(schedule, values, tmp_path), how), SMALL).random_poses(result)
    assert result.there == 4
    counted = {"lost": result.there - result.found, "wrong": result.wrong}
    assert counted | {"copies": result.copies, "broken": result.broken} == wanted
    assert (shortcomings([result]) == ["None."]) == (how == "nothing")


def test_a_measured_arm_and_a_refused_one() -> None:
    seven = from_inline(
        "; ".join(f"pi/2 0 {0.1 * i:.1f} theta{i}" for i in range(1, 8)), convention="paul", name="seven"
    )
    good, refused = measure(GALLERY, load("puma560"), SMALL), measure("redundant", seven, SMALL)
    assert (good.kind, good.there, good.found, good.wrong, good.copies) == ("closed form", 16, 16, 0, 0)
    assert {distance for _, distance in good.singular} == set(DISTANCES)
    total = good.singular_total
    assert total["poses"] == total["answered"] > 0
    assert total["wrong"] == total["copies"] == total["NaN"] == 0
    assert (refused.kind, refused.there) == ("refused", 0)
    assert shortcomings([refused])[0].startswith("- redundant, seven: refused: 7 joints are more than")


def test_the_page_never_rounds_up_to_everything() -> None:
    result = Result(group="some class", name="arm_7", kind="closed form", there=100_000, found=99_999, closures=[1e-16])
    lines = document([result], "the command")
    assert "Printed by `the command`." in lines
    (row,) = (line for line in lines if line.startswith("| some class"))
    assert "| 99999 of 100000 | 99.99 |" in row
    assert lines[-1] == "- some class, arm_7: solutions lost 1"


def test_the_section_on_peers_is_kept_and_replaced() -> None:
    page = joined("# Coverage\n\nold\n", "## Peers\n\nthem\n")
    assert page == "# Coverage\n\nold\n\n## Peers\n\nthem\n"
    assert joined("# Coverage\n\nnew\n", section_of(page)) == "# Coverage\n\nnew\n\n## Peers\n\nthem\n"
    assert joined(page, "## Peers\n\nothers\n") == "# Coverage\n\nold\n\n## Peers\n\nothers\n"
    assert joined("# Coverage\n", section_of("")) == "# Coverage\n"


def test_peers_that_are_not_there_are_said_to_be_missing(tmp_path: Path) -> None:
    item = peers.subject(GALLERY, load("puma560"), 1, 1)
    assert peers.ask("EAIK", item, tmp_path) == {"refused": "not run: FileNotFoundError"}
    (answer,) = peers.own([item])
    assert len(answer["solutions"][0]) == 8
    described = peers._description(item)
    assert json.loads(json.dumps(described)) == described
    assert np.abs(np.sum(described["offsets"], axis=0) - item.screws.home[:3, 3]).max() < 1e-12
