"""A robot's kinematics as one object: formulas to read, functions to call, files to write.

It does from Python what ``kinsym derive`` does from the command line, with the same parts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from kinsym.derivation import Derivation
from kinsym.deriving import derive as derivation_of
from kinsym.display import Displayed
from kinsym.emit.live import live_module
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.errors import CheckFailed, KinsymError, RobotError
from kinsym.interface.compiling import compiled_module
from kinsym.interface.formulas import ForwardKinematics, Jacobian, SingularPoses
from kinsym.interface.inverse import InverseKinematics
from kinsym.live import LiveArm, checked_values, with_values
from kinsym.robot.model import Robot, Task
from kinsym.robot.names import nearest, shown

if TYPE_CHECKING:
    from types import ModuleType

    from kinsym.check.report import Report

Values = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class Written:
    """The files that were written, and the report on them; its ``verdict`` is "not run" where nothing was checked."""

    paths: tuple[Path, ...]
    report: Report


@dataclass(frozen=True)
class Solution(Displayed):
    """The kinematics of a robot, of which ``derivation`` holds everything exactly.

    >>> from kinsym.robot import load
    >>> solution = derive(load("fanuc_s900w"))
    >>> solution.ik.maximum, solution.ik["theta1"].rule
    (8, 'homogeneous equation a c + b s = 0')
    """

    derivation: Derivation

    @property
    def robot(self) -> Robot:
        """The robot, with the task that was solved."""
        return self.derivation.robot

    @cached_property
    def fk(self) -> ForwardKinematics:
        """T = A1 A2 ... An: its formulas, and called with joint vectors its numbers."""
        return ForwardKinematics(self.derivation, self._module)

    @cached_property
    def ik(self) -> InverseKinematics:
        """The derivation step by step, and called with a pose all its solutions."""
        return InverseKinematics(self.derivation, self._module)

    @cached_property
    def jacobian(self) -> Jacobian:
        """The geometric Jacobian in the base frame: its formulas, and called with joint vectors its numbers."""
        return Jacobian(self.derivation, self._module)

    @cached_property
    def singular(self) -> SingularPoses:
        """Where the arm is singular, and what that means."""
        return SingularPoses(self.derivation)

    @cached_property
    def schedule(self) -> Schedule:
        """What the generated code computes, in its order."""
        return build_schedule(self.derivation)

    def latex(self) -> str:
        """The whole derivation as a LaTeX document, ready for pdflatex."""
        from kinsym.emit.latex import document

        return document(self.derivation)

    def text(self, *, width: int = 80, full: bool = False) -> str:
        """The whole derivation as the terminal shows it; ``full`` adds link transforms and Jacobian."""
        from kinsym.emit.text import equations

        return equations(self.derivation, width=width, full=full)

    def markdown(self) -> str:
        """The whole derivation as Markdown with LaTeX mathematics, as a notebook shows it."""
        from kinsym.emit.markdown.derivation import whole

        return whole(self.derivation)

    def sources(self, targets: Sequence[str] | None = None, *, real: str = "double") -> dict[str, str]:
        """The generated files by their names: those of ``targets``, by default ``numpy``, ``c`` and ``latex``.

        ``real`` is the type of the numbers in the C. Raises KinsymError for a target or type that does not exist, for
        ``real="float"`` with targets that have none, and for an arm that needs double precision.
        """
        from kinsym.command.rendering import check_real, of_real, rendered

        targets = _known(targets)
        check_real(real, targets)
        return rendered(self.derivation, of_real(real, self.schedule), targets)

    def write(
        self, folder: str | Path, targets: Sequence[str] | None = None, *, check: bool = True, real: str = "double"
    ) -> Written:
        """Check the generated files and write them, with the report, into a folder that is made if need be.

        Raises what :meth:`sources` raises, :class:`CheckFailed` if a law does not hold, and OutputError if the folder
        cannot be used; then nothing is written. With ``check=False`` the files are written as they are.
        """
        from kinsym.check.compare import compare
        from kinsym.check.report import FAILED, SUFFIX
        from kinsym.check.reporting import report_of
        from kinsym.command.rendering import file_names, of_real
        from kinsym.write import check_place, write_set

        place, name = Path(folder), self.robot.name + SUFFIX
        check_place(place, [*file_names(self.robot.name, _known(targets)), name])
        sources, schedule = self.sources(targets, real=real), of_real(real, self.schedule)
        findings = compare(self.robot, schedule, sources) if check else None
        report = report_of(self.robot, schedule, sources, findings)
        if report.verdict == FAILED:
            failed = [law.name for law in report.checks if law.status == FAILED]
            raise CheckFailed(
                f"{self.robot.name}: {len(failed)} of {len(report.checks)} checks failed: {'; '.join(failed)}. "
                "Nothing was written; check=False writes the files to look at."
            )
        return Written(paths=write_set(place, {**sources, name: report.text()}), report=report)

    def numpy(self, values: Values | None = None) -> LiveArm:
        """The NumPy functions with a number for every parameter, without files.

        ``values`` are those of parameters that have none in the table, and of locked joints that are inputs. Raises
        RobotError for one that is missing, is no number or is not the robot's.
        """
        checked_values(self.robot, values)
        return with_values(self.derivation, self._module(), values)

    def compile(self, values: Values | None = None) -> LiveArm:
        """The same functions as compiled C, built now in a private folder that does not stay.

        Raises what :meth:`numpy` raises, and KinsymError where there is no C compiler or no Python.h.
        """
        checked_values(self.robot, values)
        return with_values(self.derivation, compiled_module(self.schedule), values)

    def _module(self) -> ModuleType:
        return self._numpy_module

    @cached_property
    def _numpy_module(self) -> ModuleType:
        return live_module(self.schedule)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.robot.name}>"

    def __str__(self) -> str:
        return self.text()


def derive(robot: Robot, *, task: Task | None = None, deadline: float | None = None) -> Solution:
    """Derive the forward kinematics, the Jacobian and the inverse kinematics of a robot.

    ``task`` is the part of the pose to reach (default: the robot's own, else what the arm can reach), ``deadline`` the
    seconds that it may take. Raises what :func:`kinsym.deriving.derive` raises.

    >>> import kinsym as ks
    >>> solution = ks.derive(ks.load("ur5"))
    >>> pose = solution.fk([0.1, -1.2, 1.3, 0.4, 0.5, 0.6])
    >>> solution.ik(pose).shape
    (8, 6)
    """
    return Solution(derivation_of(_robot(robot), task=task, deadline=deadline))


def compile(robot: Robot, values: Values | None = None) -> LiveArm:
    """A robot's functions at the speed of C: derive it, compile the C of its package and load that.

    ``values`` are those of parameters without a value in the table and of locked joints that are inputs. It takes the
    time of the derivation and of the C compiler and leaves no files. Raises what :func:`derive` raises, RobotError for
    ``values`` that lack a number, and KinsymError where there is no C compiler or no Python.h.
    """
    checked_values(_robot(robot), values)
    return derive(robot).compile(values)


def _robot(given: object) -> Robot:
    if not isinstance(given, Robot):
        raise RobotError(f"{shown(repr(given))} is no robot", remedy='Load it first: derive(load("ur5")).')
    return given


def _known(targets: Sequence[str] | None) -> Sequence[str] | None:
    from kinsym.command.rendering import FILES

    if isinstance(targets, str):
        targets = [targets]
    for target in targets or ():
        if target not in FILES:
            raise KinsymError(
                f"there is no target {shown(str(target))}. {nearest(str(target), FILES)}They are {', '.join(FILES)}."
            )
    return targets
