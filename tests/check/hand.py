"""A planar 2R arm written out by hand: table, schedule and a NumPy module, none of them derived.

The checks are tested on it, so that a fault of the derivation cannot hide a fault of the checks.
"""

from __future__ import annotations

from fractions import Fraction

import sympy

from kinsym.algebra.tree import ONE, ZERO, Call, Num, Sym, Tree, add, mul, negated
from kinsym.emit.schedule import Assign, JointName, Note, Parameter, Schedule, Solve, StraightLine
from kinsym.inverse.plan import Definition, Nonzero, Step
from kinsym.robot.model import Convention, Joint, Robot, Task

VALUES = {"l1": Fraction(3, 5), "l2": Fraction(2, 5)}


def robot() -> Robot:
    """Two parallel joints with links l1 and l2."""
    zero = sympy.Integer(0)
    joints = tuple(
        Joint(
            kind="R", variable=f"theta{i}", alpha=zero, a=sympy.Symbol(f"l{i}"), d=zero, theta=sympy.Symbol(f"theta{i}")
        )
        for i in (1, 2)
    )
    return Robot(
        name="hand_rr",
        title="Planar RR arm by hand",
        convention=Convention.PAUL,
        joints=joints,
        parameters=dict(VALUES),
        task=Task.POSITION,
    )


def _step(unknown: str, rule: str, inputs: dict[str, Tree], outputs: tuple[str, ...], branches: int) -> Step:
    return Step(
        number=1,
        unknown=unknown,
        rule=rule,
        equations=(),
        coefficients=(),
        inputs=inputs,
        outputs=outputs,
        branches=branches,
        reference=((unknown, 1),),
        solution=(),
        condition=None,
        degenerate=None,
        why="",
    )


def schedule() -> Schedule:
    """Position task: the triangle gives theta2, the direction theta1."""
    c1, s1, c12, s12, l1, l2, x, y = map(Sym, "c1 s1 c12 s12 l1 l2 p_x p_y".split())
    tolerance = mul(Sym("tau"), Sym("size"))
    theta12 = add(Sym("theta1"), Sym("theta2"))
    forward = tuple(
        Definition(name=name, value=Call(function, (angle,)))
        for name, function, angle in (
            ("c1", "cos", Sym("theta1")),
            ("s1", "sin", Sym("theta1")),
            ("c12", "cos", theta12),
            ("s12", "sin", theta12),
        )
    )
    px, py = add(mul(l1, c1), mul(l2, c12)), add(mul(l1, s1), mul(l2, s12))
    inverse = (
        Note(level=0, text="two links reach the point"),
        Solve(
            level=0,
            step=_step(
                "theta2", "triangle", {"x": x, "y": y, "l1": l1, "l2": l2, "t": tolerance}, ("k_2", "w_2", "a_2"), 2
            ),
        ),
        Assign(level=1, name="theta2", value=Call("atan2", (Sym("w_2"), Sym("k_2")))),
        Solve(
            level=1,
            step=_step(
                "theta1",
                "direction",
                {"x": x, "y": y, "along": Sym("a_2"), "across": Sym("w_2"), "t": tolerance},
                ("c1", "s1"),
                1,
            ),
        ),
        Assign(level=1, name="theta1", value=Call("atan2", (s1, c1))),
    )
    return Schedule(
        name="hand_rr",
        title="Planar RR arm by hand",
        table=(),
        digest="0123456789abcdef",
        joints=(JointName(name="theta1", kind="R"), JointName(name="theta2", kind="R")),
        parameters=tuple(Parameter(name=name, value=value) for name, value in VALUES.items()),
        constants=(),
        forward=StraightLine(
            definitions=forward,
            outputs=(c12, negated(s12), ZERO, px, s12, c12, ZERO, py, ZERO, ZERO, ONE, ZERO),
        ),
        jacobian=StraightLine(
            definitions=forward,
            outputs=(
                negated(py),
                negated(mul(l2, s12)),
                px,
                mul(l2, c12),
                *(ZERO,) * 6,
                *(Num(Fraction(1)),) * 2,
            ),
        ),
        inverse=inverse,
        solution=("theta1", "theta2"),
        nonzero=tuple(Nonzero(value=length, unit=1, parameters=(length.name,)) for length in (l1, l2)),
        depth=1,
        maximum=2,
        task=Task.POSITION,
        gate=False,
        size=add(l1, l2),
        tau=Fraction(1, 2**46),
    )


MODULE = """
import itertools
from typing import NamedTuple

import numpy as np

NAME = "hand_rr"
JOINTS = ("theta1", "theta2")
JOINT_TYPES = ("R", "R")
PARAMETERS = {"l1": 0.6, "l2": 0.4}
MAX_SOLUTIONS = 2
BRANCHES = ()
LIMITS = ((-np.inf, np.inf), (-np.inf, np.inf))
TAU = 2.0**-46


def fk(q, *, l1=0.6, l2=0.4):
    _finite([l1, l2], "l1, l2")
    q = np.asarray(q, dtype=float)
    a, b = q[..., 0], q[..., 0] + q[..., 1]
    T = np.zeros((*q.shape[:-1], 4, 4))
    T[..., 0, 0] = T[..., 1, 1] = np.cos(b)
    T[..., 1, 0] = np.sin(b)
    T[..., 0, 1] = -np.sin(b)
    T[..., 2, 2] = T[..., 3, 3] = 1.0
    T[..., 0, 3] = l1 * np.cos(a) + l2 * np.cos(b)
    T[..., 1, 3] = l1 * np.sin(a) + l2 * np.sin(b)
    return T


def jacobian(q, *, l1=0.6, l2=0.4):
    T = fk(q, l1=l1, l2=l2)
    b = q[..., 0] + q[..., 1]
    J = np.zeros((*q.shape[:-1], 6, 2))
    J[..., 0, 0], J[..., 1, 0] = -T[..., 1, 3], T[..., 0, 3]
    J[..., 0, 1], J[..., 1, 1] = -l2 * np.sin(b), l2 * np.cos(b)
    J[..., 5, :] = 1.0
    return J


def ik_batch(T, *, reference=None, l1=0.6, l2=0.4):
    _lengths(l1, l2)
    T = np.asarray(T, dtype=float)
    if T.shape[-2:] != (4, 4):
        raise ValueError("shape")
    R = T[..., :3, :3]
    G = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(axis=(-1, -2))
    fine = (G <= 1e-6) & (np.linalg.det(np.where(np.isfinite(R), R, 0.0)) > 0)
    fine &= (np.abs(T[..., :3, 3]).sum(axis=-1) < 1e150) & (np.abs(T[..., 3, :] - [0, 0, 0, 1]).max(axis=-1) <= 1e-9)
    if not np.all(fine):
        raise ValueError(f"pose {np.argmin(np.ravel(fine))} is none")
    x, y = T[..., 0, 3], T[..., 1, 3]
    r2 = x * x + y * y
    t = TAU * (l1 + l2)
    f1, f2 = (l1 + l2) ** 2 - r2, r2 - (l1 - l2) ** 2
    t1, t2 = 2 * (l1 + l2) * t, 2 * abs(l1 - l2) * t + t * t
    reach = (f1 >= -t1) & (f2 >= -t2)
    reach &= np.abs(T[..., 2, 3]) <= 1e-9 * (l1 + l2)
    border = (f1 <= t1) | (f2 <= t2)
    k = np.where(f1 <= t1, l2, np.where(f2 <= t2, -l2, (r2 - l1 * l1 - l2 * l2) / (2 * l1)))
    w = np.where(border, 0.0, np.sqrt(np.maximum(f1 * f2, 0.0)) / (2 * l1))
    along = (r2 + (l1 - l2) * (l1 + l2)) / (2 * l1)
    q = np.full((*x.shape, 2, 2), np.nan)
    for i, sign in enumerate((1.0, -1.0)):
        b = sign * w
        q[..., i, 1] = np.arctan2(b, k)
        q[..., i, 0] = np.arctan2(y * along - x * b, x * along + y * b)
    valid = np.stack([reach, reach & ~border], axis=-1)
    return np.where(valid[..., None], q, np.nan), valid


def ik(T, *, reference=None, l1=0.6, l2=0.4):
    if np.shape(T) != (4, 4):
        raise ValueError("shape")
    q, valid = ik_batch(T, l1=l1, l2=l2)
    return q[valid]


class Solved(NamedTuple):
    q: np.ndarray
    branch: np.ndarray
    free: np.ndarray
    border: np.ndarray
    family: np.ndarray
    status: str


def _finite(values, what):
    if not np.isfinite(values).all():
        raise ValueError(f"{what} must be finite")
    return np.asarray(values, dtype=float)


def _lengths(l1, l2):
    if not np.all(_finite([l1, l2], "l1, l2")):
        raise ValueError("l1, l2 must not vanish")


def solve(T, *, reference=None, l1=0.6, l2=0.4):
    _lengths(l1, l2)
    _finite(np.zeros(2) if reference is None else reference, "a reference")
    none = np.zeros((0, 2), dtype=bool)
    try:
        q, valid = ik_batch(T, l1=l1, l2=l2)
    except ValueError:
        return Solved(np.zeros((0, 2)), np.zeros(0, dtype=int), none, none, none, "not a pose")
    free = np.zeros((valid.sum(), 2), dtype=bool)
    border = free | (valid.sum() == 1) & np.array([False, True])
    status = "solved" if len(free) == 2 else "singular" if len(free) else "unreachable"
    return Solved(q[valid], np.flatnonzero(valid), free, border, free, status)


def _inside(found, limits, most):
    limits = np.asarray(LIMITS if limits is None else limits, dtype=float)
    low, high = limits.T
    if not ((low <= high) & (low < np.inf) & (high > -np.inf)).all():
        raise ValueError("the limits must be intervals")
    wound = [
        (*(q + 2 * np.pi * np.array(turns)), row)
        for row, q in enumerate(found)
        for turns in itertools.product(*(range(-m, m + 1) for m in np.broadcast_to(most(limits), 2)))
    ]
    wound = np.array(wound).reshape(-1, 3)
    wound = wound[((wound[:, :2] >= low) & (wound[:, :2] <= high)).all(axis=1)]
    return wound[:, :2], wound[:, 2].astype(int)


def within(T, *, limits=None, reference=None, l1=0.6, l2=0.4):
    found = solve(T, reference=reference, l1=l1, l2=l2)
    wound, rows = _inside(found.q, limits, lambda ends: np.where(np.isfinite(ends).all(axis=1), 3, 0))
    marks = [part[rows] for part in found[1:5]]
    return Solved(wound, *marks, found.status if len(rows) or found.status == "not a pose" else "unreachable")


def nearest(T, reference, *, weights=None, limits=None, l1=0.6, l2=0.4):
    found = solve(T, reference=reference, l1=l1, l2=l2)
    if found.status == "not a pose":
        raise ValueError("T is no rigid motion")
    weights = _finite(np.ones(2) if weights is None else weights, "weights")
    if (weights < 0).any():
        raise ValueError("a weight must not be negative")
    wound, _ = _inside(found.q, limits, lambda ends: 3)
    way = wound - reference
    return wound[np.argmin((weights * way * way).sum(axis=1))] if len(way) else None
"""
