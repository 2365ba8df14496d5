"""A workspace as a picture or a file wants it: asked for on a grid, evaluated part by part.

Every part of a grid is a task of its own, which a process or another machine can do (:mod:`kinsym.workspace.runners`);
what is done is kept in a file, so that a sweep that was stopped goes on where it was
(:mod:`kinsym.workspace.partial`).
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kinsym.errors import DoesNotApply, RobotError
from kinsym.live import LiveArm, check_values
from kinsym.methods.planar_workspace import closed
from kinsym.robot.model import Robot
from kinsym.robot.summary import digest
from kinsym.skeleton import linkage
from kinsym.workspace.evaluate import ORIENTATIONS, counted
from kinsym.workspace.grids import Axis

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from kinsym.live import Bools, Floats

    Counts = NDArray[np.int64]

KINDS = ("reachable", "dexterous", "constant")
_POSES = 1 << 13
"""Poses of one task: some tenths of a second for most arms."""

Progress = Callable[[int, int], None]


@dataclass(frozen=True, kw_only=True)
class Question:
    """Which workspace of which arm, at which points.

    ``kind`` is one of :data:`KINDS`, ``x``, ``y``, ``z`` the coordinates of the grid, one value where a slice lies.
    ``count`` orientations are tried, of a constant one the ``rotation`` (3 rows). ``limits`` tells whether those of the
    joints count, ``values`` are those of parameters without one and of locked joints.
    """

    robot: Robot
    kind: str
    x: Axis
    y: Axis
    z: Axis
    count: int = ORIENTATIONS
    rotation: tuple[tuple[float, ...], ...] | None = None
    limits: bool = True
    values: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise RobotError(f"{self.kind!r} is no kind of workspace", remedy=f"There are {', '.join(KINDS)}.")
        if (self.kind == "constant") != (self.rotation is not None):
            raise RobotError("an orientation belongs to the workspace of a constant one, and to no other")

    @property
    def shape(self) -> tuple[int, int, int]:
        """How many points the grid has along x, y and z."""
        return len(self.x), len(self.y), len(self.z)

    def points(self, start: int, stop: int) -> Floats:
        """Points (k, 3) of the grid in its order, z fastest."""
        import numpy as np

        places = np.unravel_index(np.arange(start, stop), self.shape)
        axes = (np.array(axis) for axis in (self.x, self.y, self.z))
        return np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=-1)

    def parts(self) -> list[tuple[int, int]]:
        """The grid in tasks: first point and the one after the last."""
        nx, ny, nz = self.shape
        step = max(1, _POSES // (1 if self.kind == "constant" else self.count))
        return [(start, min(start + step, nx * ny * nz)) for start in range(0, nx * ny * nz, step)]

    def said(self) -> dict[str, str]:
        """What tells this question from another one, by what a user would call it."""
        return {
            "robot": digest(self.robot),
            "values": json.dumps(dict(self.values), sort_keys=True),
            "workspace": self.kind,
            "grid": json.dumps([self.x, self.y, self.z]),
            "orientations": str(self.count) if self.rotation is None else json.dumps(self.rotation),
            "limits": str(self.limits),
        }


@dataclass(frozen=True, kw_only=True)
class Workspace:
    """What was found: of ``tried`` orientations ``hits`` (nx, ny, nz) are reached at each point of the grid.

    ``base`` (3,) is where the arm stands. ``border`` has the radii, about the base, of a workspace that is known in
    closed form.
    """

    question: Question
    tried: int
    hits: Counts
    base: Floats
    border: tuple[float, ...] = ()

    @property
    def inside(self) -> Bools:
        """Which points (nx, ny, nz) belong to the workspace that was asked for."""
        return self.hits == self.tried if self.question.kind == "dexterous" else self.hits > 0

    @property
    def share(self) -> Floats:
        """Which share of the orientations is reached at each point, (nx, ny, nz)."""
        result: Floats = self.hits / self.tried
        return result


def evaluate(question: Question, arm: LiveArm, start: int, stop: int) -> Counts:
    """How many orientations are reached at some of the points, (stop - start,)."""
    rotation = None if question.rotation is None else [list(row) for row in question.rotation]
    points = question.points(start, stop)
    return counted(arm, points, question.kind, count=question.count, rotation=rotation, limits=question.limits)


def sweep(
    question: Question,
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    keep: Path | None = None,
    progress: Progress | None = None,
) -> Workspace:
    """Evaluate a workspace; with ``jobs`` processes or on the Dask cluster whose ``scheduler`` has this address.

    What is found is kept in the file ``keep`` until all is done, and gone on with if it is there. ``progress`` is
    called with the points done and all of them. Raises :class:`RobotError` with the parameters that lack a value, and
    :class:`kinsym.errors.OutputError` for a file that belongs to another question.
    """
    import numpy as np

    from kinsym.workspace.partial import Kept
    from kinsym.workspace.runners import run

    robot = question.robot
    check_values(robot, question.values, [name for name, cell in robot.locks.items() if cell is None])
    total = int(np.prod(question.shape))
    with Kept(question, keep) as kept:
        left = [part for part in question.parts() if not kept.has(*part)]
        if progress is not None:
            progress(kept.count, total)
        for start, stop, hits in run(question, left, jobs=jobs, scheduler=scheduler):
            kept.put(start, stop, hits)
            if progress is not None:
                progress(kept.count, total)
        hits = kept.done()
    return found(question, hits)


def found(question: Question, hits: Any) -> Workspace:
    """The workspace of a question whose answer (nx, ny, nz), or in the grid's order, is known."""
    import numpy as np

    axes = linkage(question.robot, _of_parameters(question)).axes
    tried = 1 if question.rotation is not None else int(max(1, question.count))
    return Workspace(
        question=question,
        tried=tried,
        hits=np.asarray(hits).reshape(question.shape),
        base=axes[0, :3, 3],
        border=_border(question),
    )


def _of_parameters(question: Question) -> dict[str, float]:
    return {name: value for name, value in question.values.items() if name in question.robot.parameters}


def _border(question: Question) -> tuple[float, ...]:
    """The radii of the closed border (:func:`closed`), of stretched and of folded links; none where it is not known."""
    import numpy as np

    shape = linkage(question.robot, _of_parameters(question))
    if question.limits and np.isfinite(shape.limits).any():
        return ()
    try:
        closed(question.robot)
    except DoesNotApply:
        return ()
    path = shape.at(np.zeros(2)).path
    first, second = (float(np.linalg.norm(path[k + 1] - path[k])) for k in (2, 4))
    return tuple(radius for radius in (abs(first - second), first + second) if radius > 0.0)
