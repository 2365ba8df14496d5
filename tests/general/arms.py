"""Six-joint arms without a closed form, by class; random ones are seeded."""

from __future__ import annotations

from functools import cache
from types import ModuleType

import numpy as np

from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.numpy_source import numpy_source
from kinsym.robot import from_inline
from kinsym.robot.model import Robot

#: Tables in Paul's convention, cells alpha a d theta, lengths in metres.
COBOTS = {
    # UFACTORY, xArm developer manual, standard parameters; a2 is the hypotenuse of 284.5 and 53.5 mm.
    "xarm6": "-pi/2 0 0.267 theta1; 0 0.28948866 0 theta2; -pi/2 0.0775 0 theta3; "
    "pi/2 0 0.3425 theta4; -pi/2 0.076 0 theta5; 0 0 0.097 theta6",
    # FANUC CRX-10iA: Abbes and Poisson, Geometric approach for inverse kinematics of the FANUC CRX, Robotics 13 (2024).
    "crx10ia": "-pi/2 0 0.245 theta1; pi 0.54 0 theta2; -pi/2 0 0 theta3; "
    "pi/2 0 -0.54 theta4; -pi/2 0 0.15 theta5; pi 0 -0.16 theta6",
    # Kinova Jaco: model mdl_jaco of Corke's Robotics Toolbox, d4 = 0.2073 + 0.0741/sqrt(3) and so on.
    "jaco": "pi/2 0 0.2755 theta1; pi 0.41 0 theta2; pi/2 0 -0.0098 theta3; "
    "deg(60) 0 -0.2500815 theta4; deg(60) 0 -0.0855633 theta5; pi 0 -0.2027816 theta6",
    # Kinova Gen2 with the short links of the Mico: model mdl_mico of the same toolbox.
    "gen2": "pi/2 0 0.2755 theta1; pi 0.29 0 theta2; pi/2 0 -0.007 theta3; "
    "deg(60) 0 -0.1660815 theta4; deg(60) 0 -0.0855633 theta5; pi 0 -0.2027816 theta6",
}


def random_table(seed: int, slides: tuple[int, ...] = ()) -> str:
    """An arm with random twists and lengths; the joints in ``slides`` are prismatic."""
    rng = np.random.Generator(np.random.PCG64(seed))
    rows = []
    for number in range(1, 7):
        alpha, a, d, theta = (round(float(x), 3) for x in rng.uniform((-3, 0.05, -0.5, -3), (3, 0.5, 0.5, 3)))
        slide = number in slides
        rows.append(f"{alpha} {a} d{number} {theta}" if slide else f"{alpha} {a} {d} theta{number}")
    return "; ".join(rows)


def random_robot(seed: int, slides: tuple[int, ...] = ()) -> Robot:
    """The arm of :func:`random_table`."""
    return from_inline(random_table(seed, slides), convention="paul", name=f"random{seed}")


def cobot(name: str) -> Robot:
    """An arm of :data:`COBOTS`."""
    return from_inline(COBOTS[name], convention="paul", name=name)


def run(schedule: Schedule) -> ModuleType:
    """The generated module of a schedule, run in memory."""
    (text,) = numpy_source(schedule).values()
    module = ModuleType(schedule.name)
    exec(compile(text, schedule.name, "exec"), module.__dict__)
    return module


@cache
def derived(name: str) -> Derivation:
    """The derivation of ``"xarm6"``, ``"random1"``, ``"slide3"`` (joint 3 prismatic), ``"slide24"`` or ``"five1"``."""
    if name in COBOTS:
        return derive(cobot(name))
    number = int(name.strip("abcdefghijklmnopqrstuvwxyz"))
    if name.startswith("five"):
        table = random_table(20 + number).rpartition("; ")[0]
        return derive(from_inline(table, convention="paul", name=name))
    if name.startswith("slide"):
        return derive(random_robot(10 + number, tuple(map(int, str(number)))))
    return derive(random_robot(number))


@cache
def module(name: str) -> ModuleType:
    """The generated module of an arm of :func:`derived`."""
    return run(build_schedule(derived(name)))


def joint_vectors(module: ModuleType, count: int, seed: int) -> np.ndarray:
    """Random joint vectors (count, n), slides within a metre."""
    rng = np.random.Generator(np.random.PCG64(seed))
    sliding = np.array([kind == "P" for kind in module.JOINT_TYPES])
    return rng.uniform(-1.0, 1.0, (count, len(sliding))) * np.where(sliding, 1.0, np.pi)


def nearest(module: ModuleType, solutions: np.ndarray, q: np.ndarray) -> np.ndarray:
    """How far the nearest of the solutions (N, S, 6) is from a joint vector (N, 6), whole turns aside."""
    sliding = np.array([kind == "P" for kind in module.JOINT_TYPES])
    gap = solutions - q[:, None]
    gap = np.where(sliding, gap, gap - 2 * np.pi * np.round(gap / (2 * np.pi)))
    return np.nanmin(np.where(np.isnan(gap).any(-1), np.inf, np.abs(gap).max(-1)), axis=1)


def misses(module: ModuleType, poses: np.ndarray, solutions: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """How far each of the solutions (N, S, n) that are valid misses its pose (N, 4, 4), entry by entry (K, 4, 4)."""
    reached = module.fk(np.where(valid[..., None], solutions, 0.0))
    return np.abs(reached - poses[:, None])[valid]


def closures(module: ModuleType, q: np.ndarray, solutions: np.ndarray, spin: bool = False) -> np.ndarray:
    """How far the solutions (N, S, n) are from the poses of q (N, n), (N, S); NaN where there is none.

    With ``spin`` the turn about the tool's z axis does not count.
    """
    gap = np.abs(module.fk(np.nan_to_num(solutions)) - module.fk(q)[:, None])[..., :3, 2 * spin :]
    return np.where(np.isnan(solutions[..., 0]), np.nan, gap.max(axis=(-1, -2)))
