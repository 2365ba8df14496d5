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

from kinsym.errors import RobotError
from kinsym.robot.advice import advised
from kinsym.robot.binding import bind, fold_zeros, used_parameters
from kinsym.robot.dh_text import rows_from_inline
from kinsym.robot.dimensions import check_dimensions
from kinsym.robot.expressions import number
from kinsym.robot.fixed import check_rigid, read_home, read_transform, table_under
from kinsym.robot.locking import INPUT, lock
from kinsym.robot.model import Change, Convention, Robot, Task
from kinsym.robot.names import check_robot_name, nearest, shown
from kinsym.robot.rows import check_keys, read_rows
from kinsym.robot.snapping import EXACT, ROUNDING, Snapping
from kinsym.robot.special import special

KEYS = (
    *("name", "title", "convention", "task", "joints", "home", "parameters", "base", "tool", "locks", "nominal"),
    "source",
)
LONGEST_LINE = 500
# tomllib takes time and memory by the square of the parts of a dotted key. No more dots than these stand on one line
# of a table with a full title.
MOST_DOTS = 2 * LONGEST_LINE

_NO_BINDINGS: Mapping[str, Fraction] = {}


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
        "convention": needed_convention(convention, "--dh"),
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
    check_dimensions(draft, where)
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
        nominal=_nominal(draft, where),
        source=_line(draft, "source", where),
    )
    robot, written = _with_table(robot, draft, where, snapping, changes), robot
    check_rigid(robot, where)
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
    robot = replace(robot, notes=(*robot.notes, *advised(robot)))
    return _locked(robot, draft, where)


def _with_table(
    robot: Robot, draft: Mapping[str, object], where: str, snapping: Snapping, changes: list[Change]
) -> Robot:
    """The robot with rows, home frame, base and tool; whether they are rigid is not checked yet."""
    return replace(
        robot,
        joints=read_rows(draft["joints"], robot.convention, where=where, snapping=snapping, changes=changes),
        home=read_home(draft, robot.convention, where, snapping, changes),
        base=read_transform(draft, "base", where, snapping, changes),
        tool=read_transform(draft, "tool", where, snapping, changes),
    )


_EXAMPLES = {
    "name": 'name = "my_robot"',
    "convention": 'convention = "paul" (or "craig", "screw")',
    "joints": "one [[joints]] for each row",
}


def _decimal(text: str) -> Decimal:
    try:
        return Decimal(text)
    except InvalidOperation:
        return Decimal("NaN")


def toml_draft(text: str, where: str) -> dict[str, object]:
    """The mapping that a TOML text holds, decimals as they are written. Raises RobotError with line and column."""
    for i, line in enumerate(text.split("\n"), start=1):
        if line.count(".") > MOST_DOTS:
            raise RobotError(
                f"the line has more than {MOST_DOTS} dots", where=f"{where}, line {i}", remedy="Part it into lines."
            )
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


def needed_convention(convention: str | None, where: str) -> str:
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


def _nominal(draft: Mapping[str, object], where: str) -> bool:
    value = draft.get("nominal", False)
    if not isinstance(value, bool):
        raise RobotError(
            f"nominal is {shown(str(value))}, neither true nor false",
            where=f"{where}, nominal",
            remedy="Write nominal = true, without quotes, or leave it out.",
        )
    return value


def _parameter_values(draft: Mapping[str, object], where: str) -> dict[str, Fraction]:
    table = table_under(draft, "parameters", where)
    return {name: number(value, where=f"{where}, [parameters] {shown(name)[1:-1]}") for name, value in table.items()}


def _locked(robot: Robot, draft: Mapping[str, object], where: str) -> Robot:
    table = table_under(draft, "locks", where)
    values = {name: None if value == INPUT else value for name, value in table.items()}
    return lock(robot, values, where=f"{where}, [locks]") if values else robot
