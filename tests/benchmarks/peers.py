"""Peer libraries on the same arms and poses: EAIK, ssik, OPW (py-opw-kinematics) and ur-analytic-ik.

``python -m tests.benchmarks.peers --setup`` installs them into an environment of their own (``environment.py``); a line
says which are not there. They see the joint axes at zero and the poses; the oracle of the coverage benchmark judges.
Only arms of six revolute joints are tried: the others are refused by all of them.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.laws import CLOSURE, PATH, Judge
from kinsym.check.task import closure
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.errors import NoClosedForm
from kinsym.robot import gallery, load
from kinsym.robot.model import Robot, Task
from tests.benchmarks.coverage.arms import CLASSES, arms
from tests.benchmarks.coverage.measure import parameters, singular_vectors, solver
from tests.benchmarks.coverage.oracle import SAME, Screws, distinct, gaps, multistart
from tests.benchmarks.coverage.table import HEADING, PAGE, joined
from tests.benchmarks.environment import FOLDER, interpreter, missing, setup

Floats = NDArray[np.float64]

PEERS = ("EAIK", "ssik", "OPW", "UR")
WORKER = Path(__file__).with_name("peer_worker.py")
SECONDS = 60
TAU = 2.0**-46
OWN = "kinsym"
SIX = 6
REASON = 48


@dataclass(frozen=True, kw_only=True)
class Subject:
    """One arm with its poses: the first ``ordinary`` are random, the rest singular or next to it."""

    group: str
    robot: Robot
    screws: Screws
    q: Floats
    poses: Floats
    ordinary: int


def subject(group: str, robot: Robot, poses: int, seed: int) -> Subject:
    """An arm with random joint vectors and with singular ones."""
    screws = Screws(robot, parameters(robot))
    rng = np.random.default_rng([seed, len(robot.name), *robot.name.encode()])
    q = rng.uniform(-np.pi, np.pi, (poses, screws.count))
    special = [vectors for _, _, vectors in singular_vectors(screws, Task.POSE, rng)]
    every = np.concatenate([q, *special])
    return Subject(group=group, robot=robot, screws=screws, q=every, poses=screws.forward(every), ordinary=poses)


def ask(peer: str, item: Subject, folder: Path) -> dict[str, Any]:
    """The peer's answer for one arm, in a process of its own that has :data:`SECONDS`."""
    job = {"peer": peer, "arms": [_description(item)]}
    command = [str(interpreter(folder)), str(WORKER)]
    try:
        finished = subprocess.run(
            command, input=json.dumps(job), capture_output=True, text=True, timeout=SECONDS, check=True
        )
        (answer,) = json.loads(finished.stdout.splitlines()[-1])
    except subprocess.TimeoutExpired:
        return {"refused": f"no answer in {SECONDS} s"}
    except (OSError, subprocess.SubprocessError, ValueError, LookupError) as error:
        return {"refused": f"not run: {type(error).__name__}"}
    return dict(answer)


def own(subjects: list[Subject]) -> list[dict[str, Any]]:
    """kinsym's answers in the same form."""
    answers: list[dict[str, Any]] = []
    for item in subjects:
        try:
            schedule = build_schedule(derive(item.robot))
        except NoClosedForm as error:
            answers.append({"refused": str(error)})
            continue
        with tempfile.TemporaryDirectory(prefix="kinsym-peers-") as folder:
            q, counts = solver(schedule, parameters(item.robot), Path(folder)).inverse(item.poses, item.q)
        answers.append({"solutions": [q[row, :count].tolist() for row, count in enumerate(counts)]})
    return answers


def compared(subjects: list[Subject], answers: dict[str, list[dict[str, Any]]], starts: int) -> list[str]:
    """The table: for each arm what each library finds of all that any of them and the oracle find."""
    lines = [f"| arm | there | {' | '.join(answers)} |", "|---" * (len(answers) + 2) + "|"]
    for number, item in enumerate(subjects):
        given = {name: answer[number] for name, answer in answers.items()}
        good = {name: _good(item, answer) for name, answer in given.items() if "solutions" in answer}
        rng = np.random.default_rng(number)
        oracle = multistart(item.screws, Task.POSE, item.q[: item.ordinary], starts, rng)
        there = [
            distinct(
                item.screws, np.concatenate([item.q[row : row + 1], found, *(each[row] for each in good.values())])
            )
            for row, found in enumerate(oracle)
        ]
        cells = [_cell(item, given[name], good.get(name), there) for name in answers]
        name = f"{item.group}, {item.robot.name}"
        lines.append(f"| {name} | {sum(map(len, there))} | {' | '.join(cells)} |")
    return lines


def _cell(item: Subject, answer: dict[str, Any], good: list[Floats] | None, there: list[Floats]) -> str:
    if good is None:
        return f"refused ({answer['refused'].splitlines()[0][:REASON]})"
    found = sum(
        int((gaps(item.screws, all_, some).min(axis=1, initial=np.inf) <= SAME).sum())
        for all_, some in zip(there, good, strict=False)
    )
    wrong = sum(len(given) - len(kept) for given, kept in zip(answer["solutions"], good, strict=True))
    special = slice(item.ordinary, None)
    width = max([len(kept) for kept in good], default=0) or 1
    padded = np.full((len(good), width, item.screws.count), np.nan)
    for row, kept in enumerate(good):
        padded[row, : len(kept)] = kept
    judge = Judge(item.screws, Task.POSE, item.screws.revolute, TAU, PATH)  # type: ignore[arg-type]
    lost = int((~judge.found(padded[special], item.q[special], item.poses[special])).sum())
    empty = sum(not len(kept) for kept in good[special])
    return f"{found}; {wrong} wrong; singular {len(good[special])}, {empty} unanswered, {lost} lost"


def _good(item: Subject, answer: dict[str, Any]) -> list[Floats]:
    """Of each pose the solutions that lead to it."""
    kept = []
    for pose, given in zip(item.poses, answer["solutions"], strict=True):
        q = np.array(given, dtype=np.float64).reshape(-1, item.screws.count)
        with np.errstate(invalid="ignore"):
            off = closure(item.screws.forward(q), pose, Task.POSE, item.screws.size)
        kept.append(q[off <= CLOSURE])
    return kept


def _description(item: Subject) -> dict[str, Any]:
    points = np.concatenate([np.zeros((1, 3)), item.screws.points, item.screws.home[None, :3, 3]])
    return {
        "name": item.robot.name,
        "axes": item.screws.axes.tolist(),
        "offsets": np.diff(points, axis=0).tolist(),
        "home": item.screws.home[:3, :3].tolist(),
        "lengths": {name: float(value) for name, value in parameters(item.robot).items()},
        "poses": item.poses.tolist(),
        "known": item.q[0].tolist(),
    }


def report(folder: Path, *, poses: int, starts: int, each: int, seed: int) -> list[str]:
    """The lines of the section: gallery arms of six revolute joints and ``each`` random arms of each such class."""
    robots = [("gallery", load(name)) for name in gallery()]
    robots += [(group, robot) for group in CLASSES for robot in arms(group, each, seed)]
    wanted = [(group, robot) for group, robot in robots if [joint.kind for joint in robot.moving] == ["R"] * SIX]
    subjects = [subject(group, robot, poses, seed) for group, robot in wanted]
    answers = {OWN: own(subjects)}
    absent = missing(folder)
    for peer in (name for name in PEERS if name not in absent):
        answers[peer] = [ask(peer, item, folder) for item in subjects]
    left_out = [f"Not asked: {name} ({absent[name]})." for name in PEERS if name in absent]
    return [*LEGEND, "", *left_out, *compared(subjects, answers, starts)]


LEGEND = (
    "Solutions found of those *there* at random poses (known, found from random starts, or proved to be one by whoever",
    "found it), wrong ones at all poses, and singular poses as in the tables above: how many, without an exact answer,",
    "with the known vector lost. EAIK's answers that it marks as least squares are left out.",
)


def main() -> None:
    """Set up, or print the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.peers", description=__doc__)
    parser.add_argument("--setup", action="store_true", help="install the peers")
    parser.add_argument("--environment", type=Path, default=FOLDER, help=f"where ({FOLDER})")
    parser.add_argument("--poses", type=int, default=5)
    parser.add_argument("--starts", type=int, default=200)
    parser.add_argument("--arms", type=int, default=1, help="random arms of each class (1)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true", help=f"also write the section of {PAGE.name}")
    options = parser.parse_args()
    if options.setup:
        sys.exit(1 if set(PEERS) & set(setup(options.environment)) else 0)
    numbers = {"poses": options.poses, "starts": options.starts, "arms": options.arms, "seed": options.seed}
    command = " ".join(["python -m tests.benchmarks.peers", *(f"--{key} {value}" for key, value in numbers.items())])
    lines = report(
        options.environment, poses=options.poses, starts=options.starts, each=options.arms, seed=options.seed
    )
    text = "\n".join([HEADING, "", f"Printed by `{command}`.", "", *lines]) + "\n"
    print(text, end="")
    if options.write:
        PAGE.write_text(joined(PAGE.read_text(encoding="utf-8"), text), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
