"""The gallery: robots of the lecture and real ones with the source of their numbers, as files every user could write.

Names, titles and what is derived of each robot are read without SymPy, so that ``kinsym robots`` answers at once: the
index is written by ``python -m tests.regenerate`` from the derivations, and ``tests/test_generated.py`` holds it.
"""

from __future__ import annotations

import json
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

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
    return {name: head["title"] for name, head in gallery_heads().items()}


def gallery_index() -> dict[str, dict[str, Any]]:
    """What is derived of each robot, by name: ``class``, ``joints``, ``locked``, ``solutions``, ``closed_form``.

    >>> gallery_index()["ur5"]["class"], gallery_index()["ur5"]["solutions"]
    ('three parallel axes', 8)
    """
    index: dict[str, dict[str, Any]] = json.loads(index_path().read_text(encoding="utf-8"))
    return index


def index_path() -> Path:
    """The file of :func:`gallery_index`."""
    return _folder() / "index.json"


def gallery_heads() -> dict[str, dict[str, str]]:
    """Title, convention and source of each robot as its file says, in the order of :func:`gallery`."""
    heads = {}
    for name in gallery():
        with gallery_path(name).open("rb") as file:
            content = tomllib.load(file)
        heads[name] = {key: str(content.get(key, "")) for key in ("title", "convention", "source")}
    return heads
