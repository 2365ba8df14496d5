"""What may be given as a pose: a matrix, an SE3 of spatialmath, a rotation of SciPy with a vector.

None of these libraries is imported: an object is known by what it offers. SE3 and its like have their matrix, or a list
of them, in the attribute ``A``; SciPy's Rotation has ``as_matrix()``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kinsym.errors import RobotError

if TYPE_CHECKING:
    from kinsym.live import Floats

Pose = Any
"""What :func:`as_poses` reads."""

FORMS = "Give a matrix (4, 4), an SE3 of spatialmath, or a pair of a SciPy Rotation and a vector (3,)."


def as_poses(given: Pose, what: str = "the pose") -> Floats:
    """Poses (..., 4, 4) of floats.

    ``given`` is an array or lists (..., 4, 4); an object with such an array, or with a list of matrices, in its
    attribute ``A`` (spatialmath's SE3); or a pair (rotation, vector), where the rotation has ``as_matrix()`` (SciPy's
    Rotation, one or many) or is an array (..., 3, 3) and the vector is (..., 3). Whether it is a rigid motion is not
    asked here.

    Raises :class:`RobotError`, which names ``what`` is wrong, for everything else.

    >>> import numpy as np
    >>> as_poses((np.eye(3), [0.1, 0.2, 0.3]))[:3, 3]
    array([0.1, 0.2, 0.3])
    """
    pair = _pair(given)
    if pair is not None:
        return _joined(*pair, what)
    pose = _array(getattr(given, "A", given), what)
    if pose.shape[-2:] != (4, 4):
        raise RobotError(f"{what} has the shape {pose.shape}", remedy=f"A pose has the shape (4, 4). {FORMS}")
    return pose


def _pair(given: Any) -> tuple[Any, Any] | None:
    """The rotation and the vector, if it is a pair; a list of two matrices (4, 4) is none."""
    import numpy as np

    if not isinstance(given, (tuple, list)) or len(given) != 2:
        return None
    first, second = given
    if callable(getattr(first, "as_matrix", None)):
        return first, second
    try:
        plain = not hasattr(first, "A") and np.shape(first)[-2:] == (3, 3)
    except ValueError:  # rows of several lengths
        return None
    return (first, second) if plain else None


def _joined(rotation: Any, vector: Any, what: str) -> Floats:
    import numpy as np

    turn = _array(rotation.as_matrix() if hasattr(rotation, "as_matrix") else rotation, f"the rotation of {what}")
    place = _array(vector, f"the vector of {what}")
    if place.shape[-1:] != (3,):
        raise RobotError(f"the vector of {what} has the shape {place.shape}", remedy="Give three numbers.")
    try:
        shape = np.broadcast_shapes(turn.shape[:-2], place.shape[:-1])
    except ValueError:
        raise RobotError(
            f"{what} has rotations {turn.shape} and vectors {place.shape}",
            remedy="Give as many of one as of the other.",
        ) from None
    pose = np.zeros((*shape, 4, 4))
    pose[..., :3, :3], pose[..., :3, 3], pose[..., 3, 3] = turn, place, 1.0
    return pose


def _array(given: Any, what: str) -> Floats:
    import numpy as np

    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError) as error:
        raise RobotError(f"{what} is no matrix of numbers: {error}", remedy=FORMS) from None
