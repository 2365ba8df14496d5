"""Rows of a table: which cells they have, which of the names in them is the joint variable.

The joint variable stands in theta (revolute) or in d (prismatic), once in the whole table and with factor +1 or
-1; every other name is a parameter. That one rule lets a row leave out its type and its variable.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

import sympy
from sympy import Expr, Integer

from kinsym.errors import RobotError
from kinsym.robot.expressions import names, number, parse, symbol
from kinsym.robot.model import Change, Convention, Joint, Vector
from kinsym.robot.names import check_variable, nearest, shown
from kinsym.robot.snapping import Snapping

COLUMNS = ("alpha", "a", "d", "theta")
SCREW_COLUMNS = ("s", "s0")
ROW_KEYS = ("type", "variable", "limits")
KINDS = ("R", "P", "fixed")
MOST_ROWS = 32
# theta12 is theta1 + theta2, so a tenth joint could not be told from a sum.
MOST_JOINTS = 9

_HOME_OF = {"R": "theta", "P": "d"}


def check_keys(table: Mapping[str, object], known: tuple[str, ...], *, where: str) -> None:
    """Raise RobotError at the first key that is not known, with the nearest that is."""
    for key in table:
        if key not in known:
            raise RobotError(
                f"unknown key {shown(key)}",
                where=where,
                remedy=f"{nearest(key, known)}The keys here are {', '.join(known)}.",
            )


def read_vector(cells: object, *, where: str) -> Vector:
    """Three cells."""
    if not isinstance(cells, list) or len(cells) != 3:
        raise RobotError("three cells are needed", where=where, remedy='Write a list such as ["0", "0", "1"].')
    x, y, z = (parse(cell, where=f"{where}[{i}]") for i, cell in enumerate(cells))
    return x, y, z


def read_rows(
    rows: object, convention: Convention, *, where: str, snapping: Snapping, changes: list[Change]
) -> tuple[Joint, ...]:
    """The joints of a table.

    ``rows`` is the list of mappings that a file holds under ``joints``; ``where`` is the file's name. Directions of
    screws are read under ``snapping``, which adds to ``changes``. Raises RobotError with row and column.
    """
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise RobotError("joints is not an array of tables", where=where, remedy="Write one [[joints]] for each row.")
    if not rows:
        raise RobotError("the table has no rows", where=f"{where}, joints", remedy="Write one row for each joint.")
    if len(rows) > MOST_ROWS:
        raise RobotError(f"the table has {len(rows)} rows", where=where, remedy=f"At most {MOST_ROWS} are read.")
    joints: list[Joint] = []
    for i, row in enumerate(rows, start=1):
        default = 1 + sum(joint.variable is not None for joint in joints)
        joint = _Row(row, convention, default, f"{where}, joints row {i}").joint()
        if joint.s is not None:
            s, change = snapping.direction(joint.s, where=f"row {i}, s")
            changes += [change] if change else []
            joint = replace(joint, s=s)
        joints.append(joint)
    _check_variables(joints, where)
    moving = sum(joint.variable is not None for joint in joints)
    if moving == 0:
        raise RobotError("no row has a joint variable", where=f"{where}, joints", remedy="A robot moves: add a joint.")
    if moving > MOST_JOINTS:
        raise RobotError(
            f"the robot has {moving} joints", where=f"{where}, joints", remedy=f"At most {MOST_JOINTS} can move."
        )
    return tuple(joints)


@dataclass(frozen=True)
class _Row:
    cells: dict[str, object]
    convention: Convention
    default: int
    where: str

    def joint(self) -> Joint:
        screw = self.convention is Convention.SCREW
        self.check_keys_of_row(SCREW_COLUMNS if screw else COLUMNS)
        kind = self.kind()
        return self.screw(kind) if screw else self.link(kind)

    def check_keys_of_row(self, columns: tuple[str, ...]) -> None:
        other = COLUMNS if columns is SCREW_COLUMNS else SCREW_COLUMNS
        foreign = next((key for key in self.cells if key in other), None)
        if foreign:
            raise RobotError(
                f'the column {foreign} does not belong to the convention "{self.convention.value}"',
                where=self.where,
                remedy=f"Its columns are {', '.join(columns)}.",
            )
        check_keys(self.cells, (*columns, *ROW_KEYS), where=self.where)

    def kind(self) -> str | None:
        kind = self.cells.get("type")
        if kind is None or kind in KINDS:
            return kind if isinstance(kind, str) else None
        raise RobotError(
            f"unknown joint type {shown(str(kind))}",
            where=f"{self.where}, type",
            remedy='Write "R" (revolute), "P" (prismatic) or "fixed".',
        )

    def cell(self, column: str) -> object:
        if column not in self.cells or self.cells[column] == "":
            raise RobotError("the cell is missing", where=f"{self.where}, {column}", remedy='Write "0" if it is zero.')
        return self.cells[column]

    def named_variable(self) -> str | None:
        name = self.cells.get("variable")
        if name is None:
            return None
        if not isinstance(name, str):
            raise RobotError("the variable is not a name", where=f"{self.where}, variable", remedy='Write "theta1".')
        return check_variable(name, where=f"{self.where}, variable")

    def limits(self) -> tuple[Fraction, Fraction] | None:
        if "limits" not in self.cells:
            return None
        where, limits = f"{self.where}, limits", self.cells["limits"]
        if not isinstance(limits, list) or len(limits) != 2:
            raise RobotError("limits are two numbers", where=where, remedy='Write ["deg(-160)", "deg(160)"].')
        low, high = (number(limit, where=where) for limit in limits)
        if low >= high:
            raise RobotError("the lower limit is not below the upper", where=where, remedy="Exchange them.")
        return low, high

    def screw(self, kind: str | None) -> Joint:
        variable = self.named_variable()
        if kind is None:
            raise RobotError(
                "the type of the joint is missing",
                where=f"{self.where}, type",
                remedy='Write type = "R" (revolute) or "P" (prismatic).',
            )
        if kind == "fixed":
            raise RobotError(
                "a table of screws has no fixed rows", where=f"{self.where}, type", remedy="Put it into [home]."
            )
        s = read_vector(self.cell("s"), where=f"{self.where}, s")
        # A prismatic screw has no place, only a direction.
        origin = self.cells.get("s0", [0, 0, 0]) if kind == "P" else self.cell("s0")
        s0 = read_vector(origin, where=f"{self.where}, s0")
        name = variable or check_variable(f"{_HOME_OF[kind]}{self.default}", where=self.where)
        return Joint(kind=kind, variable=name, s=s, s0=s0, limits=self.limits())

    def link(self, kind: str | None) -> Joint:
        cells = {column: parse(self.cell(column), where=f"{self.where}, {column}") for column in COLUMNS}
        if kind == "fixed":
            for key in ("variable", "limits"):
                if key in self.cells:
                    raise RobotError(f"a fixed row has no {key}", where=f"{self.where}, {key}", remedy="Leave it out.")
            return Joint(kind="fixed", variable=None, **cells)
        kind, variable = self.variable(kind, cells)
        self.check_factor(variable, _HOME_OF[kind], cells)
        return Joint(kind=kind, variable=variable, limits=self.limits(), **cells)

    def variable(self, kind: str | None, cells: dict[str, Expr]) -> tuple[str, str]:
        """Kind and variable of a row; what is left out is what theta and d hold."""
        named = self.named_variable()
        angle = named or self.angle_in(cells["theta"])
        length = named or f"d{self.default}"
        if kind != "P" and angle and symbol(angle) in cells["theta"].free_symbols:
            return "R", angle
        if kind != "R" and symbol(length) in cells["d"].free_symbols:
            return "P", length
        if kind is None:
            default = f"theta{self.default} or d{self.default}"
            raise RobotError(
                f"the joint variable {named or default} is neither in theta nor in d",
                where=self.where,
                remedy='Write it there, name another one with variable = "q1", or write type = "fixed".',
            )
        column, name = _HOME_OF[kind], named or f"{_HOME_OF[kind]}{self.default}"
        elsewhere = [other for other in COLUMNS if symbol(name) in cells[other].free_symbols]
        raise RobotError(
            f"the joint variable {name} is missing" + (f" here and stands in {elsewhere[0]}" if elsewhere else ""),
            where=f"{self.where}, {column}",
            remedy=f'Write "{name}" in {column}, name another one with variable = "q1", or write type = "fixed".',
        )

    def angle_in(self, theta: Expr) -> str | None:
        """theta4 in the first row of a wrist is its variable: such a name cannot be a parameter."""
        found = [name for name in names(theta) if re.fullmatch(r"theta\d+", name)]
        if f"theta{self.default}" in found or len(found) != 1:
            return f"theta{self.default}"
        return check_variable(found[0], where=f"{self.where}, theta")

    def check_factor(self, variable: str, column: str, cells: dict[str, Expr]) -> None:
        for other in COLUMNS:
            if other != column and symbol(variable) in cells[other].free_symbols:
                raise RobotError(
                    f"the joint variable {variable} stands in two cells, {column} and {other}",
                    where=f"{self.where}, {other}",
                    remedy=f"A joint variable stands in one cell only: here in {column}.",
                )
        factor = sympy.diff(cells[column], symbol(variable))
        if factor not in (Integer(1), Integer(-1)):
            raise RobotError(
                f"the joint variable {variable} enters with factor {factor}",
                where=f"{self.where}, {column}",
                remedy=f'It must enter with factor +1 or -1, for example "{variable}" or "pi - {variable}".',
            )


def cells_of(joint: Joint) -> tuple[tuple[str, Expr], ...]:
    """The cells of a row with their columns, in the order of the table."""
    if joint.s is not None and joint.s0 is not None:
        return (*(("s", cell) for cell in joint.s), *(("s0", cell) for cell in joint.s0))
    cells = zip(COLUMNS, (joint.alpha, joint.a, joint.d, joint.theta), strict=True)
    return tuple((column, cell) for column, cell in cells if cell is not None)


def _check_variables(joints: list[Joint], where: str) -> None:
    owner: dict[str, int] = {}
    for i, joint in enumerate(joints, start=1):
        if joint.variable is None:
            continue
        if joint.variable in owner:
            raise RobotError(
                f"{joint.variable} is the variable of rows {owner[joint.variable]} and {i}",
                where=f"{where}, joints row {i}",
                remedy="Give every joint its own variable.",
            )
        owner[joint.variable] = i
    for i, joint in enumerate(joints, start=1):
        for column, cell in cells_of(joint):
            for name in names(cell):
                if name in owner and name != joint.variable:
                    raise RobotError(
                        f"{name}, the joint variable of row {owner[name]}, stands here as well",
                        where=f"{where}, joints row {i}, {column}",
                        remedy="A joint variable stands in one cell only; rename the one that is a parameter.",
                    )
                if name == joint.variable and joint.s is not None:
                    raise RobotError(
                        f"the joint variable {name} stands in the screw",
                        where=f"{where}, joints row {i}, {column}",
                        remedy="A screw is given at the home pose, where the joint variables are zero.",
                    )
