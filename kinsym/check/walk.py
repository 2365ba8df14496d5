"""The exact walk: the schedule executed with 50 digits, one branch after the other.

It is the oracle for every target language. It reads the same schedule as the printers, runs kernels of its own
and returns the solutions in the order of the generated code: first branching step outermost, upper sign first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from kinsym.algebra.tree import Sym
from kinsym.check.evaluate import Compiled, Environment, Program, compiled, exact
from kinsym.check.general import GeneralOracle
from kinsym.check.kernels import KERNELS
from kinsym.check.task import ENTRIES, POSITION
from kinsym.emit.schedule import Assign, Note, Schedule, Solve
from kinsym.inverse.plan import Step

Value = Any
Pose = Sequence[Sequence[Value]]

CLOSURE = Fraction(1, 10**9)
DEFECT = Fraction(1, 10**6)
ROUNDING = Fraction(1, 10**14)
BOTTOM = Fraction(1, 10**9)
FAR = 10**150

#: An arm with prismatic joints is as large as the pose needs it; this is its size without them.
AT_THE_ORIGIN = {"p_x": 0, "p_y": 0, "p_z": 0}


@dataclass(frozen=True)
class _Call:
    step: Step
    inputs: dict[str, Compiled]


class ExactWalk:
    """Forward kinematics, Jacobian and inverse kinematics of one schedule for one choice of parameters."""

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.ctx, numbers = exact()
        self.schedule = schedule
        self.joints = [joint.name for joint in schedule.joints]
        given: Environment = {name: numbers.number(value) for name, value in parameters.items()}
        self.given = given = Program(schedule.constants, (), numbers).names(given)
        self._size = compiled(schedule.size, numbers)
        self.size: Value = self._size({**AT_THE_ORIGIN, **given})
        self._tau = numbers.number(schedule.tau)
        self._forward = Program(schedule.forward.definitions, schedule.forward.outputs, numbers)
        self._jacobian = Program(schedule.jacobian.definitions, schedule.jacobian.outputs, numbers)
        self._solution = [compiled(Sym(name), numbers) for name in schedule.solution]
        self._statements: list[tuple[str, Compiled] | _Call] = []
        for statement in schedule.inverse:
            match statement:
                case Assign(name=name, value=tree):
                    self._statements.append((name, compiled(tree, numbers)))
                case Solve(step=step):
                    inputs = {name: compiled(tree, numbers) for name, tree in step.inputs.items()}
                    self._statements.append(_Call(step, inputs))
                case Note():
                    continue
        self._limits = {name: numbers.number(value) for name, value in _LIMITS.items()}
        self._general = (
            GeneralOracle(self.ctx, numbers, schedule.general, self.given, (self.forward, self.jacobian))
            if schedule.general
            else None
        )

    def forward(self, q: Sequence[Value]) -> list[list[Value]]:
        """The pose as three rows of four entries (u, v, w, p)."""
        return _rows(self._forward(self._with_joints(q)), 4)

    def jacobian(self, q: Sequence[Value]) -> list[list[Value]]:
        """Six rows: linear velocity of the origin of the last frame, then angular velocity, in the base frame."""
        return _rows(self._jacobian(self._with_joints(q)), len(self.joints))

    def inverse(self, pose: Pose, reference: Sequence[Value] | None = None) -> list[list[Value]] | None:
        """All solutions in order, or None if ``pose`` (4x4) is not a pose.

        ``reference`` gives the values of joints that are free at this pose; zeros if None.
        """
        checked = self._checked(pose)
        if checked is None:
            return None
        rows, tau = checked
        if self._general is not None:
            return self._general.solutions(rows)
        env: Environment = {**self.given, "tau": tau}
        for row, axis in zip(rows, "xyz", strict=True):
            env.update({f"{column}_{axis}": value for column, value in zip("uvwp", row, strict=True)})
        size = env["size"] = self._size(env)
        values = reference if reference is not None else [0] * len(self.joints)
        wanted = {name: self.ctx.mpf(value) for name, value in zip(self.joints, values, strict=True)}
        found: list[list[Value]] = []
        self._run(0, env, wanted, found)
        return [q for q in found if not self.schedule.gate or self._reaches(q, rows, tau, size)]

    def _run(self, start: int, env: Environment, wanted: Mapping[str, Value], found: list[list[Value]]) -> None:
        for position in range(start, len(self._statements)):
            statement = self._statements[position]
            if isinstance(statement, tuple):
                env[statement[0]] = statement[1](env)
                continue
            step = statement.step
            free = sum((sign * wanted[joint] for joint, sign in step.reference), self.ctx.mpf(0))
            inputs = {name: value(env) for name, value in statement.inputs.items()}
            roots = KERNELS[step.rule](self.ctx, inputs, free)
            if len(roots) == 1:
                env.update(zip(step.outputs, roots[0], strict=True))
                continue
            for root in roots:
                self._run(position + 1, {**env, **dict(zip(step.outputs, root, strict=True))}, wanted, found)
            return
        found.append([value(env) for value in self._solution])

    def _checked(self, pose: Pose) -> tuple[list[list[Value]], Value] | None:
        ctx, limit = self.ctx, self._limits
        given = [[ctx.mpf(value) for value in row] for row in pose]
        if not all(ctx.isfinite(value) for row in given for value in row):
            return None
        rows, bottom = given[:3], given[3]
        rotation = [row[:3] for row in rows]
        gram = [
            [sum(rotation[k][i] * rotation[k][j] for k in range(3)) - (1 if i == j else 0) for j in range(3)]
            for i in range(3)
        ]
        defect = max(abs(entry) for row in gram for entry in row)
        if defect > limit["defect"] or _determinant(rotation) <= 0 or sum(abs(row[3]) for row in rows) >= FAR:
            return None
        if any(abs(value - target) > limit["bottom"] for value, target in zip(bottom, (0, 0, 0, 1), strict=True)):
            return None
        if defect <= limit["rounding"]:
            return rows, self._tau
        half = [[(1 if i == j else 0) - gram[i][j] / 2 for j in range(3)] for i in range(3)]
        better = [[sum(row[k] * half[k][j] for k in range(3)) for j in range(3)] for row in rotation]
        return [[*turned, row[3]] for turned, row in zip(better, rows, strict=True)], self._tau + defect

    def _reaches(self, q: Sequence[Value], rows: list[list[Value]], tau: Value, size: Value) -> bool:
        reached = self.forward(q)
        allowed = max(self._limits["closure"], 4 * tau)
        far = max(size, *(abs(row[3]) for row in rows))
        return all(
            abs(reached[i][j] - rows[i][j]) <= allowed * (far if j == POSITION else 1)
            for i, j in ENTRIES[self.schedule.task]
        )

    def _with_joints(self, q: Sequence[Value]) -> Environment:
        return {**self.given, **{name: self.ctx.mpf(value) for name, value in zip(self.joints, q, strict=True)}}


_LIMITS = {"closure": CLOSURE, "defect": DEFECT, "rounding": ROUNDING, "bottom": BOTTOM}


def _rows(values: list[Value], width: int) -> list[list[Value]]:
    return [values[start : start + width] for start in range(0, len(values), width)]


def _determinant(m: list[list[Value]]) -> Value:
    return (
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    )
