"""Base, station, wrist, tool and goal (lecture, slide 46): T_S_T = T_B_S^-1 T_B_W T_W_T, and the tool at the goal.

The base frame B and the wrist frame W are those of the robot file: what its forward kinematics leads from and to, a
[base] and a [tool] that the file has being part of it. The station S is given in B, the tool T in W, the goal G in S.
The tool is at the goal, T_S_T = T_S_G, exactly where T_B_W = T_B_S T_S_G T_W_T^-1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from sympy import Expr, Integer

from kinsym.algebra.tree import Tree
from kinsym.errors import RobotError
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.forward import forward_kinematics
from kinsym.live import LiveArm, live
from kinsym.robot.model import Convention, Matrix, Robot
from kinsym.robot.rigid import check_rotation

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from kinsym.live import Floats

_ORTHOGONAL = 1e-6
"""How far a rotation may be from one, the accuracy that the generated code asks for as well."""


def tool_in_station(wrist: ArrayLike, *, station: ArrayLike | None = None, tool: ArrayLike | None = None) -> Floats:
    """T_S_T (..., 4, 4) of the wrist T_B_W (..., 4, 4), with the station T_B_S and the tool T_W_T (4, 4).

    A station or a tool that is left out coincides with the base or the wrist. Raises :class:`RobotError` for what is
    no pose.

    >>> import numpy as np
    >>> lifted = np.eye(4)
    >>> lifted[2, 3] = 0.5
    >>> float(tool_in_station(np.eye(4), station=lifted)[2, 3])
    -0.5
    """
    pose = _pose(wrist, "the wrist T_B_W")
    result: Floats = _inverse(_fixed(station, "the station T_B_S")) @ pose @ _fixed(tool, "the tool T_W_T")
    return result


def wrist_at_goal(goal: ArrayLike, *, station: ArrayLike | None = None, tool: ArrayLike | None = None) -> Floats:
    """T_B_W (..., 4, 4) that brings the tool to the goal T_S_G (..., 4, 4): T_B_S T_S_G T_W_T^-1."""
    pose = _pose(goal, "the goal T_S_G")
    result: Floats = _fixed(station, "the station T_B_S") @ pose @ _inverse(_fixed(tool, "the tool T_W_T"))
    return result


def solve_tool_at_goal(
    robot: Robot | LiveArm,
    goal: ArrayLike,
    *,
    station: ArrayLike | None = None,
    tool: ArrayLike | None = None,
    values: Mapping[str, float] | None = None,
) -> Floats:
    """All joint vectors (m, n) with the tool frame at the goal T_S_G (4, 4), angles in radians; m = 0 if out of reach.

    ``station`` is T_B_S and ``tool`` T_W_T, both (4, 4); ``values`` are those of parameters without one in the table.
    An arm whose task gives a part of the pose alone brings the wrist there in that part. Raises :class:`RobotError`
    for what is no pose and for parameters that lack a value.
    """
    arm = robot if isinstance(robot, LiveArm) else live(robot, values)
    wanted = wrist_at_goal(goal, station=station, tool=tool)
    if wanted.shape != (4, 4):
        raise RobotError(f"a goal has the shape (4, 4), not {wanted.shape}", where=arm.robot.name)
    return arm.ik(wanted)


def with_frames(robot: Robot, *, station: Matrix | None = None, tool: Matrix | None = None) -> Robot:
    """The same arm seen from a station, with a tool at its end: its forward kinematics is T_S_T, in symbols.

    ``station`` T_B_S and ``tool`` T_W_T are 4x4 cells of SymPy, as a robot file's [base] and [tool] are. The inverse
    kinematics of the new robot brings the tool to a goal that is given from the station. Raises :class:`RobotError`
    for what is no rigid transform and for a name that is a joint variable.
    """
    for what, given in (("station", station), ("tool", tool)):
        if given is not None:
            _check_cells(given, what, robot)
    if robot.convention is Convention.SCREW:
        robot = convert(robot, Convention.PAUL)
    base = robot.base
    if station is not None:
        base = _inverse_cells(station) if base is None else _product(_inverse_cells(station), base)
    end = robot.tool
    if tool is not None:
        end = tool if end is None else _product(end, tool)
    names = dict(robot.parameters)
    for matrix in (station, tool):
        for line in matrix or ():
            for cell in line:
                for symbol in sorted(cell.free_symbols, key=str):
                    names.setdefault(str(symbol), None)
    return replace(robot, base=base, tool=end, parameters=names)


def tool_in_station_symbolic(
    robot: Robot, *, station: Matrix | None = None, tool: Matrix | None = None
) -> tuple[tuple[Tree, ...], ...]:
    """T_S_T = T_B_S^-1 T_B_W T_W_T of a robot in symbols, 4x4 trees nested by joint."""
    from kinsym.algebra.nested import nested
    from kinsym.algebra.tree import ONE, ZERO

    chain = build_chain(with_frames(robot, station=station, tool=tool))
    columns = forward_kinematics(chain).columns
    rows = tuple(tuple(nested(chain.ring, column[i]) for column in columns) for i in range(3))
    return (*rows, (ZERO, ZERO, ZERO, ONE))


def _check_cells(matrix: Matrix, what: str, robot: Robot) -> None:
    if len(matrix) != 4 or any(len(line) != 4 for line in matrix) or tuple(matrix[3]) != (0, 0, 0, 1):
        raise RobotError(
            f"the {what} is no 4x4 transform", where=robot.name, remedy="Give four rows, the last of them 0 0 0 1."
        )
    u, v, w = ((matrix[0][k], matrix[1][k], matrix[2][k]) for k in range(3))
    check_rotation((u, v, w), what=f"the rotation of the {what}", where=robot.name)
    names = sorted({str(symbol) for line in matrix for cell in line for symbol in cell.free_symbols})
    taken = [name for name in names if name in robot.variables]
    if taken:
        raise RobotError(f"{taken[0]} is a joint variable", where=f"{robot.name}, {what}", remedy="Take another name.")


def _fixed(matrix: ArrayLike | None, what: str) -> Floats:
    import numpy as np

    if matrix is None:
        return np.eye(4)
    pose = _pose(matrix, what)
    if pose.shape != (4, 4):
        raise RobotError(f"{what} has the shape {pose.shape}", remedy="Give one matrix (4, 4).")
    return pose


def _pose(matrix: ArrayLike, what: str) -> Floats:
    """An array of poses; NaN fails every comparison and is refused as well."""
    import numpy as np

    try:
        pose: Floats = np.asarray(matrix, dtype=float)
    except (TypeError, ValueError) as error:
        raise RobotError(f"{what} is no matrix of numbers: {error}") from None
    if pose.shape[-2:] != (4, 4):
        raise RobotError(f"{what} has the shape {pose.shape}", remedy="A pose has the shape (4, 4).")
    rotation = pose[..., :3, :3]
    off = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(axis=(-1, -2))
    good = (off <= _ORTHOGONAL) & (np.linalg.det(np.nan_to_num(rotation)) > 0.0)
    good &= (pose[..., 3, :] == np.array([0.0, 0.0, 0.0, 1.0])).all(axis=-1) & np.isfinite(pose).all(axis=(-1, -2))
    if not np.all(good):
        raise RobotError(
            f"{what} is no rigid motion",
            remedy="Its rotation must be right-handed and orthogonal, its last row 0 0 0 1.",
        )
    return pose


def _inverse(pose: Floats) -> Floats:
    import numpy as np

    result = np.eye(4)
    result[:3, :3] = pose[:3, :3].T
    result[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return result


def _inverse_cells(matrix: Matrix) -> Matrix:
    """The inverse of a rigid transform of cells."""
    turned = [[matrix[j][i] for j in range(3)] for i in range(3)]
    rows: list[tuple[Expr, ...]] = []
    for line in turned:
        moved: Expr = -sum((cell * matrix[k][3] for k, cell in enumerate(line)), Integer(0))
        rows.append((*line, moved.expand()))
    zero, one = Integer(0), Integer(1)
    return (*rows, (zero, zero, zero, one))


def _product(left: Matrix, right: Matrix) -> Matrix:
    return tuple(
        tuple(sum((left[i][k] * right[k][j] for k in range(4)), Integer(0)).expand() for j in range(4))
        for i in range(4)
    )
