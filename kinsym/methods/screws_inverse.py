"""Inverse kinematics by successive screws: P = A_1 ... A_i P0, then w and u (lecture, slides 66 to 75).

P is the point that the last joints do not move. Displacements are taken over to the left,
A_1^-1 P = A_2 ... A_i P0, until an equation holds one unknown.
"""

from __future__ import annotations

from kinsym.algebra.ring import Poly, Ring, Vector
from kinsym.algebra.tree import ONE, Sym, Tree, add, opposite
from kinsym.errors import DoesNotApply
from kinsym.inverse.knowledge import Knowledge
from kinsym.inverse.state import COLUMNS
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.methods.document import INVERSE, TRANSPOSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.last_first import last_first
from kinsym.methods.screw_arm import Wrist, screw_robot, wrist_of
from kinsym.methods.screws import name_displacements, state_product
from kinsym.methods.solver import Solver, Statement
from kinsym.robot.model import Robot

NAME, TITLE = "screws_inverse", "Successive screws, inverse"
ROWS = "xyz"
_COUNTS = {2: "two", 3: "three"}


def screws_inverse(robot: Robot) -> MethodDerivation:
    """Inverse kinematics of a robot by successive screws.

    Raises :class:`DoesNotApply` with the joints that these equations do not give.
    """
    table = screw_robot(robot)
    whole = build_chain(table)
    columns = COLUMNS[robot.task or fitting_task(whole, whole)]
    wrist = wrist_of(table, columns)
    draft = Draft(wrist.arm.chain, method=NAME, title=TITLE)
    work = ScrewWork(draft, wrist, columns)
    work.begin()
    work.solve_position()
    work.solve_orientation()
    if work.solver.unknown:
        raise DoesNotApply(
            f"the lecture's inverse by successive screws does not solve {robot.name}: the equations of p, w and u "
            f"leave {', '.join(work.solver.unknown)}, none of which stands alone in one of them."
        )
    return draft.done()


class ScrewWork:
    """The equations of one arm, printed when they are first used; ``matrices`` tells whether products are printed."""

    def __init__(self, draft: Draft, wrist: Wrist, given: str, *, matrices: bool = True) -> None:
        self.matrices = matrices
        self.solver = Solver(draft, self._introduce, Knowledge(wrist.arm.chain))
        self.draft, self.wrist, self.arm = draft, wrist, wrist.arm
        self.ring: Ring = draft.ring
        self.count = len(self.arm.chain.joints)
        self.moving = self.count - wrist.fixed
        self.home = {
            column: self.arm.vector(cells)
            for column, cells in zip("uvw", (self.arm.home.u0, self.arm.home.v0, self.arm.home.w0), strict=True)
        }
        columns = [column for column in "uvw" if column in given]
        self.columns = sorted(columns, key=lambda column: (not self._along_last(column), "wuv".index(column)))
        self.named: dict[tuple[str, int], tuple[Sym, ...]] = {}

    def solve_position(self) -> None:
        """What the point p gives."""
        starts = [start for start in self.arm.starts if start < self.moving]
        points = [statement for start in starts for statement in self._rows("p", start, self.moving)]
        if self.wrist.fixed == 3:
            self.solver.print_family("p.0")
        squared = self.ring.dot(*[self._column("p")] * 2)
        moved = self.ring.reduce(sum((part * part for part in self._image("p", 0, self.moving)), self.ring.zero))
        self.solver.solve([*points[:3], Statement("p.squared", "square", squared, moved), *points[3:]])

    def solve_orientation(self) -> None:
        """The column along the last axis, then the others."""
        for column in self.columns:
            stop = self._stop(column)
            for starts in self._cuts(column, stop):
                self.solver.solve(statement for start in starts for statement in self._rows(column, start, stop))

    def _cuts(self, column: str, stop: int) -> tuple[list[int], list[int]]:
        """Behind which joints a column is looked at: first as in the lecture, then anywhere else.

        Of a spherical wrist it is where the wrist begins. Otherwise the direction of the last axis is looked at before
        the joints that move p, and the other columns behind them.
        """
        everywhere = [start for start in self.arm.starts if start < stop]
        wrist = [self.moving] if self._is_cut(self.moving) and self.moving < stop else []
        early = self.wrist.fixed < 3 and column == self.columns[0]
        first = [start for start in everywhere if start < self.moving] if early else wrist
        return first, [start for start in everywhere if start not in first]

    def _is_cut(self, count: int) -> bool:
        """Whether a group of parallel axes begins behind some joints, slides not counted."""
        return self._start(count) in self.arm.starts

    def _start(self, count: int) -> int:
        """The joints before a cut without the slides right before it, which turn nothing."""
        while count not in self.arm.starts and count and self.arm.chain.joints[count - 1].kind == "P":
            count -= 1
        return count

    def _along_last(self, column: str) -> bool:
        """Whether a column of the pose is along the last axis, which the last joint does not turn."""
        direction, _ = self.arm.axis(self.count)
        return self.home[column] in (direction, tuple(-entry for entry in direction))

    def _stop(self, column: str) -> int:
        """The last joint that moves a column."""
        turns = self.arm.chain.joints[-1].kind == "R"
        return self.count - 1 if turns and self._along_last(column) else self.count

    def _column(self, column: str) -> Vector:
        x, y, z = (self.ring[f"{column}_{row}"] for row in ROWS)
        return x, y, z

    def _image(self, column: str, start: int, stop: int) -> Vector:
        if column == "p":
            return self.arm.moved_point(start, stop, self.wrist.point)
        return self.arm.moved_direction(start, stop, self.home[column])

    def _rows(self, column: str, start: int, stop: int) -> list[Statement]:
        """``(A_1 ... A_start)^-1 column = A_start+1 ... A_stop column0``, row by row."""
        cut = start if column == "p" else self._start(start)
        left = self.arm.taken_back(cut, self._column(column), point=column == "p")
        right = self._image(column, cut, stop)
        family = f"{column}.{start}"
        if column != "p" and self.wrist.fixed == 3 and start == self.moving:
            names = tuple(Sym(self.draft.fresh(f"{column}_in{start}_{row}")) for row in ROWS)
            self.named[column, start] = names
            for name, entry in zip(names, left, strict=True):
                self.draft.give(name.name, entry)
            rows = zip(ROWS, left, right, names, strict=True)
            return [Statement(f"{family}.{row}", family, x, y, name) for row, x, y, name in rows]
        return [Statement(f"{family}.{row}", family, x, y) for row, x, y in zip(ROWS, left, right, strict=True)]

    def begin(self) -> None:
        """The wrist point from the pose of the end effector, and as the displacements move it."""
        draft, wrist = self.draft, self.wrist
        names = [draft.fresh(f"q_{row}") for row in ROWS]
        for place, name in enumerate(names):
            total: Poly = self._column("p")[place]
            for column, part in zip("uvw", wrist.away, strict=True):
                total += part * self._column(column)[place]
            draft.give(name, self.ring.reduce(total))
        name_displacements(draft, self.arm)
        for column in "uvw":
            draft.name_matrix(column, Matrix(tuple((Sym(f"{column}_{row}"),) for row in ROWS)))
            draft.name_matrix(f"{column}0", draft.column(self.home[column]))
        point = (*((draft.tree(entry),) for entry in wrist.point), (ONE,))
        draft.name_matrix("p", Matrix((*((Sym(f"p_{row}"),) for row in ROWS), (ONE,))))
        draft.name_matrix("p0", Matrix(point))
        last = [f"`{joint.variable}`" for joint in self.arm.chain.joints[self.moving :]]
        if last:
            few = "does" if len(last) == 1 else "do"
            where = "lies on the last axis" if len(last) == 1 else f"is where the last {_COUNTS[len(last)]} axes meet"
            listed = ", ".join(last)
            draft.say(f"The point `p` {where}, so that {listed} {few} not move it. With `q` the end effector,")
        else:
            draft.say("The point `p` is the end effector `q` itself:")
        for row, name in zip(ROWS, names, strict=True):
            terms: list[Tree] = [Sym(name)]
            for column, part in zip("uvw", wrist.away, strict=True):
                if part:
                    terms.append(opposite(draft.tree(part * self.ring[f"{column}_{row}"])))
            draft.state(f"p_{row}", Sym(f"p_{row}"), add(*terms))
        if not self.matrices:
            return
        draft.state("p0", Product((Factor("p0"),)), Matrix(point))
        draft.state("p", Product((Factor("p"),)), Product((*self._factors("A", 0, self.moving), Factor("p0"))))

    def _factors(self, letter: str, start: int, stop: int) -> tuple[Factor, ...]:
        return tuple(Factor(f"{letter}{i}") for i in range(start + 1, stop + 1))

    def _introduce(self, family: str) -> None:
        """Print an equation of columns, and its rows, before a row of it is used."""
        draft = self.draft
        if family == "square":
            squared = add(*(draft.tree(entry * entry) for entry in self._column("p")))
            moved = self.ring.reduce(sum((e * e for e in self._image("p", 0, self.moving)), self.ring.zero))
            draft.say("The displacements of `p` keep its square,")
            draft.state("p.squared", squared, draft.tree(moved))
            return
        column, start = family[0], int(family[2:])
        stop = self.moving if column == "p" else self._stop(column)
        letter, mark = ("A", INVERSE) if column == "p" else ("R", TRANSPOSE)
        taken = tuple(Factor(f"{letter}{i}", mark) for i in range(start, 0, -1))
        left = Product((*taken, Factor(column)))
        right = Product((*self._factors(letter, start, stop), Factor(f"{column}0")))
        if not self.matrices:
            behind = f"behind joint{'s 1 to' * (start > 1)} {start}" if start else "from the base"
            draft.say(f"`{column}` seen {behind}:")
        elif start or column != "p":
            what = "of `p`" if column == "p" else f"of `{column}`"
            draft.say(f"The equation {what} with displacements taken over to the left:" if start else f"That {what}:")
            draft.state(f"{column}.loop.{start}", left, right)
        if self.matrices and column == "p" and stop - start > 1:
            state_product(draft, self.arm, start, stop)
        names = self.named.get((column, start))
        cut = start if column == "p" else self._start(start)
        lhs = self.arm.taken_back(cut, self._column(column), point=column == "p")
        if names is not None:
            for name, entry in zip(names, lhs, strict=True):
                draft.state(f"{name.name}", name, last_first(self.ring, entry))
        rhs = self._image(column, cut, stop)
        for k, (row, x, y) in enumerate(zip(ROWS, lhs, rhs, strict=True)):
            shown = draft.tree(x) if names is None else names[k]
            draft.state(f"{column}.{start}.{row}", shown, draft.tree(y))
