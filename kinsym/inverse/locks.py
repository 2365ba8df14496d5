"""Arms with more joints than their task can tell: which joints to lock.

A redundant arm reaches a pose in infinitely many ways. With as many joints locked as it has to spare it has finitely
many; which choices leave an arm with a closed form is found by trying them, in the order of the joints.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

from kinsym.algebra.tree import symbols
from kinsym.errors import NoClosedForm
from kinsym.inverse.plan import Plan
from kinsym.inverse.search import derive_plan
from kinsym.kinematics.chain import Chain, chain_to_solve
from kinsym.kinematics.tasks import told
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
    def order(self) -> tuple[int, int, int]:
        """Few solutions first, then low degree, then short formulas."""
        steps = self.plan.steps
        trees = [tree for step in steps for tree in step.inputs.values()]
        trees += [item.value for step in steps for item in step.coefficients]
        length = sum(len(list(symbols(tree))) for tree in trees)
        return self.plan.maximum, max(step.branches for step in steps), length

    def __str__(self) -> str:
        count = self.plan.maximum
        return f"{' and '.join(self.joints)} ({count} solution{'s' if count > 1 else ''})"


def check_redundancy(robot: Robot, chain: Chain) -> None:
    """Raise :class:`NoClosedForm` if the joints of ``chain`` are more than the robot's task can tell.

    The message names the joints whose lock leaves a closed form, and the command for the best of them.
    """
    task = robot.task or Task.POSE
    count, ways = len(chain.joints), told(chain, task)
    if count <= ways:
        return
    spare = count - ways
    head = (
        f"the {count} joints{' that are not locked' if robot.locks else ''} move what the task {task.value} asks for in "
        f"only {ways} independent ways, so {spare} of them must be locked: an input of the solver, or held at a value"
    )
    tried = list(_tries(robot, spare))
    found = [
        Choice(joints, plan) for joints in tried if (plan := _plan(_locked(robot, joints), task)) is not None
    ]
    if not found:
        raise NoClosedForm(f"{head}. No closed form was found with {_either(tried)} locked")
    best = min(found, key=lambda choice: choice.order)
    raise NoClosedForm(
        f"{head}. There is a closed form with {_listed([str(choice) for choice in found])}. "
        f"Add for example {' '.join(_options(_locked(robot, best.joints)))}"
    )


def _tries(robot: Robot, spare: int) -> Iterator[tuple[str, ...]]:
    """What to lock, in the order of the joints; of many choices those are tried that lie spread over all."""
    free = [name for name in robot.variables if name not in robot.locks]
    choices = list(combinations(free, spare))
    step = -(-len(choices) // MOST_TRIES)
    yield from choices[::step]


def _locked(robot: Robot, joints: tuple[str, ...]) -> Robot:
    locks = {**robot.locks, **dict.fromkeys(joints)}
    return replace(robot, locks={name: locks[name] for name in robot.variables if name in locks})


def _plan(robot: Robot, task: Task) -> Plan | None:
    chain = chain_to_solve(robot)
    if told(chain, task) < len(chain.joints):
        return None
    try:
        return derive_plan(chain, task, budget=BUDGET)
    except NoClosedForm:
        return None


def _options(robot: Robot) -> Iterator[str]:
    for name, value in robot.locks.items():
        yield f"--lock {name}" if value is None else f'--lock "{name}={lock_text(value)}"'


def _either(tried: list[tuple[str, ...]]) -> str:
    return _listed([" and ".join(joints) for joints in tried], last=" or ")


def _listed(items: list[str], last: str = " or ") -> str:
    return last.join([", ".join(items[:-1]), items[-1]]) if len(items) > 1 else items[0]
