"""The laws of poses that no joint vector made: out of reach, tilted, with noise, or none at all."""

from __future__ import annotations

import numpy as np

from kinsym.check.answers import Answers
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.laws import CLOSURE, malformed, outward
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Floats, Solver
from kinsym.robot.model import Task

FAR_POSES = 12
NOISE = 1e-9
#: The samples' poses turned by so much about a line through the tool: an arm of few joints cannot take them.
TILTS, TILTED_POSES = (1e-4, 0.3, 2.2), 12
#: Along no axis of any table, 1 long.
LINE = (2 / 7, 3 / 7, 6 / 7)

REFUSE_LAW = "what is no pose is refused"
FAR_LAW = "no solution beyond the reach"
TILT_LAW = "FK(IK(T)) = T for poses that may be none of the arm's"
NOISE_LAW = "rotations known to nine digits are solved"


def hold_refusals(ledger: Ledger, solver: Solver, pose: Floats) -> None:
    """What is no pose is refused, among others by its place; ``pose`` (4, 4) is one."""
    cases = malformed(pose)
    among = np.array([pose, pose, cases["reflection"], pose])
    if isinstance(solver, NumpySolver):
        cases |= {"a 3x4 array": pose[:3], "a vector": pose[0], "a 3x3 array": pose[:3, :3]}
    missed = [name for name, case in cases.items() if not solver.refuses(case)]
    if isinstance(solver, NumpySolver) and "pose 2 " not in solver.refusal(among):
        missed.append("another place of a bad pose")
    note = "answered: " + ", ".join(missed) if missed else ""
    ledger.count(REFUSE_LAW, solver.name, len(cases), len(missed), note=note)


def hold_far(ledger: Ledger, solver: Solver, exact: ExactSolver, answers: Answers) -> None:
    """There is no solution beyond the reach; a slide reaches as far as the exact walk says."""
    if answers.schedule.task is Task.ORIENTATION:
        return
    far = outward(answers.poses[:FAR_POSES], answers.judge.kinematics.size)
    zeros = np.zeros((len(far), answers.samples.q.shape[1]))
    answer = solver.inverse(far, zeros)
    wanted = np.zeros(len(far)) if answers.judge.revolute.all() else exact.inverse(far, zeros)[1]
    wrong = (answer[1] != wanted) | ~(answers.closures(answer, far) <= CLOSURE)
    ledger.count(FAR_LAW, solver.name, len(far), int(wrong.sum()))


def tilted(poses: Floats, angle: float) -> Floats:
    """Poses (m, 4, 4) turned by an angle about :data:`LINE` through the base's origin (Rodrigues' formula)."""
    x, y, z = LINE
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn = np.eye(3) + np.sin(angle) * across + (1.0 - np.cos(angle)) * across @ across
    turned = poses.copy()
    turned[:, :3] = turn @ poses[:, :3]
    return turned


def hold_tilted(ledger: Ledger, solver: Solver, answers: Answers, poses: Floats) -> None:
    """What is answered reaches the pose, also where an arm has fewer joints than the pose has numbers.

    ``poses`` (m, 4, 4) are the samples' first ones, tilted by one angle after the other.
    """
    reference = np.concatenate([answers.samples.q[: len(poses) // len(TILTS)]] * len(TILTS))
    ledger.judge(TILT_LAW, solver.name, answers.closures(solver.inverse(poses, reference), poses), CLOSURE)


def hold_noise(ledger: Ledger, solver: Solver, answers: Answers, noisy: Floats) -> None:
    """Rotations (m, 4, 4) that are known to nine digits, the samples' first ones, are solved."""
    answer = solver.inverse(noisy, answers.samples.q[: len(noisy)])
    wrong = (answer[1] == 0) | ~(answers.closures(answer, noisy) <= 20 * NOISE)
    ledger.count(NOISE_LAW, solver.name, len(noisy), int(wrong.sum()), limit=f"<= {20 * NOISE:g}")
