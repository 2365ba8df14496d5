"""One arm measured: derived or refused, solutions found of those there are, closures, singular poses.

The solver under test is the generated C where a compiler is found, else the generated NumPy module. Poses come from the
oracle's forward kinematics, and what counts as a solution is decided by it as well.
"""

from __future__ import annotations

import ctypes
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import compile_shared, find_compiler
from kinsym.check.laws import CLOSURE, PATH, Judge
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.singular import volume_of, zeros
from kinsym.check.solvers import Solver
from kinsym.check.task import closure, sifted, task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.errors import KinsymError, NoClosedForm
from kinsym.robot.model import Robot, Task
from tests.benchmarks.coverage.oracle import SAME, Screws, distinct, gaps, multistart

Floats = NDArray[np.float64]

DISTANCES = (0.0, *(10.0**-k for k in range(3, 16)))
#: Joint vectors from which singular ones are sought, and how many are kept for each joint that is moved to reach them.
BASES, KEPT = 6, 2
#: Seconds after which a derivation counts as broken; an arm takes 5 at most on a quiet machine.
DEADLINE = 120.0


@dataclass(frozen=True, kw_only=True)
class Effort:
    """How much is spent on one arm: random poses, starts of the oracle for each, the seed."""

    poses: int
    starts: int
    seed: int


@dataclass(kw_only=True)
class Result:
    """What came out for one arm.

    ``kind`` is "closed form", "degree N" for a step with a polynomial of degree N > 2, "refused" or "broken";
    ``seconds`` are processor time, so that a busy machine does not matter; ``there`` and ``found`` count solutions at
    random poses; ``singular`` counts outcomes by (joint moved, distance).
    """

    group: str
    name: str
    kind: str
    reason: str = ""
    seconds: float = 0.0
    there: int = 0
    found: int = 0
    unanswered: int = 0
    wrong: int = 0
    copies: int = 0
    broken: int = 0
    closures: list[float] = field(default_factory=list)
    singular: dict[tuple[str, float], Counter[str]] = field(default_factory=dict)

    @property
    def singular_total(self) -> Counter[str]:
        """The outcomes of all singular poses together."""
        return sum(self.singular.values(), Counter())


def measure(group: str, robot: Robot, effort: Effort) -> Result:
    """Derive, emit, compile and try one arm."""
    start = time.process_time()
    try:
        derivation = derive(robot, deadline=DEADLINE)
        schedule = build_schedule(derivation)
    except NoClosedForm as error:
        return Result(
            group=group, name=robot.name, kind="refused", reason=str(error), seconds=time.process_time() - start
        )
    except (KinsymError, ArithmeticError, AssertionError, LookupError, TypeError, ValueError) as error:
        return Result(group=group, name=robot.name, kind="broken", reason=f"{type(error).__name__}: {error}")
    result = Result(group=group, name=robot.name, kind=kind_of(derivation), seconds=time.process_time() - start)
    with tempfile.TemporaryDirectory(prefix="kinsym-coverage-") as folder:
        values = parameters(robot)
        trial = Trial(robot, schedule, values, solver(schedule, values, Path(folder)), effort)
        trial.random_poses(result)
        trial.singular_poses(result)
    return result


def kind_of(derivation: Derivation) -> str:
    """ "closed form", or the degree of the polynomial that is solved."""
    if derivation.plan is None:
        return "degree 8" if derivation.general and derivation.general.suppressed else "degree 16"
    most = max((step.branches for step in derivation.plan.steps), default=1)
    return f"degree {most}" if most > 2 else "closed form"


def parameters(robot: Robot) -> dict[str, Fraction]:
    """The table's values, and 0.3, 0.37, 0.44, ... where it has none."""
    return {
        name: Fraction(30 + 7 * index, 100) if value is None else value
        for index, (name, value) in enumerate(robot.parameters.items())
    }


def solver(schedule: Schedule, values: dict[str, Fraction], folder: Path) -> Solver:
    """The generated C, compiled in ``folder``, or the NumPy module where there is no compiler."""
    language = "c" if find_compiler() else "numpy"
    for name, text in TARGETS[language](schedule).items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    if language == "numpy":
        return NumpySolver(NumpySolver.load(folder / f"{schedule.name}.py"), schedule, values)
    return CSolver(ctypes.CDLL(str(compile_shared(folder, schedule.name, folder))), schedule, values)


class Trial:
    """One arm with values for its parameters, its solver and the oracle."""

    def __init__(
        self, robot: Robot, schedule: Schedule, values: dict[str, Fraction], solver: Solver, effort: Effort
    ) -> None:
        self.schedule, self.solver, self.effort = schedule, solver, effort
        self.screws = Screws(robot, values)
        self.rng = np.random.default_rng([effort.seed, int(schedule.digest, 16)])
        path = CLOSURE if sifted(schedule) else PATH
        # the judge asks for forward kinematics, Jacobian and size, which the oracle has under the same names
        kinematics = cast(TreeKinematics, self.screws)
        self.judge = Judge(kinematics, schedule.task, self.screws.revolute, float(schedule.tau), path)

    def random_poses(self, result: Result) -> None:
        """Every solution at random poses, against the oracle's and the known one."""
        q = self._uniform(self.effort.poses)
        poses = self.screws.forward(q)
        answers, counts = self.solver.inverse(poses, np.where(self.screws.free, 0.0, q))
        others = multistart(self.screws, self.schedule.task, q, self.effort.starts, self.rng)
        result.copies += self.judge.copies(answers)
        for row, pose in enumerate(poses):
            own = answers[row, : counts[row]]
            off = self._closure(own, pose)
            good = own[off <= CLOSURE]
            result.broken += int((~np.isfinite(off)).sum())
            result.wrong += int((off > CLOSURE).sum())
            result.unanswered += not len(good)
            result.closures += off[off <= CLOSURE].tolist()
            all_ = distinct(self.screws, np.concatenate([q[row : row + 1], good, others[row]]))
            result.there += len(all_)
            result.found += int((gaps(self.screws, all_, good).min(axis=1, initial=np.inf) <= SAME).sum())

    def singular_poses(self, result: Result) -> None:
        """Joint vectors at and next to zeros of the task's Jacobian, by the joint that was moved to reach them."""
        for joint, distance, q in singular_vectors(self.screws, self.schedule.task, self.rng):
            result.singular[self.schedule.joints[joint].name, distance] = self._outcomes(q)

    def _outcomes(self, q: Floats) -> Counter[str]:
        poses = self.screws.forward(q)
        answers, counts = self.solver.inverse(poses, q)
        found = self.judge.found(answers, q, poses)
        outcomes: Counter[str] = Counter(poses=len(q), copies=self.judge.copies(answers))
        for row, pose in enumerate(poses):
            off = self._closure(answers[row, : counts[row]], pose)
            outcomes["answered"] += bool((off <= CLOSURE).any())
            outcomes["lost"] += not found[row]
            outcomes["wrong"] += bool((off > CLOSURE).any())
            outcomes["NaN"] += bool((~np.isfinite(off)).any())
        return outcomes

    def _closure(self, q: Floats, pose: Floats) -> Floats:
        """Lengths in arm sizes or, where a slide is drawn out further, in its: no number has more digits."""
        units = np.abs(np.where(self.screws.revolute, 0.0, q)).max(axis=-1, initial=self.screws.size)
        with np.errstate(invalid="ignore"):
            reached = self.screws.forward(q)
            off = [closure(T, pose, self.schedule.task, unit) for T, unit in zip(reached, units, strict=True)]
        return np.array(off, dtype=np.float64)

    def _uniform(self, count: int) -> Floats:
        return uniform(self.screws, count, self.rng)


def uniform(screws: Screws, count: int, rng: np.random.Generator) -> Floats:
    """Joint vectors (count, n): angles in (-pi, pi), lengths up to the arm's size, held joints stay."""
    drawn = rng.uniform(-1.0, 1.0, (count, screws.count)) * np.where(screws.revolute, np.pi, screws.size)
    return np.where(np.isnan(screws.held), drawn, screws.held)


def singular_vectors(screws: Screws, task: Task, rng: np.random.Generator) -> Iterator[tuple[int, float, Floats]]:
    """Joint vectors (k, n) at each distance from zeros of the task's Jacobian, with the joint moved to get there."""

    def volume(q: Floats) -> Floats:
        return volume_of(task_jacobian(screws.jacobian(q), screws.forward(q), task, screws.size)[..., screws.free])

    found, moved, _ = zeros(uniform(screws, BASES, rng), screws.revolute, screws.size, volume)
    for joint in np.flatnonzero(screws.free).tolist():
        special = found[moved == joint][:KEPT]
        for distance in DISTANCES if len(special) else ():
            q = special.copy()
            sign = rng.choice((-1.0, 1.0), len(q)) * rng.uniform(1.0, 3.0, len(q))
            q[:, joint] += sign * distance * (1.0 if screws.revolute[joint] else screws.size)
            yield joint, distance, q
