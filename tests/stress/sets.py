"""Joint vectors on the singular sets that a derivation lists, as many as are wanted, and beside them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinsym.algebra.tree import Sym, Tree, symbols
from kinsym.check.evaluate import Program, compiled, floating
from kinsym.check.poses import uniform, wrapped
from kinsym.check.solvers import Floats, as_float
from kinsym.emit.schedule import Schedule

GRID = 32
HALVINGS = 56
#: Nearer than this to a multiple of a quarter turn a zero is put onto it.
SNAP = 1e-13
#: Starts of one search, so that memory stays bounded.
BLOCK = 4096
#: Distances are spread evenly over their exponents between these; one in so many is zero.
NEAREST, FARTHEST, EXACTLY = -15.0, -3.0, 13


@dataclass(frozen=True, kw_only=True)
class Zeros:
    """Joint vectors (m, n) at which expressions vanish, and which joints were moved to get there (m, n)."""

    q: Floats
    moved: NDArray[np.bool_]


class Postures:
    """Random postures of one arm, and what its expressions are worth there."""

    def __init__(
        self, schedule: Schedule, parameters: Mapping[str, Fraction], size: float, rng: np.random.Generator
    ) -> None:
        self.rng = rng
        self._numbers = floating()
        self._joints = [joint.name for joint in schedule.joints]
        self.revolute = np.array([joint.kind == "R" for joint in schedule.joints])
        self.reach = size if size > 0 else 1.0
        given: dict[str, Any] = {name: as_float(value) for name, value in parameters.items()}
        self._given = Program(schedule.constants, (), self._numbers).names(given)
        held = {item.name: item for item in schedule.held}
        self._held = Program(schedule.held, (), self._numbers)
        self._still = {
            name: float(compiled(item.value, self._numbers)({})) for name, item in held.items() if name in self._joints
        }
        angles = schedule.singular.angles if schedule.singular else ()
        self._angles = Program(angles, (), self._numbers)
        self._meaning = {item.name: item.value for item in (*angles, *schedule.held)}

    def random(self, count: int) -> Floats:
        """Any postures (count, n); joints that are held at a value stand there."""
        q = uniform(self.revolute, self.reach, count, self.rng)
        for name, value in self._still.items():
            q[:, self._joints.index(name)] = value
        return q

    def zeros(self, values: tuple[Tree, ...], count: int) -> Zeros:
        """At most ``count`` postures at which all of some expressions vanish; fewer where starts lead to none."""
        parts = [self._zeros(values, min(BLOCK, count - start)) for start in range(0, count, BLOCK)]
        return Zeros(q=np.concatenate([part.q for part in parts]), moved=np.concatenate([part.moved for part in parts]))

    def beside(self, zeros: Zeros, count: int) -> tuple[Floats, Floats]:
        """``count`` postures at and next to zeros, and how far each is from its zero: the joints that led there are
        moved by 10^-15 to 10^-3 radians or units of the arm, or not at all."""
        pick = np.resize(self.rng.permutation(len(zeros.q)), count)
        distance = self.distances(count)
        shift = distance[:, None] * self.rng.choice((-1.0, 1.0), (count, len(self.revolute)))
        shift *= self.rng.uniform(0.5, 1.0, shift.shape)
        scale = np.where(self.revolute, 1.0, self.reach)
        return wrapped(zeros.q[pick] + np.where(zeros.moved[pick], shift * scale, 0.0), self.revolute), distance

    def distances(self, count: int) -> Floats:
        """Numbers between 1e-15 and 1e-3, the exponents evenly spread, and now and then zero."""
        far = 10.0 ** self.rng.uniform(NEAREST, FARTHEST, count)
        return np.where(self.rng.integers(0, EXACTLY, count) == 0, 0.0, far)

    def _zeros(self, values: tuple[Tree, ...], count: int) -> Zeros:
        q = self.random(count)
        moved, spent = np.zeros(q.shape, dtype=bool), np.zeros(q.shape, dtype=bool)
        for value in sorted(values, key=lambda value: len(self._movers(value))):
            movers = self._movers(value)
            # in each row another joint, of those that no expression before depends on
            open_ = np.isin(np.arange(q.shape[1]), movers) & ~spent
            order = np.where(open_, self.rng.random(q.shape), -1.0)
            place = order.argmax(axis=1)
            found = open_[np.arange(len(q)), place]
            for joint in movers:
                rows = np.flatnonzero(found & (place == joint))
                if rows.size:
                    q[rows, joint], found[rows] = self._root(value, q[rows], joint)
            moved[np.arange(len(q)), place] = True
            spent[:, movers] = True
            q, moved, spent = q[found], moved[found], spent[found]
        return Zeros(q=wrapped(q, self.revolute), moved=moved)

    def _movers(self, value: Tree) -> list[int]:
        """The joints that an expression depends on and that stand at no value."""
        names = {name for symbol in symbols(value) for name in symbols(self._meaning.get(symbol, Sym(symbol)))}
        return [place for place, name in enumerate(self._joints) if name in names and name not in self._still]

    def _root(self, value: Tree, q: Floats, place: int) -> tuple[Floats, NDArray[np.bool_]]:
        """For each posture a joint value at which an expression changes its sign, and whether there is one."""
        function, (count, _) = compiled(value, self._numbers), q.shape
        half = np.pi if self.revolute[place] else self.reach

        def height(x: Floats) -> Floats:
            lines = np.repeat(q[:, None], x.shape[1], axis=1)
            lines[..., place] = x
            names = {name: lines[..., column] for column, name in enumerate(self._joints)}
            every = self._angles.names(self._held.names({**self._given, **names}))
            return np.asarray(function(every) + np.zeros(x.shape))

        # another start in each row, so that no zero lies on the ends of every grid
        grid = self.rng.uniform(-half, half, (count, 1)) + np.linspace(-half, half, GRID + 1)
        signs = np.sign(height(grid))
        changes = signs[:, :-1] * signs[:, 1:] < 0
        column = np.where(changes, self.rng.random(changes.shape), -1.0).argmax(axis=1)
        rows = np.arange(count)
        low, high, rising = grid[rows, column], grid[rows, column + 1], signs[rows, column] < 0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            below = (height(middle[:, None])[:, 0] < 0) == rising
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        middle = (low + high) / 2
        quarter = np.round(middle * 2 / np.pi) * np.pi / 2
        snapped = self.revolute[place] & (np.abs(middle - quarter) < SNAP * (1.0 + np.abs(quarter)))
        return np.where(snapped, quarter, middle), changes.any(axis=1)
