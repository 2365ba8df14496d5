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

from kinsym.check.batch import SINGLE_LAW, SINGLE_LIMIT, hold_batch
from kinsym.check.control import hold_nearest, hold_status
from kinsym.check.definition import hold_definition
from kinsym.check.edges import Edges, edges, hold_edges, hold_same_edges, hold_same_rough
from kinsym.check.interface import Questions, hold_interface, hold_same_marks
from kinsym.check.laws import CLOSURE, COPY, FORWARD, PATH, SAME, Judge, malformed, outward
from kinsym.check.ledger import Ledger
from kinsym.check.nominal import with_nominal_samples
from kinsym.check.poses import (
    KINDS,
    NOMINAL,
    PAIR,
    QUARTER,
    SINGULAR,
    UNIFORM,
    Counts,
    generator,
    held_samples,
    lengths_of,
    wrapped,
)
from kinsym.check.shapes import hold_shapes
from kinsym.check.singular import volume_of
from kinsym.check.singular_set import hold_singular_set
from kinsym.check.solvers import CSolver, ExactSolver, Floats, NumpySolver, Solutions, Solver, TreeKinematics
from kinsym.check.table import TableKinematics
from kinsym.check.task import sifted, task_jacobian
from kinsym.check.vanishing import Special, hold_special, special_values
from kinsym.emit.schedule import Schedule
from kinsym.robot.model import Robot, Task

Rows = NDArray[np.intp]

TABLE_POSES = 24
JACOBIAN_POSES = 5
SINGLE_POSES, SINGLE_NOISY = 60, 8
FAR_POSES = 12
NOISE_POSES = 60
SET_POSES = 40
MARKED_POSES, SPECIAL_POSES = 12, 36
#: A closed form must call a pose singular where the least singular value is so small a share of the largest, and the
#: next one so large that rounding is seldom made larger than the tolerance on its way to the step that finds it.
LAST_DIGITS, FIRM = 3e-15, 0.02
#: The sequence of random numbers for special values of the parameters.
SPECIAL_VALUES = 2000

#: Nearer to a singular pose than this, double roots merge (within 2 sqrt(2 tau)) and angles are soft.
MERGED = 1e-6
#: The closure allowed there on a way between two vectors that count as one solution; where two singularities meet,
#: solutions within tau^(1/4) of each other are one cluster, whose members miss the pose by the square of a third of it.
CLOSE_PATH = 1e-8
PAIR_PATH = 3e-6
#: At one in so many of the poses nearest to a singular one, rounding may lead one answer to a solution more.
MORE_SOLUTIONS = 100
AGREE_LIMIT = f"<= {SAME:g} or one double root; next to singular poses but for 1 in {MORE_SOLUTIONS}"

#: At one in so many of the poses next to singular ones of the nominal arm a solution may be missed.
MISSED = 100
#: What Newton's steps leave at a random pose.
ORDINARY = 1e-12

NOISE = 1e-9
#: Known to so few digits nearly every root is made sure of.
ROUGH, ROUGH_POSES = 2e-7, 24
#: Solutions whose volume is below this share of the usual one may be points of a curve of solutions.
REGULAR = 1e-3

FORWARD_LAW = "forward kinematics equal the exact ones"
JACOBIAN_LAW = "Jacobian equals the exact one"
INVERSE_LAW = "FK(IK(T)) = T for every solution"
FOUND_LAW = "the known joint vector is among the solutions"
CLOSE_LAW = "the same next to singular poses"
BESIDE_LAW = "the same at and next to singular poses of the nominal arm"
ORDINARY_LAW = "FK(IK(T)) = T to the last digits at random poses"
PAIR_LAW = "two singularities at once still have a solution"
COPY_LAW = "no solution twice"
RANGE_LAW = "angles in (-pi, pi]"
AGREE_LAW = "same solutions in the same order"
REFUSE_LAW = "what is no pose is refused"
FAR_LAW = "no solution beyond the reach"
NOISE_LAW = "rotations known to nine digits are solved"
SWEEP_LAW = "ik_sweep and ik_batch agree"
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
        self._rough_poses = self._noisy(self.poses[:ROUGH_POSES], ROUGH)
        self._rows = self.rng.permutation(len(self.q))[:TABLE_POSES]
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
            answer = self.hold(target)
            if answer is not None:
                answers[target.name] = answer
        self.hold_agreement(oracle, answers)
        self._count_solutions(next(iter(answers.values()))[1] if answers else None, oracle[1])

    def hold_exact(self) -> Solutions:
        """The laws of the exact walk, and its answers to the poses it sees."""
        hold_definition(self.ledger, self.exact, self.table, q=self.q[self._rows], slopes=self.q[self._slopes])
        oracle = self.exact.inverse(self.poses[self.some], self.q[self.some])
        self._inverse(self.exact, oracle, self.some)
        self._refusals(self.exact)
        return oracle

    def hold(self, target: Solver) -> Solutions | None:
        """The laws of one target, and its answers to all poses; one that raises fails :data:`ERROR_LAW`."""
        every, some = self.every, self.some
        try:
            self._forward(target, self._slopes)
            hold_singular_set(self.ledger, target, self.schedule, self.parameters, self.q[:SET_POSES])
            answer = target.inverse(self.poses, self.q)
            self._inverse(target, answer, every)
            self._refusals(target)
            self._unreachable(target)
            if not sifted(self.schedule):
                self._noise(target, self._noisy_poses)
            if isinstance(target, NumpySolver):
                self._single(target, some[:SINGLE_POSES])
                self._sweep(target, some[:SINGLE_POSES])
                general = self.schedule.general is not None
                hold_shapes(self.ledger, target, poses=self.poses, q=self.q, general=general)
            if isinstance(target, CSolver):
                hold_batch(self.ledger, target, self.judge, poses=self.poses, q=self.q, noisy=self._noisy_poses)
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
            self._agree(f"{own} and {name}", answers[own], answers[name], self.every)
            if own in self._marks and name in self._marks:
                plain = self._questions.plain
                hold_same_marks(self.ledger, f"{own} and {name}", self._marks[own], self._marks[name], plain)
            if own in self._beside and name in self._beside:
                hold_same_edges(self.ledger, f"{own} and {name}", self._beside[own], self._beside[name])
            if own in self._rough and name in self._rough:
                hold_same_rough(self.ledger, f"{own} and {name}", self._rough[own], self._rough[name], self.judge)
        for name, (q, count) in answers.items():
            self._agree(f"exact walk and {name}", oracle, (q[self.some], count[self.some]), self.some)

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
        """Ordinary poses and those nearest to singular ones, for what is asked of one pose at a time."""
        ordinary, special = (1, 4) if self.schedule.general else (MARKED_POSES, SPECIAL_POSES)
        uniform = self.samples.of(UNIFORM)
        near = np.where(self.samples.of(QUARTER, SINGULAR), self.samples.offset, np.inf)
        rows = np.concatenate([np.flatnonzero(uniform)[:ordinary], np.argsort(near, kind="stable")[:special]])
        return Questions(
            schedule=self.schedule, judge=self.judge, poses=self.poses[rows], q=self.q[rows], plain=uniform[rows]
        )

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

    def _closures(self, solutions: Solutions, poses: Floats) -> Floats:
        """The worst closure of each pose's solutions; infinite where one of them is not finite."""
        q, count = solutions
        valid = np.arange(q.shape[1]) < count[:, None]
        closures = self.judge.closures(q, poses)
        closures = np.where(np.isnan(closures), np.inf, closures)
        return np.asarray(np.where(valid, closures, 0.0).max(axis=1, initial=0.0))

    def _inverse(self, solver: Solver, answer: Solutions, which: Rows) -> None:
        (q, count), name = answer, solver.name
        closures = self._closures(answer, self.poses[which])
        self.ledger.judge(INVERSE_LAW, name, closures, CLOSURE)
        if self.schedule.nominal:
            self.ledger.judge(ORDINARY_LAW, name, closures[self.samples.of(UNIFORM)[which]], ORDINARY)
        self._known(name, answer, which)
        self.ledger.count(COPY_LAW, name, len(which), self.judge.copies(q), limit=f"> {COPY:g} apart")
        angles = q[..., self.judge.revolute & self.kinematics.free]
        with np.errstate(invalid="ignore"):
            inside = np.all((angles > -np.pi) & (angles <= np.pi), axis=-1)
        outside = (np.arange(q.shape[1]) < count[:, None]) & ~inside
        self.ledger.count(RANGE_LAW, name, len(which), int(outside.any(axis=1).sum()))

    def _known(self, name: str, answer: Solutions, which: Rows) -> None:
        """The known joint vectors are found."""
        q, count = answer
        pair, close = self.samples.of(PAIR)[which], self._close[which]
        missed = ~self._found(q, which)
        beside = self.samples.of(NOMINAL)[which]
        clear = ~close & ~pair & ~beside
        self.ledger.count(FOUND_LAW, name, int(clear.sum()), int((missed & clear).sum()))
        if self.schedule.nominal:
            lost, limit = int((missed & beside).sum()), f"but for 1 in {MISSED}"
            self.ledger.count(BESIDE_LAW, name, int(beside.sum()), _too_many(lost, beside, MISSED), limit=limit)
            self.ledger.tally(f"{name}: next to singular poses of the nominal arm, known vector not found", lost)
        self.ledger.count(CLOSE_LAW, name, int(close.sum()), int((missed & close).sum()))
        self.ledger.count(PAIR_LAW, name, int(pair.sum()), int((pair & (count == 0)).sum()))
        self.ledger.tally(f"{name}: two singularities at once, known vector not found", int((pair & missed).sum()))

    def _found(self, q: Floats, which: Rows) -> NDArray[np.bool_]:
        """Whether the known joint vectors are among the solutions, as finely as their poses tell them."""
        known, poses = self.q[which], self.poses[which]
        found = self.judge.found(q, known, poses)
        for kind, path in ((self._close[which], CLOSE_PATH), (self.samples.of(PAIR)[which], PAIR_PATH)):
            rows = np.flatnonzero(~found & kind)
            if rows.size:
                wider = replace(self.judge, path=max(self.judge.path, path))
                found[rows] = wider.found(q[rows], known[rows], poses[rows])
        return found

    def _agree(self, subject: str, left: Solutions, right: Solutions, which: Rows) -> None:
        same, sets = self.judge.agreement(left, right, self.poses[which])
        uniform, pair, close = self.samples.of(UNIFORM)[which], self.samples.of(PAIR)[which], self._close[which]
        rows = np.flatnonzero(~sets & close)
        if rows.size:
            wider = replace(self.judge, path=max(self.judge.path, CLOSE_PATH))
            first, second = ((q[rows], count[rows]) for q, count in (left, right))
            sets[rows] = wider.agreement(first, second, self.poses[which[rows]])[1]
        if self.schedule.general:
            for row in np.flatnonzero(~sets & close):
                sets[row] = self._regular_ones_agree(left, right, int(row), self.poses[which[row]])
        beside = self.samples.of(NOMINAL)[which]
        odd, lost = int((~sets & close).sum()), int((~sets & beside).sum())
        failed = int(np.where(uniform, ~same, ~sets & ~pair & ~close & ~beside).sum())
        failed += _too_many(odd, close, MORE_SOLUTIONS) + _too_many(lost, beside, MISSED)
        if self.schedule.nominal:
            self.ledger.tally(f"{subject}: next to singular poses of the nominal arm, not the same solutions", lost)
        self.ledger.tally(f"{subject}: next to a singular pose, a solution more", odd)
        self.ledger.count(AGREE_LAW, subject, len(which), failed, limit=AGREE_LIMIT)
        self.ledger.tally(f"{subject}: at the edge of a tolerance band", int((~same & sets).sum()))

    def _regular_ones_agree(self, left: Solutions, right: Solutions, row: int, pose: Floats) -> bool:
        """Whether the regular solutions of one pose are in both answers.

        Where a general arm can move without moving its tool the search for roots finds some of a whole curve of
        solutions, and may find as many as it can return.
        """
        if max(left[1][row], right[1][row]) >= self.schedule.maximum:
            return True
        found = [q[row, : count[row]] for q, count in (left, right)]
        firm = [q[self._volume(q) > REGULAR * np.median(self._volume(self.q))] for q in found]
        return self.judge.covers(firm[0], found[1], pose) and self.judge.covers(firm[1], found[0], pose)

    @property
    def _close(self) -> NDArray[np.bool_]:
        """Samples so near to one singular pose that double roots merge and angles are soft."""
        return np.asarray((self.samples.offset <= MERGED) & ~self.samples.of(PAIR))

    def _refusals(self, solver: Solver) -> None:
        pose = self.poses[0]
        cases = malformed(pose)
        if isinstance(solver, NumpySolver):
            cases |= {"a 3x4 array": pose[:3], "a vector": pose[0], "a 3x3 array": pose[:3, :3]}
        missed = [name for name, case in cases.items() if not solver.refuses(case)]
        note = "answered: " + ", ".join(missed) if missed else ""
        self.ledger.count(REFUSE_LAW, solver.name, len(cases), len(missed), note=note)

    def _unreachable(self, solver: Solver) -> None:
        if self.schedule.task is Task.ORIENTATION:
            return
        far = outward(self.poses[:FAR_POSES], self.kinematics.size)
        zeros = np.zeros((len(far), self.q.shape[1]))
        answer = solver.inverse(far, zeros)
        wanted = np.zeros(len(far)) if self.judge.revolute.all() else self.exact.inverse(far, zeros)[1]
        wrong = (answer[1] != wanted) | ~(self._closures(answer, far) <= CLOSURE)
        self.ledger.count(FAR_LAW, solver.name, len(far), int(wrong.sum()))

    def _noisy(self, poses: Floats, size: float) -> Floats:
        noisy = poses.copy()
        noisy[:, :3, :3] += self.rng.uniform(-size, size, (len(noisy), 3, 3))
        return noisy

    def _noise(self, solver: Solver, noisy: Floats) -> None:
        answer = solver.inverse(noisy, self.q[: len(noisy)])
        wrong = (answer[1] == 0) | ~(self._closures(answer, noisy) <= 20 * NOISE)
        self.ledger.count(NOISE_LAW, solver.name, len(noisy), int(wrong.sum()), limit=f"<= {20 * NOISE:g}")

    def _single(self, solver: NumpySolver, which: Rows) -> None:
        """One pose at a time, among them some with a rotation that is known to fewer digits."""
        poses = np.concatenate([self.poses[which], self._noisy_poses[:SINGLE_NOISY]])
        reference = np.concatenate([self.q[which], self.q[:SINGLE_NOISY]])
        q, count = solver.inverse(poses, reference)
        wrong = 0
        for row, pose in enumerate(poses):
            single, batch = solver.single(pose, reference[row]), q[row, : count[row]]
            if single.shape == batch.shape:
                gap = wrapped(single - batch, self.judge.revolute)
                if np.all(np.abs(gap) <= SINGLE_LIMIT):
                    continue
            wrong += not (self.schedule.general and self._one_by_one(single, batch, pose))
        self.ledger.count(SINGLE_LAW, solver.name, len(poses), wrong, limit=f"<= {SINGLE_LIMIT:g}")

    def _sweep(self, solver: NumpySolver, which: Rows) -> None:
        """One pose over the values that the locked inputs have in all samples: as many single calls."""
        if not self.schedule.inputs:
            return
        pose, q = self.poses[which[0]], self.q[which]
        swept, each = solver.sweep(pose, q), solver.inverse(np.repeat(pose[None], len(q), axis=0), q)
        wrong = (swept[1] != each[1]) | ~np.isclose(swept[0], each[0], rtol=0, atol=SINGLE_LIMIT, equal_nan=True).all(
            (1, 2)
        )
        self.ledger.count(SWEEP_LAW, solver.name, len(q), int(wrong.sum()), limit=f"<= {SINGLE_LIMIT:g}")

    def _one_by_one(self, single: Floats, batch: Floats, pose: Floats) -> bool:
        """Whether two answers differ by rounding alone: the order in which a batch is summed up is NumPy's own."""
        left, right = (single[None], np.array([len(single)])), (batch[None], np.array([len(batch)]))
        return bool(self.judge.agreement(left, right, pose[None])[1][0])

    def _count_solutions(self, numbers: Rows | None, oracle: Rows) -> None:
        uniform = self.samples.of(UNIFORM)
        self.solution_counts.update((oracle[uniform[self.some]] if numbers is None else numbers[uniform]).tolist())


def _too_many(failed: int, tried: NDArray[np.bool_], share: int) -> int:
    """How many cases of those tried fail beyond one, and one in ``share``."""
    return max(0, failed - 1 - int(tried.sum()) // share)
