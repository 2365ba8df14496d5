"""Denavit-Hartenberg tables that a law can take apart: negate a cell, scale it, read the arm from its other end.

A cell is a rational multiple of 1, pi or a parameter, so that the text kinsym reads and the float the oracle
calculates with come from the same exact number.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot


@dataclass(frozen=True)
class Cell:
    """``number`` times ``unit``: nothing, ``pi`` or the name of a parameter."""

    number: Fraction
    unit: str = ""

    def __neg__(self) -> Cell:
        return replace(self, number=-self.number)

    def scaled(self, factor: Fraction) -> Cell:
        """The cell times a number."""
        return replace(self, number=self.number * factor)

    def __str__(self) -> str:
        return f"{self.number}*{self.unit}" if self.unit else str(self.number)

    __repr__ = __str__


ZERO = Cell(Fraction(0))


@dataclass(frozen=True)
class Row:
    """A row of the table; the joint variable is added, with ``sign``, to the cell ``theta`` (R) or ``d`` (P)."""

    kind: str
    alpha: Cell = ZERO
    a: Cell = ZERO
    d: Cell = ZERO
    theta: Cell = ZERO
    sign: int = 1


@dataclass(frozen=True)
class Frame:
    """A base or a tool: position, then roll, pitch and yaw."""

    xyz: tuple[Cell, Cell, Cell] = (ZERO, ZERO, ZERO)
    rpy: tuple[Cell, Cell, Cell] = (ZERO, ZERO, ZERO)


@dataclass(frozen=True)
class Table:
    """Rows in Paul's or Craig's convention; Craig's rows are followed by the constant ``last`` (alpha, a)."""

    rows: tuple[Row, ...]
    convention: str = "paul"
    task: str = ""
    last: tuple[Cell, Cell] = (ZERO, ZERO)
    base: Frame | None = None
    tool: Frame | None = None

    @property
    def kinds(self) -> str:
        """A letter a joint."""
        return "".join(row.kind for row in self.rows)

    @property
    def names(self) -> tuple[str, ...]:
        """The joint variables."""
        return tuple(f"{'theta' if row.kind == 'R' else 'd'}{i}" for i, row in enumerate(self.rows, start=1))

    def robot(self) -> Robot:
        """What kinsym makes of it."""
        joints = [_joint(row, name) for row, name in zip(self.rows, self.names, strict=True)]
        if self.last != (ZERO, ZERO):
            alpha, a = self.last
            joints.append({"type": "fixed", "alpha": str(alpha), "a": str(a), "d": "0", "theta": "0"})
        draft: dict[str, object] = {"name": "arm", "convention": self.convention, "joints": joints}
        if self.task:
            draft["task"] = self.task
        for key, frame in (("base", self.base), ("tool", self.tool)):
            if frame is not None:
                draft[key] = {"xyz": [str(cell) for cell in frame.xyz], "rpy": [str(cell) for cell in frame.rpy]}
        return from_draft(draft, where="tests", bindings={})

    def as_craig(self) -> Table:
        """Paul's table in Craig's convention: twist and length move to the row after (lecture, section 3.2.3)."""
        assert self.convention == "paul"
        before = (ZERO, ZERO)
        rows = []
        for row in self.rows:
            rows.append(replace(row, alpha=before[0], a=before[1]))
            before = row.alpha, row.a
        return replace(self, convention="craig", rows=tuple(rows), last=before)

    def backwards(self) -> Table:
        """The arm read from its tool to its base; its pose is the inverse one, its joints count from the tip.

        The inverse of Rz(theta) Tz(d) Tx(a) Rx(alpha) is Rx(-alpha) Tx(-a) Tz(-d) Rz(-theta), a row of Craig's.
        """
        assert self.convention == "paul"
        rows = [
            Row(row.kind, alpha=-row.alpha, a=-row.a, d=-row.d, theta=-row.theta, sign=-row.sign)
            for row in reversed(self.rows)
        ]
        return replace(self, convention="craig", rows=tuple(rows))


def _joint(row: Row, name: str) -> dict[str, object]:
    cells = {"alpha": str(row.alpha), "a": str(row.a), "d": str(row.d), "theta": str(row.theta)}
    moved = "theta" if row.kind == "R" else "d"
    sign = "-" if row.sign < 0 else ""
    offset = getattr(row, moved)
    cells[moved] = f"{sign}{name}" if offset == ZERO else f"{sign}{name} + ({offset})"
    return {"type": row.kind, "variable": name, **cells}
