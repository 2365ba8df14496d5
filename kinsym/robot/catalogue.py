"""The gallery: robots of the lecture and real ones with the source of their numbers, as files every user could write.

Names and titles are read without SymPy, so that ``kinsym robots`` answers at once.
"""

from __future__ import annotations

import tomllib
from importlib import resources
from pathlib import Path

from kinsym.errors import RobotError
from kinsym.robot.names import nearest

_SUFFIX = ".toml"


def _folder() -> Path:
    return Path(str(resources.files("kinsym.robot"))) / "gallery"


def gallery() -> tuple[str, ...]:
    """The names of the robots in the gallery, sorted.

    >>> "puma560" in gallery()
    True
    """
    return tuple(sorted(path.stem for path in _folder().glob("*" + _SUFFIX)))


def gallery_path(name: str) -> Path:
    """The file of one robot of the gallery.

    Raises RobotError if there is none of that name.

    >>> gallery_path("ur5").name
    'ur5.toml'
    """
    if name not in gallery():
        raise RobotError(
            f"the gallery has no robot {name!r}",
            remedy=nearest(name, gallery()) + "List them with: kinsym robots.",
        )
    return _folder() / (name + _SUFFIX)


def gallery_titles() -> dict[str, str]:
    """The titles by name, in the order of :func:`gallery`.

    >>> gallery_titles()["scara"]
    'SCARA manipulator (RRPR)'
    """
    titles = {}
    for name in gallery():
        with gallery_path(name).open("rb") as file:
            titles[name] = str(tomllib.load(file)["title"])
    return titles
