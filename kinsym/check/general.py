"""All solutions of a six-joint arm without a closed form, with 50 digits: elimination, Newton's method, sifting."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from kinsym.check.descent import descended
from kinsym.check.elimination import Elimination, Joint, Motion, inverted, product
from kinsym.check.evaluate import Arithmetic, Program
from kinsym.check.linear import Matrix, Value, Vector
from kinsym.check.newton import CROWDED, Kinematics, Newton
from kinsym.check.slides import SlidingLoop
from kinsym.general.plan import Cut, GeneralPlan

BESIDE = 0.01
NEARLY_STILL = 1e-3
"""How far from 0 the joint that completes five may stand before the others are polished without it."""
MET = 1e-9
"""How far off the pose they may then be, lengths in units of the arm's."""


class GeneralOracle:
    """The inverse kinematics of a general plan for one choice of parameters.

    It opens the loop where the generated code looks second, so that the two reductions have nothing in common.
    """

    def __init__(
        self,
        ctx: Any,
        numbers: Arithmetic,
        plan: GeneralPlan,
        given: Mapping[str, Value],
        kinematics: tuple[Kinematics, Kinematics],
    ) -> None:
        self.ctx, self.plan = ctx, plan
        entries = [Program((), link.entries, numbers)(given) for link in plan.transforms]
        self._base, *self._links = ((_rows(values[:9]), list(values[9:])) for values in entries)
        forward, jacobian = kinematics
        if plan.gate:
            axis = [row[2] for row in self._links[5][0]]
            self._newton = Newton(ctx, plan.kinds, *_with_turn(ctx, forward, jacobian, axis))
            self._own = Newton(ctx, plan.kinds[:5], forward, jacobian, accepted=MET)
        else:
            kinds = plan.kinds[:5] if plan.spin else plan.kinds
            self._newton = self._own = Newton(ctx, kinds, forward, jacobian, plan.spin)

    def solutions(self, rows: list[list[Value]]) -> list[Vector]:
        """The joint vectors of a pose (three rows of four), sorted as in the generated code."""
        wanted: Motion = [row[:3] for row in rows], [row[3] for row in rows]
        length = self._length(wanted)
        cuts = self.plan.cuts or tuple(Cut.before(number) for number in self.plan.suppressed)
        found, certain = self._found(cuts[-1], wanted, rows, length, [])
        if not certain:
            found, _ = self._found(cuts[0], self._beside(wanted, length), rows, length, found)
        if not found and self._silent(cuts[-1], wanted, length):
            found = descended(self._newton, rows, length)
        if self.plan.gate:
            still = [q[:5] for q in found if abs(q[5]) < NEARLY_STILL]
            found = self._polished(self._own, still, rows, length, [])
        found.sort(key=lambda q: [self.ctx.nint(x / unit * 10**6) for x, unit in self._own.in_units(q, length)])
        return found[: self.plan.maximum]

    def _closing(self, wanted: Motion) -> Motion:
        ctx = self.ctx
        return product(ctx, product(ctx, self._links[5], inverted(ctx, wanted)), self._base)

    def _length(self, wanted: Motion) -> Value:
        """The unit of length: the mean length of the links, more for a pose that only slides reach."""
        ctx = self.ctx
        mean = ctx.fsum(ctx.norm(link[1]) for link in self._links[:5]) / 5
        return max(mean, ctx.norm(self._closing(wanted)[1]) / 5) or ctx.one

    def _beside(self, wanted: Motion, length: Value) -> Motion:
        """A pose turned and shifted by a hundredth, at which no solutions share an angle by symmetry."""
        c, s = self.ctx.cos(BESIDE), self.ctx.sin(BESIDE)
        zero, one = self.ctx.zero, self.ctx.one
        turn: Motion = [[c, -s, zero], [s, c, zero], [zero, zero, one]], [zero] * 3
        tilt: Motion = [[one, zero, zero], [zero, c, -s], [zero, s, c]], [BESIDE * length, -BESIDE * length / 2, zero]
        return product(self.ctx, product(self.ctx, wanted, turn), tilt)

    def _found(
        self, cut: Cut, posed: Motion, rows: list[list[Value]], length: Value, before: list[Vector]
    ) -> tuple[list[Vector], bool]:
        """The solutions that one cut finds from a pose, with those found before, and whether there can be no more."""
        ctx = self.ctx
        loop = self._loop(cut, posed, length)
        angles = loop.angles()
        starts: list[Vector] = []
        for values in loop.candidates(angles):
            q = [ctx.zero] * 6
            for number, value in zip(cut.order, values, strict=True):
                q[number - 1] = value * length if self.plan.kinds[number - 1] == "P" else value
            starts.append(q[: len(self._newton.kinds)])
        found = self._polished(self._newton, starts, rows, length, before)
        alone = sorted(q[cut.suppressed - 1] for q in found)
        shared = 3 if cut.bordered else 2
        crowded = any(high - low < CROWDED for low, high in zip(alone, alone[shared - 1 :], strict=False))
        return found, len(angles) == len(found) and not crowded

    def _loop(self, cut: Cut, posed: Motion, length: Value) -> Elimination | SlidingLoop:
        links = [(turn, [t / length for t in shift]) for turn, shift in (*self._links[:5], self._closing(posed))]
        joints = [Joint(kind, sign) for kind, sign in zip(self.plan.kinds, self.plan.signs, strict=True)]
        return (SlidingLoop if self.plan.suppressed else Elimination)(self.ctx, cut, joints, links)

    def _silent(self, cut: Cut, posed: Motion, length: Value) -> bool:
        """Whether a cut tells nothing of a pose, since its determinant vanishes at every angle."""
        ctx, loop = self.ctx, self._loop(cut, posed, length)
        return all(abs(loop.closing(ctx.cos(angle), ctx.sin(angle))) < loop.vanished for angle in range(3))

    @staticmethod
    def _polished(
        newton: Newton, starts: Sequence[Vector], rows: list[list[Value]], length: Value, before: Sequence[Vector]
    ) -> list[Vector]:
        """The solutions found before and those to which Newton's method leads from the starts, each once."""
        found = list(before)
        for q in starts:
            polished = newton.polished(q, rows, length)
            if polished is not None and not any(newton.same(polished, other, rows, length) for other in found):
                found.append(polished)
        return found


def _with_turn(ctx: Any, forward: Kinematics, jacobian: Kinematics, axis: Vector) -> tuple[Kinematics, Kinematics]:
    """Forward kinematics and Jacobian of an arm with one more joint: it turns the tool about an axis of its own."""

    def turned(q: Sequence[Value]) -> list[list[Value]]:
        c, s = ctx.cos(q[5]), ctx.sin(q[5])
        x, y, z = axis
        across = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        turn = [[c * (i == j) + s * across[i][j] + (1 - c) * axis[i] * axis[j] for i in range(3)] for j in range(3)]
        return [[*(ctx.fdot(row[:3], column) for column in turn), row[3]] for row in forward(q[:5])]

    def slopes(q: Sequence[Value]) -> list[list[Value]]:
        along = [ctx.zero] * 3 + [ctx.fdot(row[:3], axis) for row in forward(q[:5])]
        return [[*row, entry] for row, entry in zip(jacobian(q[:5]), along, strict=True)]

    return turned, slopes


def _rows(values: Sequence[Value]) -> Matrix:
    return [list(values[start : start + 3]) for start in (0, 3, 6)]
