"""One function a reader: bytes in, nothing out. Whatever a reader may not do with any bytes is an exception here."""

from __future__ import annotations

import os
import tempfile
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

from kinsym.command.importing import robot_file
from kinsym.errors import RobotError
from kinsym.robot import Robot, from_inline, load, to_toml
from kinsym.robot.catalogue import gallery_path
from kinsym.robot.dh_text import rows_from_csv
from kinsym.robot.expressions import parse
from kinsym.robot.files import from_draft, toml_draft
from kinsym.robot.snapping import EXACT
from kinsym.robot.text import cell_text
from tests.urdf.trees import J, urdf

LONGEST_MESSAGE = 1200
MEMORY = "/dev/shm"


def cell(data: bytes) -> None:
    """An accepted cell, written out, is read as the same cell."""
    value = parse(_text(data), where="cell")
    assert parse(cell_text(value)) == value, cell_text(value)


def toml(data: bytes) -> None:
    """A robot file."""
    _read_back(from_draft(toml_draft(_text(data), "arm.toml"), where="arm.toml"))


def csv(data: bytes) -> None:
    """A table in CSV."""
    rows = rows_from_csv(_text(data), where="arm.csv")
    _read_back(from_draft({"name": "arm", "convention": "craig", "joints": rows}, where="arm.csv"))


def inline(data: bytes) -> None:
    """A table in one line."""
    _read_back(from_inline(_text(data), convention="paul"))


def urdf_file(data: bytes) -> None:
    """A URDF file, the only format that is read from a path alone."""
    path = _file()
    path.write_bytes(data)
    _read_back(load(str(path)))


TARGETS: dict[str, Callable[[bytes], None]] = {
    "cell": cell,
    "toml": toml,
    "csv": csv,
    "inline": inline,
    "urdf": urdf_file,
}


def run(reader: str, data: bytes) -> bool:
    """Whether a reader accepts some bytes; a refusal has to be a message that can be acted upon."""
    try:
        TARGETS[reader](data)
    except RobotError as error:
        fault = fault_of(error)
    else:
        return True
    assert not fault, fault
    return False


def fault_of(error: RobotError) -> str:
    """What a message lacks: one printable line of bounded length, a place, a remedy; empty if it has all."""
    text = str(error)
    if not text.isprintable() or len(text) > LONGEST_MESSAGE:
        return f"the message is no line: {text!a}"
    if not error.where or not error.remedy.endswith("."):
        return f"the message has no place or no remedy: {text}"
    return ""


def seeds(reader: str) -> Iterator[bytes]:
    """Good input to begin with."""
    tables = [gallery_path(name).read_bytes() for name in ("planar_rr", "scara", "stanford_screw", "kuka_iiwa", "ur5")]
    match reader:
        case "toml":
            yield from tables
        case "cell":
            yield from (b"theta1 - pi/2", b"sqrt(2)/2 + 0.1", b"(a1 + b)**2", b"deg(30)*2", b"cos(pi/8) - 1e-3")
        case "csv":
            yield b"alpha,a,d,theta,type,variable\n# one\n0,l1,0,theta1,R,\npi/2,0,d2 + 0.1,0,P,d2\n"
            yield b'theta,d,a,alpha\n"theta1",0,"0.5",1.5708\n'
        case "inline":
            yield b"pi/2 0 d1 theta1; 0 a2 0 theta2-pi/2; 0 a3 d3+0.1 0;"
        case "urdf":
            two = (J("j1", "revolute", "a", "b"), J("j2", "prismatic", "b", "c", "0.4 0 1e-9", "1.5708 0 0"))
            yield urdf(*two).encode()
            yield urdf(*two, J("j3", "fixed", "c", "tool", rpy="0 0.3 0"), J("j4", "continuous", "tool", "e")).encode()


def words() -> tuple[str, ...]:
    """What the formats are made of, for a fuzzer that puts words together."""
    return (
        *"name title source convention task joints home parameters base tool locks nominal type".split(),
        *"variable limits alpha a d theta s s0 xyz rpy matrix paul craig screw input R P fixed".split(),
        *"theta1 theta2 d1 d3 l1".split(),
        *"pi/2 deg( sqrt( sin( cos( ** 1e-9 1.5708 [[joints]] [parameters] [locks] [home] [base] [tool]".split(),
        *'<robot <link <joint <parent <child <origin <axis <limit <mimic name= type=" link=" xyz=" rpy="'.split(),
        *"revolute continuous prismatic floating planar <!DOCTYPE <!ENTITY &#10; CDATA __class__ nan inf".split(),
    )


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def _read_back(robot: Robot) -> None:
    """A robot, written as a file, is the same robot, and the file holds nothing more."""
    draft = tomllib.loads(to_toml(robot))
    again = from_draft(draft, where="again", snapping=EXACT)
    for part in ("name", "title", "convention", "joints", "home", "base", "tool", "parameters", "locks", "task"):
        assert getattr(again, part) == getattr(robot, part), part
    assert tomllib.loads(robot_file(robot)) == draft


@cache
def _file() -> Path:
    folder = tempfile.mkdtemp(prefix="kinsym-fuzz-", dir=MEMORY if os.access(MEMORY, os.W_OK) else None)
    return Path(folder) / "arm.urdf"
