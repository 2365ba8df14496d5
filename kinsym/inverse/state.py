"""One moment of the derivation: which joints are left, and the pose that they have to make.

When every joint at one end is known the loop closure is multiplied by the inverse of those links, and its left side,
now known, becomes the pose T_i_j of a shorter arm. The twelve pose generators of the ring always mean the current
one; ``names`` says what they are called.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import POSE_ENTRIES, Poly, Vector, apply, plus, transpose
from kinsym.algebra.tree import Definition, Num, Sym, Tree, negated
from kinsym.deadline import Deadline
from kinsym.inverse.knowledge import Knowledge
from kinsym.inverse.plan import Window
from kinsym.kinematics.chain import Chain, Group
from kinsym.kinematics.links import Rigid
from kinsym.kinematics.moves import Moves
from kinsym.robot.model import Robot, Task

NO_LIMIT = Deadline(None)

POINTS = 3
"""Random points modulo the prime at which a polynomial must vanish to be called zero."""

COLUMNS = {
    Task.POSE: "uvwp",
    Task.POSITION: "p",
    Task.ORIENTATION: "uvw",
    Task.PLANAR: "uvwp",
    Task.SCARA: "uvwp",
    Task.POSITION_AXIS: "wp",
}
"""The columns of the pose that a task gives."""


FIXED = {
    Task.POSE: 6,
    Task.POSITION: 3,
    Task.ORIENTATION: 3,
    Task.PLANAR: 3,
    Task.SCARA: 4,
    Task.POSITION_AXIS: 5,
}
"""How many joints a task fixes."""


def span(robot: Robot, task: Task) -> tuple[int, int]:
    """The joints between which the pose to solve reaches, (0, 6) for six: locked ones at the ends are constants.

    Without an orientation nothing can be taken off the end of a pose.
    """
    return robot.unlocked[0] - 1, robot.unlocked[-1] if "uvw" in COLUMNS[task] else len(robot.variables)


@dataclass(frozen=True)
class State:
    """The remaining arm: groups ``first`` to ``end`` (exclusive), and the names of the pose entries.

    ``deadline`` is looked at by whatever takes long with a state.
    """

    chain: Chain
    task: Task
    known: Knowledge
    first: int
    end: int
    names: dict[str, Tree]
    deadline: Deadline = NO_LIMIT

    @property
    def columns(self) -> str:
        """The columns of the pose that are given."""
        return COLUMNS[self.task]

    @property
    def oriented(self) -> bool:
        """Whether the whole orientation is given, so that links at the tip can be moved to the other side."""
        return "uvw" in self.columns

    @property
    def overdetermined(self) -> bool:
        """Whether the task states more equations than the arm has joints, so that solutions are sifted at the end."""
        return len(self.chain.joints) < FIXED[self.task]

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """The remaining groups; constants after the last joint belong to the pose where the task allows it."""
        ring = self.chain.ring
        groups = self.chain.groups[self.first : self.end]
        inner = tuple(group.whole(ring) for group in groups[:-1])
        return (*inner, groups[-1] if self.oriented else groups[-1].whole(ring))

    @cached_property
    def moves(self) -> tuple[Moves, ...]:
        """The moves of the remaining groups with what is known of their angles."""
        return tuple(Moves(self.chain.ring, group, self.known.turn) for group in self.groups)

    @property
    def left(self) -> int:
        """The number of joints before the remaining arm."""
        return self.chain.numbers[self.chain.groups[self.first].joints[0]] - 1

    @property
    def right(self) -> int:
        """The number of the last joint of the remaining arm."""
        if self.end == len(self.chain.groups):
            return span(self.chain.robot, self.task)[1]
        return self.chain.numbers[self.chain.groups[self.end - 1].joints[-1]]

    def links(self, group: Group) -> range:
        """The numbers of the links of a group; a locked joint is a link of the group that it follows."""
        last = self.right if group.index == self.end - 1 else self.chain.numbers[group.joints[-1] + 1] - 1
        return range(self.chain.numbers[group.joints[0]], last + 1)

    @cached_property
    def pose(self) -> dict[str, Vector]:
        """The columns of the current pose as generators."""
        ring = self.chain.ring
        return {c: (ring[c + "_x"], ring[c + "_y"], ring[c + "_z"]) for c in "uvwp"}

    @cached_property
    def samples(self) -> tuple[dict[str, int], ...]:
        """Random points of the variety: joints, parameters and the pose they make, modulo the prime."""
        ring = self.chain.ring
        generator = random.Random("kinsym")
        zero, one = ring.zero, ring.one
        units = {"u": (one, zero, zero), "v": (zero, one, zero), "w": (zero, zero, one)}
        columns: dict[str, Vector] = {}
        for name in "uvwp":
            self.deadline.check()
            vector = units.get(name, (zero, zero, zero))
            for group in reversed(self.groups):
                move = Moves(ring, group, self.chain.turn)
                vector = move.point(vector) if name == "p" else move.direction(vector)
            columns[name] = vector
        points = []
        for _ in range(POINTS):
            values = self.chain.sample(generator)
            entries = {
                f"{name}_{row}": ring.evaluate(entry, values)
                for name, vector in columns.items()
                for row, entry in zip("xyz", vector, strict=True)
            }
            points.append({**values, **entries})
        return tuple(points)

    def values(self, poly: Poly) -> tuple[int, ...]:
        """A polynomial at the random points."""
        return tuple(self.chain.ring.evaluate(poly, point) for point in self.samples)

    def vanishes(self, poly: Poly) -> bool:
        """Whether a polynomial is zero for every pose that the arm can make."""
        return not poly or not any(self.values(poly))

    def tree(self, poly: Poly) -> Tree:
        """A polynomial as it is written now."""
        return nested(self.chain.ring, poly, self.names)

    @property
    def label(self) -> str:
        """What the current pose is called."""
        return f"T_{self.left}_{self.right}"


def start(
    chain: Chain, task: Task, deadline: Deadline = NO_LIMIT, given: Mapping[str, Tree] = MappingProxyType({})
) -> tuple[State, Window | None]:
    """The whole arm; constants before the first and after the last joint are moved to the pose at once.

    ``given`` says what entries of the pose are called if not by their own names.
    """
    names: dict[str, Tree] = {entry: given.get(entry, Sym(entry)) for entry in POSE_ENTRIES}
    state = State(chain, task, Knowledge(chain), 0, len(chain.groups), names, deadline)
    after = chain.groups[-1].trail if state.oriented else Rigid.unit(chain.ring)
    before = chain.base.inverse(chain.ring)
    after = after.inverse(chain.ring)
    columns = {}
    for name, vector in _constants_moved(state, after).items():
        columns[name] = before.apply(chain.ring, vector) if name == "p" else apply(chain.ring, before.rotation, vector)
    return _renamed(state, state, columns)


def _constants_moved(state: State, after: Rigid) -> dict[str, Vector]:
    ring = state.chain.ring
    pose = state.pose
    if not state.oriented:
        return {name: pose[name] for name in state.columns}
    matrix = transpose((pose["u"], pose["v"], pose["w"]))
    columns = {name: apply(ring, matrix, column) for name, column in zip("uvw", transpose(after.rotation), strict=True)}
    columns["p"] = plus(apply(ring, matrix, after.translation), pose["p"])
    return columns


def shortened(state: State) -> tuple[State, Window | None] | None:
    """The state with one solved end group moved to the pose, or None if both end groups hold an unknown."""
    chain = state.chain
    if state.end - state.first < 2:
        return None
    if state.known.solved(chain.groups[state.first]):
        move = state.moves[0]
        columns = {
            name: move.point_back(vector) if name == "p" else move.direction_back(vector)
            for name, vector in state.pose.items()
            if name in state.columns
        }
        return _renamed(state, replace(state, first=state.first + 1), columns)
    if state.oriented and state.known.solved(chain.groups[state.end - 1]):
        move, ring = state.moves[-1], chain.ring
        undo = chain.groups[state.end - 2].trail.inverse(ring)
        units = transpose(undo.rotation)
        matrix = transpose((state.pose["u"], state.pose["v"], state.pose["w"]))
        columns = {
            name: apply(ring, matrix, move.direction_back(column)) for name, column in zip("uvw", units, strict=True)
        }
        back = move.point_back(undo.translation)
        columns["p"] = plus(apply(ring, matrix, back), state.pose["p"])
        return _renamed(state, replace(state, end=state.end - 1), columns)
    return None


def _renamed(old: State, new: State, columns: dict[str, Vector]) -> tuple[State, Window | None]:
    """Give the entries of a new pose their names; an entry that is one old entry keeps its name."""
    names: dict[str, Tree] = {}
    definitions: list[Definition] = []
    for column, vector in columns.items():
        for row, entry in zip("xyz", vector, strict=True):
            tree = old.tree(entry)
            if not (isinstance(tree, (Sym, Num)) or isinstance(negated(tree), Sym)):
                name = f"{column}{new.left}{new.right}_{row}"
                definitions.append(Definition(name=name, value=tree))
                tree = Sym(name)
            names[f"{column}_{row}"] = tree
    window = Window(left=new.left, right=new.right, definitions=tuple(definitions)) if definitions else None
    return replace(new, names=names), window
