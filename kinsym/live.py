"""A robot with numbers: its functions, run in memory, with a value for every parameter.

The functions are those of the generated NumPy module, or of the compiled package that can take its place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.display import Displayed
from kinsym.errors import RobotError
from kinsym.robot.model import Robot

if TYPE_CHECKING:
    from types import ModuleType

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from kinsym.derivation import Derivation

    Floats = NDArray[np.float64]
    Bools = NDArray[np.bool_]
    Numbers = NDArray[np.intp]


@dataclass(frozen=True, kw_only=True, eq=False)
class Solutions(Displayed):
    """The solutions of one pose, m of them in the order of branches, and what the call came to.

    ``q`` (m, n) are the joint vectors, ``branch`` (m,) their numbers and ``names`` the names of these branches.
    ``free`` and ``border`` (m, n) tell which joints are free and of which two solutions meet, ``family`` (m, n) which
    move along the family of a free joint. ``status`` is ``"solved"``; ``"singular"``, solved with a joint that is free
    or on a border; ``"unreachable"``; ``"not a pose"``. ``joints`` and ``kinds`` ("R" or "P") are those of the arm.
    """

    q: Floats
    branch: Numbers
    names: tuple[str, ...]
    free: Bools
    border: Bools
    family: Bools
    status: str
    joints: tuple[str, ...]
    kinds: tuple[str, ...]

    def text(self) -> str:
        """One line a solution, angles in radians; a joint that is free or on a border says so."""
        from kinsym.emit.text.page import Page

        if not len(self.q):
            return self.status
        return Page().columns([("branch", *self.joints), *self._rows()], indent=0)

    def markdown(self) -> str:
        """The same as a Markdown table."""
        from kinsym.emit.latex.names import Names
        from kinsym.emit.markdown.words import table

        if not len(self.q):
            return self.status
        names = Names(self.joints)
        return table(("branch", *(f"${names[joint]}$" for joint in self.joints)), self._rows())

    def _rows(self) -> Iterator[tuple[str, ...]]:
        for number, name in enumerate(self.names):
            marks = zip(self.q[number], self.free[number], self.border[number], strict=True)
            yield (
                name,
                *(
                    _rounded(value) + (" free" if free else "") + (" border" if border else "")
                    for value, free, border in marks
                ),
            )

    def __str__(self) -> str:
        return self.text()


def _rounded(value: float) -> str:
    """Four decimals, and no minus sign before a zero.

    >>> _rounded(-1e-9)
    '0.0000'
    """
    return f"{round(value, 4) + 0.0:.4f}"


@dataclass(frozen=True)
class LiveArm:
    """A derivation, the module of its functions and the values that they are called with.

    ``values`` are those of parameters without a value in the table; ``inputs`` those of locked joints that the inverse
    kinematics is given. A call may give an input another value by its name: ``arm.ik(T, theta3=0.2)``. Angles are in
    radians, lengths in the unit of the table. What is no joint vector or no pose raises ValueError.

    >>> from kinsym.robot import load
    >>> arm = live(load("ur5"))
    >>> pose = arm.fk([0.1, -1.2, 1.3, 0.4, 0.5, 0.6])
    >>> arm.ik(pose).shape
    (8, 6)
    """

    derivation: Derivation
    module: ModuleType
    values: Mapping[str, float]
    inputs: Mapping[str, float]

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self.derivation.robot

    def fk(self, q: ArrayLike) -> Floats:
        """Poses (..., 4, 4) of joint vectors (..., n)."""
        result: Floats = self.module.fk(q, **self.values)
        return result

    def jacobian(self, q: ArrayLike) -> Floats:
        """Geometric Jacobians (..., 6, n) of joint vectors (..., n) in the base frame, velocity above."""
        result: Floats = self.module.jacobian(q, **self.values)
        return result

    def ik(self, pose: ArrayLike, *, reference: ArrayLike | None = None, **inputs: float) -> Floats:
        """All solutions (m, n) of one pose (4, 4); a joint that is free takes its value in ``reference`` (n,)."""
        result: Floats = self.module.ik(pose, reference=reference, **self.values, **self._inputs(inputs))
        return result

    def ik_batch(
        self, poses: ArrayLike, *, reference: ArrayLike | None = None, **inputs: ArrayLike
    ) -> tuple[Floats, Bools]:
        """All solutions (..., S, n) of poses (..., 4, 4), and which of them there are (..., S)."""
        q, valid = self.module.ik_batch(poses, reference=reference, **self.values, **self._inputs(inputs))
        return q, valid

    def solve(self, pose: ArrayLike, *, reference: ArrayLike | None = None, **inputs: float) -> Solutions:
        """The solutions of one pose (4, 4) with their branches and marks; what is no pose raises nothing."""
        return self._named(self.module.solve(pose, reference=reference, **self.values, **self._inputs(inputs)))

    def within(
        self,
        pose: ArrayLike,
        *,
        limits: ArrayLike | None = None,
        reference: ArrayLike | None = None,
        **inputs: float,
    ) -> Solutions:
        """The solutions inside the limits (n, 2) of the joints, default those of the table, in all their windings."""
        given = {**self.values, **self._inputs(inputs)}
        return self._named(self.module.within(pose, limits=limits, reference=reference, **given))

    def nearest(
        self,
        pose: ArrayLike,
        reference: ArrayLike,
        *,
        weights: ArrayLike | None = None,
        limits: ArrayLike | None = None,
        **inputs: float,
    ) -> Floats | None:
        """The solution (n,) nearest to a joint vector over all windings inside the limits, None if there is none."""
        given = {**self.values, **self._inputs(inputs)}
        result: Floats | None = self.module.nearest(pose, reference, weights=weights, limits=limits, **given)
        return result

    @property
    def limits(self) -> Floats:
        """Low and high of every joint (n, 2), infinite where the table has none."""
        import numpy as np

        return np.array(self.module.LIMITS, dtype=float)

    def _inputs(self, given: Mapping[str, ArrayLike]) -> Mapping[str, ArrayLike]:
        return {**self.inputs, **given} if given else self.inputs

    def _named(self, found: Solutions) -> Solutions:
        """What the module returned, with the names of branches and joints beside it."""
        module = self.module
        return Solutions(
            q=found.q,
            branch=found.branch,
            names=tuple(module.BRANCHES[number] for number in found.branch),
            free=found.free,
            border=found.border,
            family=found.family,
            status=found.status,
            joints=module.JOINTS,
            kinds=module.JOINT_TYPES,
        )


def live(robot: Robot, values: Mapping[str, float] | None = None) -> LiveArm:
    """Derive a robot and run its module; ``values`` are those of parameters and of locked joints that are inputs.

    Raises :class:`RobotError` with the parameters that lack a value, or with a name the robot does not have, and what
    :func:`kinsym.deriving.derive` raises.
    """
    from kinsym.deriving import derive
    from kinsym.emit.live import live_module
    from kinsym.emit.program import build_schedule

    checked_values(robot, values)
    derivation = derive(robot)
    return with_values(derivation, live_module(build_schedule(derivation)), values)


def with_values(derivation: Derivation, module: ModuleType, values: Mapping[str, float] | None = None) -> LiveArm:
    """The functions of a module, NumPy or compiled, with numbers; raises what :func:`check_values` raises."""
    robot = derivation.robot
    given, inputs = checked_values(robot, values), _inputs_of(robot)
    parameters = {name: given[name] for name in robot.parameters if name in given}
    return LiveArm(derivation, module, parameters, {name: given[name] for name in inputs})


def checked_values(robot: Robot, values: Mapping[str, float] | None) -> dict[str, float]:
    """The values themselves; raises what :func:`check_values` raises where one or a locked input has none."""
    given = dict(values or {})
    check_values(robot, given, _inputs_of(robot))
    return given


def _inputs_of(robot: Robot) -> list[str]:
    return [name for name, cell in robot.locks.items() if cell is None]


def check_values(robot: Robot, given: Mapping[str, float], inputs: Sequence[str] = ()) -> None:
    """Raise :class:`RobotError` where a parameter or one of the inputs has no value, or a value no name or number."""
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
            remedy="Write numbers under [parameters] of the robot file, or give them with the call "
            f"(on the command line: {' '.join(_option(robot, name) for name in lacking)}).",
        )
    for name, value in given.items():
        if not isinstance(value, Real) or not math.isfinite(value):
            raise RobotError(f"{name} = {value!r} is no number", where=robot.name, remedy="Give a finite number.")


def _option(robot: Robot, name: str) -> str:
    return f"--{'bind' if name in robot.parameters else 'lock'} {name}=VALUE"


def _list(robot: Robot, inputs: Sequence[str]) -> str:
    return ", ".join([*robot.parameters, *inputs]) or "none"
