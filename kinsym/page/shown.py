"""What a page shows of an arm: values for parameters that have none, a posture, and all solutions of its pose."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.check.poses import lengths_of
from kinsym.live import LiveArm
from kinsym.page.picture import AZIMUTH
from kinsym.skeleton import Linkage, linkage

if TYPE_CHECKING:
    from types import ModuleType

    from kinsym.derivation import Derivation
    from kinsym.live import Floats
    from kinsym.robot.model import Robot

LENGTHS = (1.0, 0.85, 0.7, 0.55, 0.4)
"""Values for lengths without one: no two neighbours are equal, so that no arm lies folded on itself."""
ANGLE = math.pi / 6
"""The value of an angle without one."""
SLIDE = 0.4
"""The value of a locked slide that is an input, a share of the arm's size."""

SIDEWAYS = (-math.sin(AZIMUTH), math.cos(AZIMUTH), 0.0)
"""To the right of the view."""

_TRIES = 400
_STEP = 15
_STEPS_OF_SLIDE = 20


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A joint vector (n,) with the number of its branch."""

    branch: int
    q: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Shown:
    """An arm in numbers at the posture ``q`` of its page; ``given`` are the parameters in the order of the module."""

    arm: LiveArm
    shape: Linkage
    given: tuple[float, ...]
    q: tuple[float, ...]
    pose: Floats
    solutions: tuple[Solution, ...]


def shown(derivation: Derivation, module: ModuleType) -> Shown:
    """The arm of a derivation as its page shows it first; ``module`` is its NumPy module."""
    robot = derivation.robot
    values = chosen(robot)
    shape = linkage(robot, values)
    inputs = {name: _input(shape, name) for name, cell in robot.locks.items() if cell is None}
    arm = LiveArm(derivation, module, values, inputs)
    q = _posture(arm, shape)
    pose = arm.fk(q)
    return Shown(
        arm=arm,
        shape=shape,
        given=tuple(values[name] if value is None else float(value) for name, value in robot.parameters.items()),
        q=tuple(map(float, q)),
        pose=pose,
        solutions=_solutions(arm, pose, q),
    )


def chosen(robot: Robot) -> dict[str, float]:
    """Values for the parameters that have none in the table.

    >>> from kinsym.robot import load
    >>> chosen(load("planar_rr"))
    {'l1': 1.0, 'l2': 0.85}
    """
    lengths = lengths_of(robot)
    free = [name for name, value in robot.parameters.items() if value is None]
    long = [name for name in free if name in lengths]
    return {name: LENGTHS[long.index(name) % len(LENGTHS)] if name in lengths else ANGLE for name in free}


def _input(shape: Linkage, name: str) -> float:
    """The value of a joint that the inverse kinematics is given; the middle of its limits where they forbid it."""
    place = shape.variables.index(name)
    value = ANGLE if shape.kinds[place] == "R" else float(f"{SLIDE * shape.size:.2g}")
    low, high = map(float, shape.limits[place])
    return value if low <= value <= high else (low + high) / 2.0


def _posture(arm: LiveArm, shape: Linkage) -> Floats:
    """Joint values at whole steps: of those with the most solutions the ones furthest from a singular posture."""
    import numpy as np

    generator = random.Random(0)
    locked: Mapping[str, float | None] = getattr(arm.module, "LOCKED", {})
    tries = np.array([_drawn(shape, generator) for _ in range(_TRIES)])
    for place, name in enumerate(shape.variables):
        if name in locked:
            tries[:, place] = arm.inputs[name] if locked[name] is None else locked[name]
    _, valid = arm.ik_batch(arm.fk(tries))
    counts = valid.sum(axis=-1)
    worth = np.round(_worth(arm, shape, tries), 3)
    result: Floats = tries[int(np.argmax(np.where(counts == counts.max(), worth, -np.inf)))]
    return result


def _drawn(shape: Linkage, generator: random.Random) -> list[float]:
    """Joint values inside the limits: angles at whole steps, lengths with three digits."""
    values = []
    for kind, limits in zip(shape.kinds, shape.limits, strict=True):
        low, high = map(float, limits)
        turning = kind == "R"
        if not (math.isfinite(low) and math.isfinite(high)):
            low, high = (-math.pi, math.pi) if turning else (0.2 * shape.size, shape.size)
        steps = range(math.ceil(math.degrees(low) / _STEP + 1e-9), math.floor(math.degrees(high) / _STEP + 1e-9) + 1)
        if turning and steps:
            values.append(math.radians(generator.choice(steps) * _STEP))
            continue
        share = generator.randint(1, _STEPS_OF_SLIDE - 1) / _STEPS_OF_SLIDE
        values.append(float(f"{low + (high - low) * share:.3g}"))
    return values


def _worth(arm: LiveArm, shape: Linkage, q: Floats) -> Floats:
    """How well postures (k, n) show the arm, (k,): its manipulability (Yoshikawa 1985), nothing below the base.

    Of two that are as good the arm reaches out to the right of the view.
    """
    import numpy as np

    jacobian = arm.module.jacobian(q, **arm.values)
    jacobian[..., :3, :] /= shape.size
    sliding = np.array([kind == "P" for kind in shape.kinds])
    jacobian[..., :3, :] *= np.where(sliding, shape.size, 1.0)
    sizes = np.linalg.svd(jacobian, compute_uv=False)
    path = shape.at(q).path
    height = (path[:, -1, 2] - path[:, 0, 2]) / shape.size
    aside = (path[:, -1] - path[:, 0]) @ np.array(SIDEWAYS) / shape.size
    lowest = ((path[..., 2] - path[..., :1, 2]).min(axis=-1)) / shape.size
    manipulable = np.exp(np.log(np.maximum(sizes, 1e-9)).mean(axis=-1))
    worth: Floats = manipulable + (0.0 if shape.plane else 2.0 * np.minimum(lowest, 0.0) + 0.3 * aside + 0.3 * height)
    return worth


def _solutions(arm: LiveArm, pose: Floats, q: Floats) -> tuple[Solution, ...]:
    """All solutions of a pose (4, 4) in the order of their branches; of a general solver in its own order."""
    found = arm.module.solve(pose, reference=q, **arm.values, **arm.inputs)
    general = arm.derivation.plan is None
    return tuple(
        Solution(branch=number if general else int(branch), q=tuple(map(float, row)))
        for number, (branch, row) in enumerate(zip(found.branch, found.q, strict=True))
    )
