"""From a file, a gallery name or a line of text to a Robot.

Three ways to write a table lead to one draft, the mapping that a TOML file holds; :func:`from_draft` turns a draft
into a Robot, so that every way gets the same checks and the same messages.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from pathlib import Path

from sympy import Expr

from kinsym.errors import RobotError
from kinsym.robot.advice import advised
from kinsym.robot.binding import bind, fold_zeros, used_parameters
from kinsym.robot.catalogue import gallery, gallery_path
from kinsym.robot.dh_text import rows_from_csv, rows_from_inline
from kinsym.robot.expressions import is_zero, number, parse
from kinsym.robot.model import Change, Convention, Home, Matrix, Robot, Task, Vector
from kinsym.robot.names import check_robot_name, nearest, shown
from kinsym.robot.reading import read_text
from kinsym.robot.rigid import check_direction, check_rotation, from_rpy, transform
from kinsym.robot.rows import check_keys, read_rows, read_vector
from kinsym.robot.snapping import EXACT, ROUNDING, Snapping
from kinsym.robot.special import special

KEYS = ("name", "title", "convention", "task", "joints", "home", "parameters", "base", "tool", "source")
HOME_KEYS = ("u0", "v0", "w0", "q0", "p0")
TRANSFORM_KEYS = ("xyz", "rpy", "matrix")
LONGEST_LINE = 500
URDF_SUFFIX = ".urdf"

_NO_BINDINGS: Mapping[str, Fraction] = {}


def load(
    source: str,
    *,
    convention: str | None = None,
    name: str | None = None,
    bindings: Mapping[str, Fraction] = _NO_BINDINGS,
    base_link: str | None = None,
    tip_link: str | None = None,
    snapping: Snapping = ROUNDING,
) -> Robot:
    """The robot of a gallery name or of a file (.toml, .csv, .urdf).

    ``convention`` says how to read a CSV table and ``name`` replaces the robot's name. ``bindings`` are folded in
    (:func:`kinsym.robot.bind`) before the file's own values count. ``base_link`` and ``tip_link`` pick the chain of
    a URDF file (:func:`kinsym.robot.urdf.from_urdf`). ``snapping`` says which numbers are read as special values
    (:mod:`kinsym.robot.snapping`). Raises RobotError.

    >>> load("stanford_paul").variables
    ('theta1', 'theta2', 'd3', 'theta4', 'theta5', 'theta6')
    """
    path = _find(source)
    source = source if source.isprintable() else ascii(source)
    if path.suffix.lower() == URDF_SUFFIX:
        from kinsym.robot.urdf import from_urdf

        if convention is not None:
            raise RobotError("a URDF file has no convention", where=source, remedy="Leave out --convention.")
        robot = from_urdf(path, base_link=base_link, tip_link=tip_link, name=name, snapping=snapping, shown_as=source)
        return fold_zeros(bind(robot, bindings))
    if base_link is not None or tip_link is not None:
        raise RobotError(
            "only a URDF file has links", where=source, remedy="Leave out --base-link and --tip-link, or name a .urdf."
        )
    text = read_text(path, shown_as=source)
    if path.suffix.lower() == ".csv":
        default = name if name is not None else path.stem
        draft: dict[str, object] = {"name": default, "joints": rows_from_csv(text, where=source)}
        draft["convention"] = _needed_convention(convention, source)
    else:
        draft = _toml(text, source)
        if convention is not None and draft.get("convention", convention) != convention:
            raise RobotError(
                f"the file says {shown(str(draft['convention']))} and the option {shown(convention)}",
                where=f"{source}, convention",
                remedy="Leave out --convention.",
            )
        if convention is not None:
            draft["convention"] = convention
        if name is not None:
            draft["name"] = name
    return from_draft(draft, where=source, bindings=bindings, snapping=snapping)


def from_inline(
    text: str,
    *,
    convention: str | None,
    name: str | None = None,
    bindings: Mapping[str, Fraction] = _NO_BINDINGS,
    snapping: Snapping = ROUNDING,
) -> Robot:
    """The robot of a table in one line: rows ``alpha a d theta``, parted by semicolons.

    A cell holds no blanks. Raises RobotError.

    >>> robot = from_inline("pi/2 0 d1 theta1; 0 a2 0 theta2", convention="paul", name="two_links")
    >>> list(robot.parameters)
    ['d1', 'a2']
    """
    draft: dict[str, object] = {
        "name": "robot" if name is None else name,
        "convention": _needed_convention(convention, "--dh"),
        "joints": rows_from_inline(text, where="--dh"),
    }
    return from_draft(draft, where="--dh", bindings=bindings, snapping=snapping)


def from_draft(
    draft: Mapping[str, object],
    *,
    where: str,
    bindings: Mapping[str, Fraction] = _NO_BINDINGS,
    snapping: Snapping = ROUNDING,
) -> Robot:
    """The robot of a mapping with the keys of a robot file; ``where`` names its source in messages."""
    check_keys(draft, KEYS, where=where)
    for key in ("name", "convention", "joints"):
        if key not in draft:
            raise RobotError(f"the key {key} is missing", where=where, remedy=f"Add {_EXAMPLES[key]}.")
    name = check_robot_name(_line(draft, "name", where), where=f"{where}, name")
    convention = _convention(_line(draft, "convention", where), where)
    changes: list[Change] = []
    robot = Robot(
        name=name,
        title=_line(draft, "title", where) or name,
        convention=convention,
        joints=(),
        task=_task(draft, where),
        source=_line(draft, "source", where),
    )
    robot, written = _with_table(robot, draft, where, snapping, changes), robot
    _check_rigid(robot, where)
    values = _parameter_values(draft, where)
    used = used_parameters(robot, where=where)
    for given in values:
        if given not in used:
            kind = "is a joint variable" if given in robot.variables else "is used nowhere in the table"
            raise RobotError(
                f"{shown(given)} has a value but {kind}",
                where=f"{where}, [parameters] {shown(given)[1:-1]}",
                remedy=f"{nearest(given, used)}The parameters of the table: {', '.join(used) or 'none'}.",
            )
    parameters = {parameter: values.get(parameter) for parameter in used}
    written = _with_table(written, draft, where, EXACT, []) if changes else robot
    robot, written = (fold_zeros(bind(replace(either, parameters=parameters), bindings)) for either in (robot, written))
    robot = special(robot, snapping, written=written, earlier=tuple(changes))
    return replace(robot, notes=(*robot.notes, *advised(robot)))


def _with_table(
    robot: Robot, draft: Mapping[str, object], where: str, snapping: Snapping, changes: list[Change]
) -> Robot:
    """The robot with rows, home frame, base and tool; whether they are rigid is not checked yet."""
    return replace(
        robot,
        joints=read_rows(draft["joints"], robot.convention, where=where, snapping=snapping, changes=changes),
        home=_home(draft, robot.convention, where, snapping, changes),
        base=_transform(draft, "base", where, snapping, changes),
        tool=_transform(draft, "tool", where, snapping, changes),
    )


def _check_rigid(robot: Robot, where: str) -> None:
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


_EXAMPLES = {
    "name": 'name = "my_robot"',
    "convention": 'convention = "paul" (or "craig", "screw")',
    "joints": "one [[joints]] for each row",
}


def _find(source: str) -> Path:
    if source in gallery():
        return gallery_path(source)
    path = Path(source)
    if path.suffix.lower() in {".toml", ".csv", URDF_SUFFIX}:
        return path
    if path.suffix.lower() == ".xacro":
        raise RobotError(
            "this is xacro, from which URDF is made", where=shown(source), remedy="Run: xacro FILE > robot.urdf."
        )
    if re.search(r"[/\\.]", source):
        raise RobotError(
            f"{shown(source)} is neither a robot of the gallery nor a .toml, .csv or .urdf file",
            remedy="Name a file that ends in .toml, .csv or .urdf.",
        )
    raise RobotError(
        f"the gallery has no robot {shown(source)}",
        remedy=f"{nearest(source, gallery())}List the gallery with kinsym robots, or name a .toml, .csv or .urdf file.",
    )


def _decimal(text: str) -> Decimal:
    try:
        return Decimal(text)
    except InvalidOperation:
        return Decimal("NaN")


def _toml(text: str, where: str) -> dict[str, object]:
    try:
        return tomllib.loads(text, parse_float=_decimal)
    except RecursionError:
        raise RobotError("the file is nested too deeply", where=where, remedy="A robot file is flat.") from None
    except ValueError as error:
        fault = re.fullmatch(r"(?P<what>.*) \(at (?P<place>.*)\)", str(error), re.DOTALL)
        what, place = (fault["what"], f"{where}, {fault['place']}") if fault else (str(error), where)
        raise RobotError(
            f"this is not TOML: {what}", where=place, remedy='Text stands in quotes: theta = "theta1 - pi/2".'
        ) from None


def _line(draft: Mapping[str, object], key: str, where: str) -> str:
    value = draft.get(key, "")
    if not isinstance(value, str):
        raise RobotError(f"{key} is not text", where=f"{where}, {key}", remedy=f'Write {key} = "...".')
    if len(value) > LONGEST_LINE or not value.isprintable():
        raise RobotError(
            f"{key} is not one line of at most {LONGEST_LINE} printable characters",
            where=f"{where}, {key}",
            remedy="Shorten it.",
        )
    return value.strip()


def _needed_convention(convention: str | None, where: str) -> str:
    if convention is None:
        raise RobotError(
            "the convention of the table is missing", where=where, remedy="Add --convention paul or --convention craig."
        )
    if convention == Convention.SCREW.value:
        raise RobotError(
            "a table of screws needs a TOML file", where=where, remedy="Only Denavit-Hartenberg tables are plain rows."
        )
    return convention


def _convention(text: str, where: str) -> Convention:
    try:
        return Convention(text)
    except ValueError:
        known = [item.value for item in Convention]
        raise RobotError(
            f"unknown convention {shown(text)}",
            where=f"{where}, convention",
            remedy=f"{nearest(text.lower(), known)}The conventions are {', '.join(known)}.",
        ) from None


def _task(draft: Mapping[str, object], where: str) -> Task | None:
    if "task" not in draft:
        return None
    text = _line(draft, "task", where)
    try:
        return Task(text)
    except ValueError:
        known = [item.value for item in Task]
        raise RobotError(
            f"unknown task {shown(text)}",
            where=f"{where}, task",
            remedy=f"{nearest(text.lower(), known)}The tasks are {', '.join(known)}.",
        ) from None


def _table(draft: Mapping[str, object], key: str, where: str) -> dict[str, object]:
    table = draft.get(key, {})
    if not isinstance(table, dict):
        raise RobotError(f"{key} is not a table", where=where, remedy=f"Begin it with a line [{key}].")
    return table


def _home(
    draft: Mapping[str, object], convention: Convention, where: str, snapping: Snapping, changes: list[Change]
) -> Home | None:
    if convention is not Convention.SCREW:
        if "home" in draft:
            raise RobotError(
                "a Denavit-Hartenberg table has no home frame",
                where=f"{where}, [home]",
                remedy='Leave it out, or use [tool]; [home] belongs to convention = "screw".',
            )
        return None
    table = _table(draft, "home", where)
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


def _transform(
    draft: Mapping[str, object], key: str, where: str, snapping: Snapping, changes: list[Change]
) -> Matrix | None:
    if key not in draft:
        return None
    place = f"{where}, [{key}]"
    table = _table(draft, key, where)
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


def _parameter_values(draft: Mapping[str, object], where: str) -> dict[str, Fraction]:
    table = _table(draft, "parameters", where)
    return {name: number(value, where=f"{where}, [parameters] {shown(name)[1:-1]}") for name, value in table.items()}
