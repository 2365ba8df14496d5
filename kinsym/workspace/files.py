"""A workspace as data: a table for spreadsheets (CSV) or arrays for NumPy (.npz)."""

from __future__ import annotations

import io
import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.workspace.sweeping import Workspace

FORMATS = ("csv", "npz")


def data(found: Workspace, kind: str) -> bytes:
    """The bytes of a ``csv`` or an ``npz`` file, the same at every run.

    The table has a line a point: x, y, z, the orientations reached and tried, and whether the point is inside. The
    arrays are ``x``, ``y``, ``z``, ``hits`` and ``inside`` (nx, ny, nz), ``tried``, and ``question``, which is JSON.
    """
    return _table(found).encode() if kind == "csv" else _arrays(found)


def _table(found: Workspace) -> str:
    question = found.question
    points = question.points(0, found.hits.size)
    lines = ["x,y,z,orientations_reached,orientations_tried,inside"]
    for (x, y, z), hits, inside in zip(points, found.hits.flat, found.inside.flat, strict=True):
        lines.append(f"{float(x)!r},{float(y)!r},{float(z)!r},{int(hits)},{found.tried},{int(inside)}")
    return "\n".join(lines) + "\n"


def _arrays(found: Workspace) -> bytes:
    import numpy as np

    question = found.question
    file = io.BytesIO()
    np.savez_compressed(
        file,
        x=np.array(question.x),
        y=np.array(question.y),
        z=np.array(question.z),
        hits=found.hits,
        inside=found.inside,
        tried=np.array(found.tried),
        question=np.array(json.dumps({"name": question.robot.name, **question.said()})),
    )
    return file.getvalue()
