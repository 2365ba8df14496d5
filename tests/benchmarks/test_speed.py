"""The benchmark of speed: its arms are the gallery's, its judge sees what is wrong, its tables say what is missing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from kinsym.robot import load
from tests.benchmarks import environment
from tests.benchmarks.coverage.measure import parameters
from tests.benchmarks.coverage.oracle import Screws
from tests.benchmarks.speed.arms import ARMS
from tests.benchmarks.speed.entries import Entry, Goal, Group, Library, Refusal
from tests.benchmarks.speed.judge import judged
from tests.benchmarks.speed.own import robot_of
from tests.benchmarks.speed.page import lines_of
from tests.benchmarks.speed.plot import chart

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("name", ARMS)
def test_the_arms_are_what_kinsym_is_given(name: str) -> None:
    """The product of matrices equals the product of exponentials of the robot's screws; so do the Jacobians."""
    arm = ARMS[name]
    for bound in (True, False):
        screws = Screws(robot_of(arm, bound=bound))
        q = arm.sample(20, seed=2)
        assert np.abs(arm.forward(q) - screws.forward(q)).max() < 1e-12
        assert np.abs(arm.jacobian(q) - screws.jacobian(q)).max() < 1e-12


@pytest.mark.parametrize("name", ["puma560", "ur5"])
def test_the_arms_are_those_of_the_gallery(name: str) -> None:
    """Same lengths, same frames."""
    robot = load(name)
    screws = Screws(robot, parameters(robot))
    q = ARMS[name].sample(20, seed=3)
    assert np.abs(ARMS[name].forward(q) - screws.forward(q)).max() < 1e-12


def test_the_judge_sees_a_wrong_answer() -> None:
    """A solution that is off is counted, one more or less changes the mean, a wrong matrix is found."""
    arm = ARMS["puma560"]
    q = arm.sample(4, seed=1)
    poses = arm.forward(q)
    right = [row[None] for row in q]
    assert judged("ik", "puma560", poses, right).wrong == 0
    assert judged("ik", "puma560", poses, right).worst < 1e-14
    off = [*right[:3], np.concatenate([right[3], right[3] + 1e-3])]
    assert (judged("ik", "puma560", poses, off).wrong, judged("ik", "puma560", poses, off).mean) == (1, 1.25)
    assert judged("ik", "puma560", poses, [np.empty((0, 6))] * 4).mean == 0.0
    for kind, matrices in (("fk", poses), ("jacobian", arm.jacobian(q))):
        rows = [matrix.reshape(1, -1) for matrix in matrices]
        assert judged(kind, "puma560", q, rows).wrong == 0
        rows[2] = rows[2] + 1e-3
        assert judged(kind, "puma560", q, rows).wrong == 1


def group(*goals: Goal) -> Group:
    """Three entries, of which one was refused."""
    program = Library(path=Path("none"), rows=1, width=16)
    entries = [Entry(name=name, arm="puma560", program=program, number=2) for name in ("one", "two")]
    refused = Entry(name="three", arm="puma560", program=Refusal(why="no wheel | none"), number=2)
    q = ARMS["puma560"].sample(2, seed=1)
    return Group(title="C", arm="puma560", kind="fk", inputs=q, entries=(*entries, refused), goals=goals)


def test_lines_tell_ratios_goals_and_refusals() -> None:
    """Ratios turn by turn, goals met and missed, to the first entry and to another; a refusal has a line."""
    item = group(
        Goal(entry="two", ratio=2.0), Goal(entry="two", ratio=1.5, most=True), Goal(entry="one", ratio=1.0, over="two")
    )
    answer = [row.reshape(1, -1) for row in ARMS["puma560"].forward(item.inputs)]
    results = {
        "one": {"seconds": [1e-9, 2e-9, 9e-9], "answer": answer},
        "two": {"seconds": [2e-9, 4e-9, 9e-9], "answer": answer},
        "three": {"refused": "no wheel"},
    }
    one, two, three = lines_of(item, results)
    assert (one.ratio, two.ratio) == (1.0, 2.0)
    assert two.nanoseconds == pytest.approx(4.0)
    assert two.goals == (">= 2", "<= 1.5: missed, 2.00")
    assert one.goals == (">= 1 x two: missed, 0.50",)
    assert (three.ratio, three.answers) == (None, "no wheel")
    with pytest.raises(RuntimeError, match="no compiler"):
        lines_of(item, {**results, "one": {"refused": "no compiler"}})


def test_the_plot_is_drawn_to_scale() -> None:
    """A decade is as long wherever it is; names are text."""
    text = chart([("C & C++", [("kinsym", 10.0), ("other <1>", 100.0), ("third", 1000.0)])])
    widths = [
        float(part.split('"')[0]) for part in text.split(' height="16"')[0:-1] for part in [part.split('width="')[-1]]
    ]
    assert widths == [1.0, 210.0, 420.0]
    assert "C &amp; C++" in text
    assert "other &lt;1&gt;" in text


def test_an_environment_that_is_not_there(tmp_path: Path) -> None:
    """Every library is named with the reason."""
    assert environment.missing(tmp_path) == dict.fromkeys(environment.PACKAGES, "not set up")


def test_the_command_runs_without_any_peer(tmp_path: Path) -> None:
    """kinsym's own entries are compiled, timed and verified; every peer has a line that says that it is missing."""
    options = ["--environment", str(tmp_path), "--arm", "stanford", "--turns", "1", "--runs", "1", "--crowd", "50"]
    command = [sys.executable, "-m", "tests.benchmarks.speed", *options]
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stderr
    own = [line for line in finished.stdout.splitlines() if line.startswith("| Stanford arm | kinsym")]
    assert len(own) >= 8
    assert all(" 0 wrong" in line for line in own)
    for name in environment.PACKAGES:
        assert f"| {name} | | | refused: not set up |" in finished.stdout
