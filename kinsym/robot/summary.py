"""A robot's table as text: for the terminal and the banner of generated files, and as the file it came from.

Everything here is deterministic: same robot, same characters.
"""

from __future__ import annotations

import hashlib

from sympy import Expr

from kinsym.robot.locking import lock_text
from kinsym.robot.model import Convention, Joint, Robot
from kinsym.robot.rows import COLUMNS, SCREW_COLUMNS, cells_of
from kinsym.robot.text import cell_text, value_text


def table_lines(robot: Robot) -> tuple[str, ...]:
    """The table in aligned columns, then home frame, base, tool, locked joints and parameters, one line each.

    >>> from kinsym.robot import load
    >>> print(*table_lines(load("planar_rr")), sep="\\n")
    row  joint       alpha  a   d  theta
    1    R (theta1)  0      l1  0  theta1
    2    R (theta2)  0      l2  0  theta2
    parameters: l1, l2
    """
    columns = SCREW_COLUMNS if robot.convention is Convention.SCREW else COLUMNS
    rows = [("row", "joint", *columns)]
    rows += [(str(i), _joint(joint), *_cells(joint, columns)) for i, joint in enumerate(robot.joints, start=1)]
    widths = [max(len(row[j]) for row in rows) for j in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    if robot.home:
        axes = (f"{key} = {_vector(getattr(robot.home, key))}" for key in ("u0", "v0", "w0", "q0"))
        lines.append("home: " + ", ".join(axes))
    for key, matrix in (("base", robot.base), ("tool", robot.tool)):
        if matrix:
            lines.append(f"{key}: [" + ", ".join(_vector(row) for row in matrix[:3]) + "]")
    if robot.locks:
        held = (f"{name} = {cell_text(value)}" if value is not None else name for name, value in robot.locks.items())
        lines.append("locked: " + ", ".join(held))
    if robot.parameters:
        named = (name if value is None else f"{name} = {value_text(value)}" for name, value in robot.parameters.items())
        lines.append("parameters: " + ", ".join(named))
    return tuple(lines)


def digest(robot: Robot) -> str:
    """The first 16 hexadecimal digits of the SHA-256 of :func:`to_toml`: what the robot is, in one word.

    >>> from kinsym.robot import load
    >>> len(digest(load("ur5")))
    16
    """
    return hashlib.sha256(to_toml(robot).encode()).hexdigest()[:16]


def to_toml(robot: Robot) -> str:
    """A robot file that :func:`kinsym.robot.load` reads back as the same robot (notes are not kept).

    >>> from kinsym.robot import load
    >>> print(to_toml(load("planar_rr")).splitlines()[2])
    convention = "paul"
    """
    lines = [f"name = {_quoted(robot.name)}", f"title = {_quoted(robot.title)}"]
    lines.append(f"convention = {_quoted(robot.convention.value)}")
    if robot.task:
        lines.append(f"task = {_quoted(robot.task.value)}")
    if robot.source:
        lines.append(f"source = {_quoted(robot.source)}")
    if robot.nominal:
        lines.append("nominal = true")
    lines += ["joints = [", *(f"  {{ {_row(joint)} }}," for joint in robot.joints), "]"]
    if robot.home:
        lines.append("[home]")
        lines += [f"{key} = {_quoted_list(getattr(robot.home, key))}" for key in ("u0", "v0", "w0", "q0")]
    for key, matrix in (("base", robot.base), ("tool", robot.tool)):
        if matrix:
            lines += [f"[{key}]", "matrix = [", *(f"  {_quoted_list(row)}," for row in matrix), "]"]
    values = {name: value for name, value in robot.parameters.items() if value is not None}
    if values:
        lines += ["[parameters]", *(f"{name} = {_quoted(value_text(value))}" for name, value in values.items())]
    if robot.locks:
        lines += ["[locks]", *(f"{name} = {_quoted(lock_text(value))}" for name, value in robot.locks.items())]
    return "\n".join(lines) + "\n"


def _joint(joint: Joint) -> str:
    return joint.kind if joint.variable is None else f"{joint.kind} ({joint.variable})"


def _cells(joint: Joint, columns: tuple[str, ...]) -> tuple[str, ...]:
    if columns is COLUMNS:
        return tuple(cell_text(cell) for _, cell in cells_of(joint))
    return tuple(_vector(getattr(joint, column)) for column in columns)


def _vector(cells: tuple[Expr, ...]) -> str:
    return "[" + ", ".join(cell_text(cell) for cell in cells) + "]"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _quoted_list(cells: tuple[Expr, ...]) -> str:
    return "[" + ", ".join(_quoted(cell_text(cell)) for cell in cells) + "]"


def _row(joint: Joint) -> str:
    parts = [f"type = {_quoted(joint.kind)}"]
    if joint.variable is not None:
        parts.append(f"variable = {_quoted(joint.variable)}")
    if joint.s is not None and joint.s0 is not None:
        parts += [f"s = {_quoted_list(joint.s)}", f"s0 = {_quoted_list(joint.s0)}"]
    else:
        parts += [f"{column} = {_quoted(cell_text(cell))}" for column, cell in cells_of(joint)]
    if joint.limits:
        parts.append("limits = [" + ", ".join(_quoted(value_text(limit)) for limit in joint.limits) + "]")
    return ", ".join(parts)
