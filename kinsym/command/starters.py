"""The arms that ``kinsym new`` starts from, one for each number of joints, and a robot file of one of them.

Each is written down once, as rows of Paul's table; the other conventions are converted from it, so that the three files
are the same arm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from kinsym.emit.environment import render
from kinsym.emit.prose.wording import row_product
from kinsym.kinematics.convert import convert
from kinsym.robot.files import from_inline
from kinsym.robot.model import Convention, Joint, Robot
from kinsym.robot.names import check_robot_name
from kinsym.robot.rows import cells_of
from kinsym.robot.text import cell_text


@dataclass(frozen=True, kw_only=True)
class Starter:
    """An arm: rows ``alpha a d theta``, what each joint is for, lengths in metres, the joint that is an input."""

    title: str
    rows: str
    joints: tuple[str, ...]
    lengths: Mapping[str, str]
    lock: str = ""


_ARM = ("waist", "shoulder", "elbow")
_WRIST = ("wrist: turns the forearm", "wrist: bends", "wrist: turns the flange")

STARTERS: Mapping[int, Starter] = MappingProxyType(
    {
        2: Starter(
            title="Two links in a plane",
            rows="0 a1 0 theta1; 0 a2 0 theta2",
            joints=("shoulder", "elbow"),
            lengths={"a1": "0.4", "a2": "0.3"},
        ),
        3: Starter(
            title="Arm with an elbow",
            rows="pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3",
            joints=_ARM,
            lengths={"d1": "0.4", "a2": "0.45", "a3": "0.42"},
        ),
        4: Starter(
            title="Arm with an elbow and a wrist that bends",
            rows="pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4",
            joints=(*_ARM, "wrist: bends"),
            lengths={"d1": "0.1", "a2": "0.15", "a3": "0.15", "a4": "0.1"},
        ),
        5: Starter(
            title="Arm with an elbow and a wrist that bends and turns",
            rows="pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; pi/2 0 0 theta4; 0 0 d5 theta5",
            joints=(*_ARM, *_WRIST[1:]),
            lengths={"d1": "0.3", "a2": "0.22", "a3": "0.22", "d5": "0.14"},
        ),
        6: Starter(
            title="Arm with an elbow and a spherical wrist",
            rows="pi/2 0 d1 theta1; 0 a2 0 theta2; pi/2 0 0 theta3; -pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
            joints=(*_ARM, *_WRIST),
            lengths={"d1": "0.4", "a2": "0.45", "d4": "0.42", "d6": "0.08"},
        ),
        7: Starter(
            title="Arm with spherical shoulder and wrist",
            rows="-pi/2 0 d1 theta1; pi/2 0 0 theta2; pi/2 0 d3 theta3; -pi/2 0 0 theta4; -pi/2 0 d5 theta5;"
            " pi/2 0 0 theta6; 0 0 d7 theta7",
            joints=("shoulder: turns", "shoulder: bends", "upper arm: turns", "elbow", *_WRIST),
            lengths={"d1": "0.34", "d3": "0.4", "d5": "0.4", "d7": "0.13"},
            lock="theta3",
        ),
    }
)


def starter_file(name: str, convention: Convention, joints: int) -> str:
    """The text of a commented robot file; RobotError if ``name`` cannot be a robot's.

    >>> 'convention = "craig"' in starter_file("my_robot", Convention.CRAIG, 6)
    True
    """
    arm = STARTERS[joints]
    paul = from_inline(arm.rows, convention=Convention.PAUL.value, name=check_robot_name(name, where="NAME"))
    robot = convert(paul, convention)
    words = (*arm.joints, "the link behind the last joint")
    return render(
        "new/robot.toml.jinja",
        name=name,
        file=f"{name}.toml",
        title=arm.title,
        convention=convention.value,
        product=row_product(convention),
        rows=list(zip(_rows(robot), words, strict=False)),
        home=_home(robot),
        parameters=[(parameter, arm.lengths[parameter]) for parameter in robot.parameters],
        lock=arm.lock,
    )


def _rows(robot: Robot) -> list[str]:
    """The rows as they stand in a file, their cells in columns."""
    cells = [_cells(joint) for joint in robot.joints]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip(" ,") for row in cells]


def _cells(joint: Joint) -> list[str]:
    kind = f'type = "{joint.kind}", '
    if joint.s is not None and joint.s0 is not None:
        name = f'variable = "{joint.variable}", '
        return [kind, name, *(f"{key} = {_vector(cells)}, " for key, cells in (("s", joint.s), ("s0", joint.s0)))]
    return [kind, *(f'{column} = "{cell_text(cell)}", ' for column, cell in cells_of(joint))]


def _home(robot: Robot) -> list[tuple[str, str]]:
    if robot.home is None:
        return []
    return [(key, _vector(getattr(robot.home, key))) for key in ("u0", "v0", "w0", "q0")]


def _vector(cells: tuple[object, ...]) -> str:
    return "[" + ", ".join(f'"{cell}"' for cell in cells) + "]"
