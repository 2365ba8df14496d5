"""Text of a file that nobody vouches for."""

from __future__ import annotations

from pathlib import Path

from kinsym.errors import RobotError
from kinsym.robot.names import nearest

LARGEST_FILE = 1 << 20


def read_text(path: Path, *, shown_as: str, largest: int = LARGEST_FILE) -> str:
    """The text of a UTF-8 file of at most ``largest`` bytes (1 MiB).

    ``shown_as`` is how messages name it. Raises RobotError for what is missing, unreadable, no regular file (a
    pipe would wait for ever), too large, binary or not UTF-8.
    """
    try:
        if not path.exists():
            hint = nearest(path.name, (beside.name for beside in path.parent.glob("*" + path.suffix)))
            raise RobotError("there is no such file", where=shown_as, remedy=hint + "Check the path.")
        if not path.is_file():
            raise RobotError("this is not a regular file", where=shown_as, remedy="Name a .toml, .csv or .urdf file.")
        with path.open("rb") as file:
            data = file.read(largest + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise RobotError(
            f"the file cannot be read ({reason})", where=shown_as, remedy="Check its name and permissions."
        ) from None
    if len(data) > largest:
        raise RobotError(
            f"the file is larger than {largest >> 20} MiB", where=shown_as, remedy="A robot needs a few lines."
        )
    if b"\0" in data:
        raise RobotError("the file is binary", where=shown_as, remedy="Name a text file in TOML, CSV or URDF.")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise RobotError(
            "the file is not UTF-8 text", where=f"{shown_as}, line {line}", remedy="Save it as UTF-8."
        ) from None
