"""The parts of a robot file that do not move: the home frame of a screw table, the base and the tool.

They are read under the policy of :mod:`kinsym.robot.snapping` first and proved rigid afterwards.
"""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr

from kinsym.errors import RobotError
from kinsym.robot.expressions import is_zero, parse
from kinsym.robot.model import Change, Convention, Home, Matrix, Robot, Vector
from kinsym.robot.rigid import check_direction, check_rotation, from_rpy, transform
from kinsym.robot.rows import check_keys, read_vector
from kinsym.robot.snapping import Snapping

HOME_KEYS = ("u0", "v0", "w0", "q0", "p0")
TRANSFORM_KEYS = ("xyz", "rpy", "matrix")


def table_under(draft: Mapping[str, object], key: str, where: str) -> dict[str, object]:
    """The table of a key, empty if there is none."""
    table = draft.get(key, {})
    if not isinstance(table, dict):
        raise RobotError(f"{key} is not a table", where=where, remedy=f"Begin it with a line [{key}].")
    return table


def read_home(
    draft: Mapping[str, object], convention: Convention, where: str, snapping: Snapping, changes: list[Change]
) -> Home | None:
    """The home frame, which screw tables have and others must not; ``changes`` receives what is read otherwise."""
    if convention is not Convention.SCREW:
        if "home" in draft:
            raise RobotError(
                "a Denavit-Hartenberg table has no home frame",
                where=f"{where}, [home]",
                remedy='Leave it out, or use [tool]; [home] belongs to convention = "screw".',
            )
        return None
    table = table_under(draft, "home", where)
    # p0, the wrist point of the lecture's tables, follows from the axes and is not needed.
    check_keys(table, HOME_KEYS, where=f"{where}, [home]")
    vectors = {}
    for key in HOME_KEYS[:4]:
        if key not in table:
            raise RobotError(
                f"the home frame lacks {key}",
                where=f"{where}, [home]",
                remedy="A table of screws needs u0, v0, w0 (axes) and q0 (origin) of the end effector at home.",
            )
        vectors[key] = read_vector(table[key], where=f"{where}, [home] {key}")
        if key != "q0":
            vectors[key], change = snapping.direction(vectors[key], where=f"[home] {key}")
            changes += [change] if change else []
    return Home(**vectors)


def read_transform(
    draft: Mapping[str, object], key: str, where: str, snapping: Snapping, changes: list[Change]
) -> Matrix | None:
    """The base or the tool, from xyz and rpy or from a matrix; ``changes`` receives what is read otherwise."""
    if key not in draft:
        return None
    place = f"{where}, [{key}]"
    table = table_under(draft, key, where)
    check_keys(table, TRANSFORM_KEYS, where=place)
    if "matrix" in table:
        if len(table) > 1:
            raise RobotError("matrix stands beside xyz or rpy", where=place, remedy="Give one of them.")
        return _matrix(table["matrix"], f"{place} matrix", f"[{key}] matrix", snapping, changes)
    if not table:
        raise RobotError("the transform is empty", where=place, remedy="Give xyz and rpy, or matrix.")
    origin = read_vector(table.get("xyz", [0, 0, 0]), where=f"{place} xyz")
    cells = read_vector(table.get("rpy", [0, 0, 0]), where=f"{place} rpy")
    angles = [snapping.angle(cell, where=f"[{key}] rpy") for cell in cells]
    changes += [change for _, change in angles if change]
    (roll, _), (pitch, _), (yaw, _) = angles
    return transform(from_rpy(roll, pitch, yaw, where=f"{place} rpy"), origin)


def check_rigid(robot: Robot, where: str) -> None:
    """Raise RobotError unless the axes of screws, the home frame, base and tool are exact directions and rotations."""
    for i, joint in enumerate(robot.joints, start=1):
        if joint.s is not None:
            check_direction(joint.s, where=f"{where}, joints row {i}, s")
    if robot.home is not None:
        home = robot.home
        check_rotation((home.u0, home.v0, home.w0), what="the home frame", where=f"{where}, [home]")
    for key, matrix in (("base", robot.base), ("tool", robot.tool)):
        if matrix is not None:
            columns = ((matrix[0][j], matrix[1][j], matrix[2][j]) for j in range(3))
            u, v, w = columns
            check_rotation((u, v, w), what="the rotation of the transform", where=f"{where}, [{key}] matrix")


def _matrix(rows: object, where: str, noted: str, snapping: Snapping, changes: list[Change]) -> Matrix:
    if not isinstance(rows, list) or [len(row) if isinstance(row, list) else 0 for row in rows] != [4] * 4:
        raise RobotError("the matrix is not 4x4", where=where, remedy="Write four rows of four cells.")
    cells: list[list[Expr]] = [
        [parse(cell, where=f"{where}[{i}][{j}]") for j, cell in enumerate(row)] for i, row in enumerate(rows)
    ]
    if not all(is_zero(cell - expected) for cell, expected in zip(cells[3], (0, 0, 0, 1), strict=True)):
        raise RobotError("the last row is not 0 0 0 1", where=where, remedy="Give a rigid transform, row by row.")

    def column(j: int) -> Vector:
        return cells[0][j], cells[1][j], cells[2][j]

    (u, _), (v, _), (w, _) = turned = [snapping.direction(column(j), where=noted) for j in range(3)]
    changes += [change for _, change in turned if change]
    return transform((u, v, w), column(3))
