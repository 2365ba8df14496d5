"""Arms with more joints than their task can tell: which joints to lock.

A redundant arm reaches a pose in infinitely many ways. With as many joints locked as it has to spare it has finitely
many; which choices leave an arm with a closed form is found by trying them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from kinsym.deadline import Deadline
from kinsym.errors import NoClosedForm
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.inverse.state import FIXED, NO_LIMIT
from kinsym.kinematics.chain import Chain, chain_to_solve
from kinsym.kinematics.tasks import rank, told
from kinsym.robot.locking import lock_text
from kinsym.robot.model import Robot, Task

MOST_TRIES = 12
BUDGET = 12


@dataclass(frozen=True)
class Choice:
    """Joints to lock and the closed form that they leave."""

    joints: tuple[str, ...]
    plan: Plan

    @property
    def order(self) -> tuple[int, int]:
        """Few solutions first, then low degree."""
        return self.plan.maximum, max(step.branches for step in self.plan.steps)

    def __str__(self) -> str:
        count = self.plan.maximum
        return f"{' and '.join(self.joints)} ({count} solution{'s' if count > 1 else ''})"


def check_redundancy(robot: Robot, chain: Chain, deadline: Deadline = NO_LIMIT) -> None:
    """Raise :class:`NoClosedForm` if the joints of ``chain`` are more than the robot's task can tell.

    The message names the joints whose lock leaves a closed form, and the command for the best of them.
    """
    task = robot.task or Task.POSE
    rows = told(chain, task)
    count, ways = len(chain.joints), rank(rows)
    if count <= ways:
        return
    spare = count - ways
    what = f"{count} joints{' that are not locked' if robot.locks else ''}"
    if ways >= FIXED[task]:
        head = f"{what} are more than the {ways} that the task {task.value} fixes"
    else:
        head = f"the {what} move the end effector in only {ways} independent ways, at every pose"
    head += f", so {spare} must be locked: as an input of the solver, or at a value"
    tried = _tries(robot, rows, spare)
    found = [Choice(joints, plan) for joints in tried if (plan := _plan(_locked(robot, joints), task, deadline))]
    if not found:
        listed = _listed(sorted(map(" and ".join, tried)))
        raise NoClosedForm(f"{head}. No closed form was found with {listed} locked{_without(robot, task, ways, tried)}")
    best = min(found, key=lambda choice: choice.order)
    listed = _listed([str(choice) for choice in sorted(found, key=lambda c: [*map(robot.variables.index, c.joints)])])
    options = " ".join(_options(_locked(robot, best.joints)))
    raise NoClosedForm(f"{head}. There is a closed form with {listed} locked. Add for example {options}")


def _without(robot: Robot, task: Task, ways: int, tried: Sequence[tuple[str, ...]]) -> str:
    """That six joints are solved without a closed form as well, and how to ask for it."""
    if not tried or task is not Task.POSE or ways < FIXED[task]:
        return ""
    options = " ".join(_options(_locked(robot, tried[0])))
    return f"; six joints can be solved without one. Add for example {options}"


def _tries(robot: Robot, rows: list[list[int]], spare: int) -> list[tuple[str, ...]]:
    """What to lock so that the rest can be told, at most MOST_TRIES choices.

    A slide comes first, then joints in the middle, where an elbow turns.
    """
    slides = {joint.variable for joint in robot.moving if joint.kind == "P"}
    middle = len(robot.variables) + 1
    away = {name: abs(2 * number - middle) for number, name in enumerate(robot.variables, start=1)}
    free = [name for name in robot.variables if name not in robot.locks]
    columns = dict(zip(free, zip(*rows, strict=True), strict=True))

    def rest_is_told(choice: tuple[str, ...]) -> bool:
        rest = [list(column) for name, column in columns.items() if name not in choice]
        return rank(rest) == len(rest)

    choices = filter(rest_is_told, combinations(free, spare))
    ordered = sorted(choices, key=lambda c: (-sum(name in slides for name in c), sum(away[name] for name in c)))
    return ordered[:MOST_TRIES]


def _locked(robot: Robot, joints: tuple[str, ...]) -> Robot:
    locks = {**robot.locks, **dict.fromkeys(joints)}
    return replace(robot, locks={name: locks[name] for name in robot.variables if name in locks})


def _plan(robot: Robot, task: Task, deadline: Deadline) -> Plan | None:
    try:
        return derive_plan(chain_to_solve(robot), task, deadline, budget=BUDGET)
    except NoClosedForm:
        return None


def _options(robot: Robot) -> Iterator[str]:
    for name, value in robot.locks.items():
        yield f"--lock {name}" if value is None else f'--lock "{name}={lock_text(value)}"'


def _listed(items: list[str]) -> str:
    return " or ".join([", ".join(items[:-1]), items[-1]]) if len(items) > 1 else items[0]
