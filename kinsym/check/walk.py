"""The exact walk: the schedule executed with 50 digits, one branch after the other.

It is the oracle for every target language. It reads the same schedule as the printers, runs kernels of its own
and returns the solutions in the order of the generated code: first branching step outermost, upper sign first.
A solution with a marked root on its way is settled by the forward kinematics before it counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any, NamedTuple

from kinsym.algebra.tree import Sym
from kinsym.check.evaluate import Compiled, Environment, Program, compiled, exact
from kinsym.check.general import GeneralOracle
from kinsym.check.kernels import KERNELS
from kinsym.check.marks import NONE, Mark
from kinsym.check.settle import ALIKE, ON_THE_POSE, Goal, Settler, Solution
from kinsym.check.task import ENTRIES, POSITION
from kinsym.emit.schedule import Assign, Note, Schedule, Solve
from kinsym.general.plan import GeneralPlan
from kinsym.inverse.plan import Step

Value = Any
Pose = Sequence[Sequence[Value]]

CLOSURE = Fraction(1, 10**9)
DEFECT = Fraction(1, 10**6)
ROUNDING = Fraction(1, 10**14)
BOTTOM = Fraction(1, 10**9)
FAR = 10**150
#: From the twelve digits of the worst rotation that is taken to all fifty.
DOUBLINGS = 3

#: An arm with prismatic joints is as large as the pose needs it; this is its size without them.
AT_THE_ORIGIN = {"p_x": 0, "p_y": 0, "p_z": 0}


@dataclass(frozen=True)
class _Call:
    step: Step
    inputs: dict[str, Compiled]
    #: How many branches one root of this step leads to.
    stride: int


class _Way(NamedTuple):
    """What is known of a path at a statement: its marks, its branch so far, how far from it the twin's place is, and
    the joints that have their values from the reference.

    Branches are counted as if every step had all its roots. Where roots meet, the first stands for them and the last
    place is empty: the twin belongs there.
    """

    mark: Mark = NONE
    branch: int = 0
    aside: int | None = None
    free: tuple[str, ...] = ()

    def through(self, call: _Call, root: int, mark: Mark) -> _Way:
        """The path through one root of a step."""
        aside = self.aside
        if aside is None and Mark.BORDER in mark:
            aside = call.stride * (call.step.branches - 1 - root)
        freed = tuple(name for name, _ in call.step.reference) if Mark.FREE in mark else ()
        return _Way(self.mark | mark, self.branch + call.stride * root, aside, self.free + freed)


class ExactWalk:
    """Forward kinematics, Jacobian and inverse kinematics of one schedule for one choice of parameters."""

    def __init__(self, schedule: Schedule, parameters: Mapping[str, Fraction]) -> None:
        self.ctx, numbers = exact()
        self.schedule = schedule
        self.joints = [joint.name for joint in schedule.joints]
        given: Environment = {name: numbers.number(value) for name, value in parameters.items()}
        self.given = given = Program(schedule.constants, (), numbers).names(given)
        self._held = Program(schedule.held, (), numbers)
        self._size = compiled(schedule.size, numbers)
        self.size: Value = self._size({**AT_THE_ORIGIN, **given})
        self._tau = numbers.number(schedule.tau)
        self._forward = Program(schedule.forward.definitions, schedule.forward.outputs, numbers)
        self._jacobian = Program(schedule.jacobian.definitions, schedule.jacobian.outputs, numbers)
        self._solution = [compiled(Sym(name), numbers) for name in schedule.solution]
        self._statements: list[tuple[str, Compiled] | _Call] = []
        branches = [statement.step.branches for statement in schedule.inverse if isinstance(statement, Solve)]
        for statement in schedule.inverse:
            match statement:
                case Assign(name=name, value=tree):
                    self._statements.append((name, compiled(tree, numbers)))
                case Solve(step=step):
                    inputs = {name: compiled(tree, numbers) for name, tree in step.inputs.items()}
                    branches = branches[1:]
                    self._statements.append(_Call(step, inputs, prod(branches)))
                case Note():
                    continue
        self._limits = {name: numbers.number(value) for name, value in _LIMITS.items()}
        self._settler = Settler(
            self.ctx,
            joints=schedule.joints,
            task=schedule.task,
            forward=self.forward,
            jacobian=self.jacobian,
            wrap=numbers.functions["wrap"],
            locked=schedule.locked,
            gate=bool(schedule.gate),
        )
        self._numbers = numbers
        self._solved = [place for place, name in enumerate(self.joints) if name not in schedule.locked]

    def forward(self, q: Sequence[Value]) -> list[list[Value]]:
        """The pose as three rows of four entries (u, v, w, p)."""
        return _rows(self._forward(self._with_joints(q)), 4)

    def jacobian(self, q: Sequence[Value]) -> list[list[Value]]:
        """Six rows: linear velocity of the origin of the last frame, then angular velocity, in the base frame."""
        return _rows(self._jacobian(self._with_joints(q)), len(self.joints))

    def inverse(self, pose: Pose, reference: Sequence[Value] | None = None) -> list[list[Value]] | None:
        """All solutions in order, or None if ``pose`` (4x4) is not a pose.

        ``reference`` gives the values of joints that are free at this pose and of locked inputs; zeros if None.
        """
        checked = self._checked(pose)
        if checked is None:
            return None
        rows, tau = checked
        values = reference if reference is not None else [0] * len(self.joints)
        wanted = {name: self.ctx.mpf(value) for name, value in zip(self.joints, values, strict=True)}
        env = self._held.names({**self.given, **{name: wanted[name] for name in self.schedule.inputs}, "tau": tau})
        if self.schedule.general is not None:
            return self._without_closed_form(self.schedule.general, rows, env)
        for row, axis in zip(self._turned(rows), "xyz", strict=True):
            env.update({f"{column}_{axis}": value for column, value in zip("uvwp", row, strict=True)})
        size = env["size"] = self._size(env)
        goal = Goal(rows, size if size > 0 else self.ctx.mpf(1), ON_THE_POSE * tau)
        found: list[Solution] = []
        for way, q in self._paths(0, env, wanted, _Way()):
            plain = Solution(way.branch, q, ALIKE if Mark.DOUBTFUL in way.mark else 0)
            if way.mark:
                found += self._settler.settle(plain, way.branch + (way.aside or 0), way.mark, goal, way.free)
            elif not self.schedule.gate or self._reaches(q, rows, tau, size):
                found.append(plain)
        found.sort(key=lambda solution: solution.branch)
        return [solution.q for solution in self._settler.without_copies(found, goal.size)]

    def _without_closed_form(self, plan: GeneralPlan, rows: list[list[Value]], env: Environment) -> list[list[Value]]:
        """The solutions of the joints that are solved for, the locked ones in their places."""

        def whole(q: Sequence[Value]) -> list[Value]:
            found = dict(zip(self._solved, q, strict=True))
            return [found[place] if place in found else env[name] for place, name in enumerate(self.joints)]

        def jacobian(q: Sequence[Value]) -> list[list[Value]]:
            return [[row[place] for place in self._solved] for row in self.jacobian(whole(q))]

        oracle = GeneralOracle(self.ctx, self._numbers, plan, env, (lambda q: self.forward(whole(q)), jacobian))
        return [whole(q) for q in oracle.solutions(rows)]

    def _paths(
        self, start: int, env: Environment, wanted: Mapping[str, Value], way: _Way
    ) -> Iterator[tuple[_Way, list[Value]]]:
        """The joint vector at the end of every path from a statement on."""
        for position in range(start, len(self._statements)):
            statement = self._statements[position]
            if isinstance(statement, tuple):
                env[statement[0]] = statement[1](env)
                continue
            step = statement.step
            free = sum((sign * wanted[joint] for joint, sign in step.reference), self.ctx.mpf(0))
            inputs = {name: value(env) for name, value in statement.inputs.items()}
            roots = KERNELS[step.rule](self.ctx, inputs, free, way.mark != NONE)
            for number, (root, mark) in enumerate(roots):
                further = {**env, **dict(zip(step.outputs, root, strict=True))}
                yield from self._paths(position + 1, further, wanted, way.through(statement, number, mark))
            return
        yield way, [value(env) for value in self._solution]

    def _checked(self, pose: Pose) -> tuple[list[list[Value]], Value] | None:
        ctx, limit = self.ctx, self._limits
        given = [[ctx.mpf(value) for value in row] for row in pose]
        if not all(ctx.isfinite(value) for row in given for value in row):
            return None
        rows, bottom = given[:3], given[3]
        rotation = [row[:3] for row in rows]
        gram = _gram(rotation)
        defect = max(abs(entry) for row in gram for entry in row)
        if defect > limit["defect"] or _determinant(rotation) <= 0 or sum(abs(row[3]) for row in rows) >= FAR:
            return None
        if any(abs(value - target) > limit["bottom"] for value, target in zip(bottom, (0, 0, 0, 1), strict=True)):
            return None
        if defect <= limit["rounding"]:
            return rows, self._tau
        return self._nearer(rows), self._tau + defect

    def _turned(self, rows: list[list[Value]]) -> list[list[Value]]:
        """The pose with a rotation to all digits, so that equations that follow from each other agree to all digits.

        What rounding left of that differs by more than the equations themselves where these nearly vanish.
        """
        for _ in range(DOUBLINGS):
            rows = self._nearer(rows)
        return rows

    @staticmethod
    def _nearer(rows: list[list[Value]]) -> list[list[Value]]:
        """The pose with twice as many digits of its rotation right: R becomes R - R (R^T R - I) / 2."""
        gram = _gram([row[:3] for row in rows])
        half = [[(1 if i == j else 0) - gram[i][j] / 2 for j in range(3)] for i in range(3)]
        return [[*(sum(row[k] * half[k][j] for k in range(3)) for j in range(3)), row[3]] for row in rows]

    def _reaches(self, q: Sequence[Value], rows: list[list[Value]], tau: Value, size: Value) -> bool:
        reached = self.forward(q)
        allowed = max(self._limits["closure"], ON_THE_POSE * tau)
        # the size has the three coordinates of the pose in it: less than four times the larger of these and the arm
        return all(
            abs(reached[i][j] - rows[i][j]) <= allowed * (size / 4 if j == POSITION else 1)
            for i, j in ENTRIES[self.schedule.task]
        )

    def _with_joints(self, q: Sequence[Value]) -> Environment:
        return {**self.given, **{name: self.ctx.mpf(value) for name, value in zip(self.joints, q, strict=True)}}


_LIMITS = {"closure": CLOSURE, "defect": DEFECT, "rounding": ROUNDING, "bottom": BOTTOM}


def _rows(values: list[Value], width: int) -> list[list[Value]]:
    return [values[start : start + width] for start in range(0, len(values), width)]


def _gram(m: list[list[Value]]) -> list[list[Value]]:
    """What M^T M is more than the identity."""
    return [[sum(m[k][i] * m[k][j] for k in range(3)) - (1 if i == j else 0) for j in range(3)] for i in range(3)]


def _determinant(m: list[list[Value]]) -> Value:
    return (
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    )
