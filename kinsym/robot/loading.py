"""A robot by its name in the gallery or from a file, whatever its format."""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from kinsym.errors import RobotError
from kinsym.robot.binding import bind, fold_zeros
from kinsym.robot.catalogue import gallery, gallery_path
from kinsym.robot.dh_text import rows_from_csv
from kinsym.robot.files import from_draft, needed_convention, toml_draft
from kinsym.robot.model import Robot
from kinsym.robot.names import nearest, shown
from kinsym.robot.reading import read_text
from kinsym.robot.snapping import ROUNDING, Snapping

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
        from kinsym.robot.urdf import from_urdf  # its parser is an extra

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
        draft["convention"] = needed_convention(convention, source)
    else:
        draft = toml_draft(text, source)
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
