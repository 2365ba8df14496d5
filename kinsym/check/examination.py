"""All laws on one robot with one choice of its parameters.

Poses come from the exact forward kinematics of chosen joint vectors, rounded to float64, so that one solution is
known for each. The exact walk is slow and sees a share of them, of every kind.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.check.answers import Answers
from kinsym.check.batch import hold_batch, hold_single, hold_sweep
from kinsym.check.c_solver import CSolver
from kinsym.check.control import hold_nearest, hold_status
from kinsym.check.definition import hold_definition
from kinsym.check.edges import Edges, edges, hold_edges, hold_same_edges, hold_same_rough
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.interface import hold_interface, hold_same_marks
from kinsym.check.laws import CLOSURE, FORWARD, PATH, Judge
from kinsym.check.ledger import Ledger
from kinsym.check.nominal import with_nominal_samples
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import (
    KINDS,
    NOMINAL,
    QUARTER,
    SINGULAR,
    UNIFORM,
    Counts,
    generator,
    held_samples,
    lengths_of,
)
from kinsym.check.questions import Questions, asked
from kinsym.check.shapes import hold_shapes
from kinsym.check.single import FINENESS, SinglePrecision, SingleSolver
from kinsym.check.singular import volume_of
from kinsym.check.singular_set import hold_singular_set
from kinsym.check.solvers import Floats, Solutions, Solver
from kinsym.check.strange import (
    NOISE,
    TILTED_POSES,
    TILTS,
    hold_far,
    hold_noise,
    hold_refusals,
    hold_tilted,
    tilted,
)
from kinsym.check.table import TableKinematics
from kinsym.check.task import sifted, task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.check.vanishing import Special, hold_regular, hold_special, special_values
from kinsym.emit.schedule import Schedule
from kinsym.robot.model import Robot

Rows = NDArray[np.intp]

TABLE_POSES = 24
JACOBIAN_POSES = 5
SINGLE_POSES, SINGLE_NOISY, SINGLE_TILTED = 60, 8, 4
NOISE_POSES = 60
SET_POSES = 40
#: Known to so few digits nearly every root is made sure of.
ROUGH, ROUGH_POSES = 2e-7, 24
#: A closed form must call a pose singular where the least singular value is so small a share of the largest, and the
#: next one so large that rounding is seldom made larger than the tolerance on its way to the step that finds it.
LAST_DIGITS, FIRM = 3e-15, 0.02
#: The sequence of random numbers for special values of the parameters.
SPECIAL_VALUES = 2000

FORWARD_LAW = "forward kinematics equal the exact ones"
JACOBIAN_LAW = "Jacobian equals the exact one"
ERROR_LAW = "runs without an error"


class Examination:
    """One choice of parameters held to every law."""

    def __init__(
        self,
        *,
        robot: Robot,
        schedule: Schedule,
        parameters: Mapping[str, Fraction],
        number: int,
        counts: Counts,
        targets: list[Solver],
        ledger: Ledger,
    ) -> None:
        self.schedule, self.ledger, self.targets, self.counts = schedule, ledger, targets, counts
        self.robot, self.number, self.parameters = robot, number, parameters
        self.rng = generator(schedule.digest, number)
        self.table = TableKinematics(robot, parameters)
        self.kinematics = TreeKinematics(schedule, parameters)
        self.exact = ExactSolver(schedule, parameters)
        revolute = np.array([joint.kind == "R" for joint in schedule.joints])
        self.judge = Judge(
            self.kinematics, schedule.task, revolute, float(schedule.tau), CLOSURE if sifted(schedule) else PATH
        )
        self.samples = held_samples(schedule, self._volume, self.kinematics.size, counts, self.rng)
        if schedule.nominal:
            self.samples = with_nominal_samples(self.samples, schedule.nominal, self.kinematics, counts, self.rng)
        self.q = self.samples.q
        self.poses = self.exact.forward(self.q)
        self.solution_counts: Counter[int] = Counter()
        self.every = np.arange(len(self.q))
        #: Those that the exact walk sees, which is slow.
        self.some = self.every[:: max(1, len(self.every) // counts.exact)]
        self._slopes = self.rng.permutation(len(self.q))[:JACOBIAN_POSES]
        self._noisy_poses = self._noisy(self.poses[:NOISE_POSES], NOISE)
        self._tilted_poses = np.concatenate([tilted(self.poses[:TILTED_POSES], angle) for angle in TILTS])
        self._rough_poses = self._noisy(self.poses[:ROUGH_POSES], ROUGH)
        self._rows = self.rng.permutation(len(self.q))[:TABLE_POSES]
        self.answers = Answers(
            schedule=schedule, judge=self.judge, samples=self.samples, poses=self.poses, volume=self._volume
        )
        #: What each target says of the poses in :attr:`_questions`.
        self._marks: dict[str, list[Any]] = {}
        #: Each target's answers to the poses in :attr:`_edges`.
        self._beside: dict[str, Solutions] = {}
        #: Each target's answers to the poses in :attr:`_rough_poses`.
        self._rough: dict[str, Solutions] = {}

    def run(self) -> None:
        """Every law on every target."""
        oracle = self.hold_exact()
        answers = {}
        for target in self.targets:
            answer = None if isinstance(target, SingleSolver) else self.hold(target)
            if answer is not None:
                answers[target.name] = answer
        self.hold_agreement(oracle, answers)
        self.hold_single_precision(oracle, answers)
        self._count_solutions(next(iter(answers.values()))[1] if answers else None, oracle[1])

    def hold_exact(self) -> Solutions:
        """The laws of the exact walk, and its answers to the poses it sees."""
        hold_definition(self.ledger, self.exact, self.table, q=self.q[self._rows], slopes=self.q[self._slopes])
        if self.number == 0 and not self.schedule.general:
            hold_regular(self.ledger, self.exact.name, self._special)
        oracle = self.exact.inverse(self.poses[self.some], self.q[self.some])
        self.answers.hold(self.ledger, self.exact.name, oracle, self.some)
        hold_refusals(self.ledger, self.exact, self.poses[0])
        return oracle

    def hold(self, target: Solver) -> Solutions | None:
        """The laws of one target, and its answers to all poses; one that raises fails :data:`ERROR_LAW`."""
        every, some = self.every, self.some
        try:
            self._forward(target, self._slopes)
            hold_singular_set(self.ledger, target, self.schedule, self.parameters, self.q[:SET_POSES])
            answer = target.inverse(self.poses, self.q)
            self.answers.hold(self.ledger, target.name, answer, every)
            hold_refusals(self.ledger, target, self.poses[0])
            hold_far(self.ledger, target, self.exact, self.answers)
            hold_tilted(self.ledger, target, self.answers, self._tilted_poses)
            if not sifted(self.schedule):
                hold_noise(self.ledger, target, self.answers, self._noisy_poses)
            if isinstance(target, NumpySolver):
                general, first = self.schedule.general is not None, some[:SINGLE_POSES]
                # some with a rotation that is known to fewer digits, some that may be none of the arm's
                more = (self._noisy_poses[:SINGLE_NOISY], self._tilted_poses[-SINGLE_TILTED:])
                poses = np.concatenate([self.poses[first], *more])
                reference = np.concatenate([self.q[first], self.q[:SINGLE_NOISY], self.q[:SINGLE_TILTED]])
                hold_single(self.ledger, target, self.judge, poses=poses, reference=reference, general=general)
                if self.schedule.inputs:
                    hold_sweep(self.ledger, target, pose=self.poses[first[0]], q=self.q[first])
                hold_shapes(self.ledger, target, poses=self.poses, q=self.q, general=general)
            if isinstance(target, CSolver):
                strange = np.concatenate([self._noisy_poses, self._tilted_poses])
                hold_batch(self.ledger, target, self.judge, poses=self.poses, q=self.q, strange=strange)
            if isinstance(target, NumpySolver | CSolver):
                # every target is asked the same
                rng = deepcopy(self.rng)
                hold_nearest(self.ledger, target, self.judge, poses=self.poses[some], q=self.q[some], rng=rng)
                self._marks[target.name] = hold_interface(self.ledger, target, self._questions, rng)
                self._beside[target.name] = hold_edges(self.ledger, target, self.judge, self._edges)
                if not (self.schedule.general or sifted(self.schedule)):
                    self._rough[target.name] = target.inverse(self._rough_poses, self.q[: len(self._rough_poses)])
                if self.number == 0:
                    hold_special(self.ledger, target, self._special)
        except Exception as error:  # generated code that was edited may raise anything
            self.ledger.fail(ERROR_LAW, target.name, f"{type(error).__name__}: {error}")
            return None
        return answer

    def hold_agreement(self, oracle: Solutions, answers: Mapping[str, Solutions]) -> None:
        """Whether the targets' answers agree with each other and with the exact walk's."""
        uniform = self.samples.of(UNIFORM)
        hold_status(
            self.ledger,
            self.targets,
            answers,
            poses=self.poses,
            q=self.q,
            size=self.kinematics.size,
            uniform=uniform,
            which=self.some,
            singular=self._exactly,
        )
        for name in list(answers)[1:]:
            own = next(iter(answers))
            self.answers.agree(self.ledger, f"{own} and {name}", answers[own], answers[name], self.every)
            if own in self._marks and name in self._marks:
                plain = self._questions.plain
                hold_same_marks(self.ledger, f"{own} and {name}", self._marks[own], self._marks[name], plain)
            if own in self._beside and name in self._beside:
                hold_same_edges(self.ledger, f"{own} and {name}", self._beside[own], self._beside[name])
            if own in self._rough and name in self._rough:
                hold_same_rough(self.ledger, f"{own} and {name}", self._rough[own], self._rough[name], self.judge)
        for name, (q, count) in answers.items():
            self.answers.agree(
                self.ledger, f"exact walk and {name}", oracle, (q[self.some], count[self.some]), self.some
            )

    def hold_single_precision(self, oracle: Solutions, answers: Mapping[str, Solutions]) -> None:
        """The laws of C in single precision, where there is one."""
        others = {self.exact.name: (oracle, self.some)} | {name: (each, self.every) for name, each in answers.items()}
        for target in self.targets:
            if isinstance(target, SingleSolver):
                laws = SinglePrecision(
                    ledger=self.ledger, judge=self.judge, samples=self.samples, poses=self.poses, answers=others
                )
                try:
                    laws.hold(target, replace(self._questions, fine=FINENESS), deepcopy(self.rng))
                except Exception as error:  # generated code that was edited may raise anything
                    self.ledger.fail(ERROR_LAW, target.name, f"{type(error).__name__}: {error}")

    def poses_by_kind(self) -> dict[str, int]:
        """How many poses of each kind were tried."""
        kinds = [kind for kind in KINDS if kind != NOMINAL or self.schedule.nominal]
        return {kind: int(self.samples.of(kind).sum()) for kind in kinds}

    def _volume(self, q: Floats) -> Floats:
        return volume_of(self._slope(q)[..., self.kinematics.free])

    def _slope(self, q: Floats) -> Floats:
        """The task's Jacobians (m, k, n) of joint vectors (m, n)."""
        pose, jacobian = self.kinematics.forward(q), self.kinematics.jacobian(q)
        return task_jacobian(jacobian, pose, self.schedule.task, self.kinematics.size)

    @cached_property
    def _questions(self) -> Questions:
        """What is asked of one pose at a time."""
        rows, plain = asked(self.samples, general=self.schedule.general is not None)
        return Questions(schedule=self.schedule, judge=self.judge, poses=self.poses[rows], q=self.q[rows], plain=plain)

    @cached_property
    def _edges(self) -> Edges:
        """Poses on both sides of borders; of an arm without a closed form none."""
        exactly = (self.samples.offset == 0.0) & (self.schedule.general is None)
        # arms that are folded or stretched stand at quarter turns, if anywhere
        aimed = [self.q[exactly & self.samples.of(kind)] for kind in (QUARTER, SINGULAR)]
        return edges(self.judge, self.schedule.task, np.concatenate(aimed))

    @cached_property
    def _exactly(self) -> Rows:
        """The samples at which the task loses one motion to the last digits; of an arm without a closed form none."""
        aimed = np.flatnonzero(self.samples.of(SINGULAR) & (self.samples.offset == 0.0))
        if self.schedule.general or not len(aimed):
            return aimed[:0]
        unit = np.where(self.judge.revolute, 1.0, self._length)[self.kinematics.free]
        slopes = self._slope(self.q[aimed])[..., self.kinematics.free] * unit
        height = np.linalg.svd(slopes, compute_uv=False)
        alone = (height[:, -2:-1] > FIRM * height[:, :1]).all(axis=1)
        return aimed[alone & (height[:, -1] <= LAST_DIGITS * height[:, 0])]

    @cached_property
    def _special(self) -> list[Special]:
        """Poses at special values of the parameters."""
        rng = generator(self.schedule.digest, SPECIAL_VALUES)
        every = special_values(self.schedule, self.parameters, lengths_of(self.robot))
        return [Special(self.schedule, values, self.q, self.judge, rng) for values in every]

    @property
    def _length(self) -> float:
        return self.kinematics.size if self.kinematics.size > 0 else 1.0

    def _forward(self, target: Solver, slopes: Rows) -> None:
        scale = np.ones_like(self.poses)
        scale[:, :3, 3] = np.maximum(np.abs(self.poses[:, :3, 3]).max(axis=1, keepdims=True), self._length)
        errors = np.abs((target.forward(self.q) - self.poses) / scale).max(axis=(1, 2))
        self.ledger.judge(FORWARD_LAW, target.name, errors, FORWARD)
        exact = self.exact.jacobian(self.q[slopes])
        errors = np.abs(target.jacobian(self.q[slopes]) - exact).max(axis=(1, 2)) / max(1.0, float(np.abs(exact).max()))
        self.ledger.judge(JACOBIAN_LAW, target.name, errors, FORWARD)

    def _noisy(self, poses: Floats, size: float) -> Floats:
        noisy = poses.copy()
        noisy[:, :3, :3] += self.rng.uniform(-size, size, (len(noisy), 3, 3))
        return noisy

    def _count_solutions(self, numbers: Rows | None, oracle: Rows) -> None:
        uniform = self.samples.of(UNIFORM)
        self.solution_counts.update((oracle[uniform[self.some]] if numbers is None else numbers[uniform]).tolist())
