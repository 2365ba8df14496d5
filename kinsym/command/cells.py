"""Postures and poses as a user writes them on the command line: cells, as in a table, with commas between them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.errors import RobotError
from kinsym.postures import general_posture
from kinsym.robot.expressions import number
from kinsym.robot.locking import joint_value
from kinsym.robot.names import shown

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.robot.model import Robot
    from kinsym.skeleton import Linkage


def posture_of(robot: Robot, shape: Linkage, text: str | None) -> Floats:
    """Joint values (n,) from text such as ``0.1, deg(20), 0``, a posture that shows the arm well without it.

    Joints that the robot holds stand at their values. Raises RobotError for the wrong number of cells, for a value
    outside the limits of its joint and for one that a held joint does not have.
    """
    import numpy as np

    held = {name: float(cell) for name, cell in robot.locks.items() if cell is not None}
    if text is None:
        return general_posture(shape, held)
    cells = [cell.strip() for cell in text.split(",")]
    if len(cells) != len(shape.variables):
        raise RobotError(
            f"--joints has {len(cells)} value{'s' * (len(cells) != 1)}, {robot.name} has {len(shape.variables)} joints",
            remedy=f"Give one for each of {', '.join(shape.variables)}.",
        )
    values = [
        float(joint_value(cell, joint, f"--joints {joint.variable}"))
        for cell, joint in zip(cells, robot.moving, strict=True)
    ]
    for name, value in held.items():
        given = values[shape.variables.index(name)]
        if abs(given - value) > 1e-9:
            raise RobotError(
                f"{name} = {given:.6g} and the robot holds it at {value:.6g}",
                where="--joints",
                remedy=f"Give that value, or another --lock {name}=VALUE.",
            )
    return np.array(values)


def pose_of(text: str) -> Floats:
    """A pose (4, 4) from text ``x, y, z`` or ``x, y, z, roll, pitch, yaw``, the angles as in URDF.

    >>> pose_of("0.1, 0, 0.5, 0, 0, deg(90)")[:2, :2].round(3).tolist()
    [[0.0, -1.0], [1.0, 0.0]]
    """
    import numpy as np

    values = numbers(text, (3, 6), "--pose")
    pose = np.eye(4)
    pose[:3, 3] = values[:3]
    pose[:3, :3] = rotation(values[3:] or [0.0, 0.0, 0.0])
    return pose


def numbers(text: str, counts: tuple[int, ...], option: str) -> list[float]:
    """The values of cells; RobotError for what is no number, or not as many as there may be.

    >>> numbers("1/2, 0, 0.25", (3,), "--orientation")
    [0.5, 0.0, 0.25]
    """
    cells = text.split(",")
    if len(cells) not in counts:
        wanted = " or ".join(map(str, counts))
        raise RobotError(
            f"{shown(text)} has {len(cells)} cells", where=option, remedy=f"Write {wanted} with commas between."
        )
    return [float(number(cell, where=f"{option}, value {place}")) for place, cell in enumerate(cells, start=1)]


def rotation(angles: list[float]) -> Floats:
    """The rotation (3, 3) Rz(yaw) Ry(pitch) Rx(roll) of roll, pitch and yaw, as in URDF."""
    import numpy as np

    (cx, cy, cz), (sx, sy, sz) = np.cos(angles), np.sin(angles)
    return np.array(
        [
            [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
            [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
            [-sy, cy * sx, cy * cx],
        ]
    )
