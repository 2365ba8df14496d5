"""A robot with numbers: its generated module run in memory, every parameter given a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kinsym.errors import RobotError
from kinsym.poses import as_poses
from kinsym.robot.model import Robot

if TYPE_CHECKING:
    from types import ModuleType

    import numpy as np
    from numpy.typing import NDArray

    from kinsym.derivation import Derivation

    Floats = NDArray[np.float64]
    Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class LiveArm:
    """A derivation, its NumPy module and the values that its functions are called with.

    ``values`` are those of parameters without a value in the table; ``inputs`` those of locked joints that the inverse
    kinematics is given.
    """

    derivation: Derivation
    module: ModuleType
    values: Mapping[str, float]
    inputs: Mapping[str, float]

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self.derivation.robot

    def fk(self, q: Floats) -> Floats:
        """Poses (..., 4, 4) of joint vectors (..., n), angles in radians."""
        result: Floats = self.module.fk(q, **self.values)
        return result

    def ik(self, poses: Any) -> tuple[Floats, Bools]:
        """All solutions (..., S, n) of poses (..., 4, 4), and which of them there are (..., S).

        Poses are whatever :func:`kinsym.poses.as_poses` reads.
        """
        q, valid = self.module.ik_batch(as_poses(poses), **self.values, **self.inputs)
        return q, valid

    def solve(self, pose: Any) -> Any:
        """The solutions of one pose with their marks: which joints are free, and of which two solutions meet."""
        return self.module.solve(as_poses(pose), **self.values, **self.inputs)

    @property
    def limits(self) -> Floats:
        """Low and high of every joint (n, 2), infinite where the table has none."""
        import numpy as np

        return np.array(self.module.LIMITS, dtype=float)


def live(robot: Robot, values: Mapping[str, float] | None = None) -> LiveArm:
    """Derive a robot and run its module; ``values`` are those of parameters and of locked joints that are inputs.

    Raises :class:`RobotError` with the parameters that lack a value, or with a name the robot does not have, and what
    :func:`kinsym.deriving.derive` raises.
    """
    given = dict(values or {})
    inputs = [name for name, cell in robot.locks.items() if cell is None]
    _check(robot, given, inputs)
    from kinsym.deriving import derive
    from kinsym.emit.live import live_module
    from kinsym.emit.program import build_schedule

    derivation = derive(robot)
    module = live_module(build_schedule(derivation))
    parameters = {name: given[name] for name in robot.parameters if name in given}
    return LiveArm(derivation, module, parameters, {name: given[name] for name in inputs})


def _check(robot: Robot, given: Mapping[str, float], inputs: list[str]) -> None:
    import math
    from numbers import Real

    unknown = [name for name in given if name not in robot.parameters and name not in inputs]
    if unknown:
        raise RobotError(
            f"it has no parameter {', '.join(unknown)}", where=robot.name, remedy=f"It has {_list(robot, inputs)}."
        )
    lacking = [name for name, value in robot.parameters.items() if value is None and name not in given]
    lacking += [name for name in inputs if name not in given]
    if lacking:
        one = len(lacking) == 1
        raise RobotError(
            f"the parameter{'' if one else 's'} {', '.join(lacking)} ha{'s' if one else 've'} no value",
            where=robot.name,
            remedy="Write numbers under [parameters] of the robot file, or give them with the call.",
        )
    for name, value in given.items():
        if not isinstance(value, Real) or not math.isfinite(value):
            raise RobotError(f"{name} = {value!r} is no number", where=robot.name, remedy="Give a finite number.")


def _list(robot: Robot, inputs: list[str]) -> str:
    return ", ".join([*robot.parameters, *inputs]) or "none"
