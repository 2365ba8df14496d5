"""What ``kinsym check`` does, made ready once for a robot, so that a mutant costs only the laws it is held to.

The samples, the exact walk's answers and those of the language that is not mutated are the same for every mutant of one
language. A mutant of the plan changes them all, and everything is done anew.
"""

from __future__ import annotations

import ctypes
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import ModuleType

from kinsym.check.c_solver import CSolver
from kinsym.check.compare import CHOICES, counts_of
from kinsym.check.compiler import compile_shared
from kinsym.check.examination import Examination
from kinsym.check.ledger import Ledger
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.poses import draws, lengths_of
from kinsym.check.solvers import Solutions, Solver
from kinsym.check.sources import hold_module
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule
from kinsym.errors import CheckFailed
from kinsym.robot.model import Robot

#: Warnings are no matter here, and little optimisation is compiled fast.
FLAGS = ("-std=c99", "-O1", "-w")
GLANCE = 9


class Caught(BaseException):
    """A law has failed; it goes past what catches the errors of generated code."""


class Stillborn(Exception):
    """A mutant that is no program."""


class _Impatient(Ledger):
    """A ledger that stops at the first failure."""

    def count(self, law: str, subject: str, tried: int, failed: int, *, limit: str = "", note: str = "") -> None:
        if failed:
            raise Caught(f"{subject}: {law}".removeprefix(": "))
        super().count(law, subject, tried, failed, limit=limit, note=note)


@dataclass(frozen=True, kw_only=True)
class _Choice:
    """One choice of parameters: its examination, the exact answers, each language's solver and answers."""

    parameters: Mapping[str, Fraction]
    examination: Examination
    oracle: Solutions
    solvers: dict[str, Solver]
    answers: dict[str, Solutions]


class Bench:
    """A robot with everything that its mutants are held against."""

    def __init__(self, robot: Robot, schedule: Schedule) -> None:
        self.robot, self.schedule = robot, schedule
        self.module, self.library = module_of(schedule, numpy_text(schedule)), library_of(schedule, c_text(schedule))
        self._choices = [self._choice(number, parameters) for number, parameters in enumerate(choices(robot, schedule))]

    def _choice(self, number: int, parameters: Mapping[str, Fraction]) -> _Choice:
        """The laws on good code, which must hold."""
        solvers: list[Solver] = [
            NumpySolver(self.module, self.schedule, parameters),
            CSolver(self.library, self.schedule, parameters),
        ]
        examination = _examination(self.robot, self.schedule, parameters, number, solvers)
        oracle = examination.hold_exact()
        answers: dict[str, Solutions] = {}
        for solver in solvers:
            answer = examination.hold(solver)
            if answer is not None:
                answers[solver.name] = answer
        examination.hold_agreement(oracle, answers)
        return _Choice(
            parameters=parameters,
            examination=examination,
            oracle=oracle,
            solvers={solver.name: solver for solver in solvers},
            answers=answers,
        )

    def hold_numpy(self, text: str) -> ModuleType:
        """Hold a module to every law; raises Caught where one fails."""
        module = module_of(self.schedule, text)
        hold_module(module, self.schedule, NumpySolver.name, _Impatient())
        self._hold(lambda parameters: NumpySolver(module, self.schedule, parameters))
        return module

    def hold_c(self, text: str) -> ctypes.CDLL:
        """Hold a C source to every law; raises Caught where one fails."""
        library = library_of(self.schedule, text)
        self._hold(lambda parameters: CSolver(library, self.schedule, parameters))
        return library

    def _hold(self, solver_of: Callable[[Mapping[str, Fraction]], Solver]) -> None:
        for choice in self._choices:
            examination, solver = choice.examination, solver_of(choice.parameters)
            examination.ledger = _Impatient()
            solvers = {**choice.solvers, solver.name: solver}
            examination.targets = list(solvers.values())
            answer = examination.hold(solver)
            if answer is not None:
                examination.hold_agreement(choice.oracle, {**choice.answers, solver.name: answer})


def hold_plan(robot: Robot, schedule: Schedule) -> tuple[ModuleType, ctypes.CDLL]:
    """Hold a schedule and what is generated from it to every law; raises Caught where one fails."""
    every = list(enumerate(choices(robot, schedule)))
    first = _examination(robot, schedule, every[0][1], 0, [])
    # most mutants fail at the first poses, and the exact walk is slow
    first.some = first.some[::GLANCE]
    first.hold_exact()
    examinations = [_examination(robot, schedule, parameters, number, []) for number, parameters in every]
    oracles = [examination.hold_exact() for examination in examinations]
    module, library = module_of(schedule, numpy_text(schedule)), library_of(schedule, c_text(schedule))
    hold_module(module, schedule, NumpySolver.name, _Impatient())
    for examination, oracle, (_, parameters) in zip(examinations, oracles, every, strict=True):
        solvers: list[Solver] = [NumpySolver(module, schedule, parameters), CSolver(library, schedule, parameters)]
        examination.targets = solvers
        answers = {solver.name: answer for solver in solvers if (answer := examination.hold(solver)) is not None}
        examination.hold_agreement(oracle, answers)
    return module, library


def choices(robot: Robot, schedule: Schedule) -> list[dict[str, Fraction]]:
    """The choices of parameters that the checks try; of an arm without a closed form, which is slow, the first."""
    every = draws(schedule.parameters, lengths_of(robot), schedule.digest, CHOICES)
    return every[:1] if schedule.general else every


def numpy_text(schedule: Schedule) -> str:
    """The module of a schedule."""
    return TARGETS["numpy"](schedule)[f"{schedule.name}.py"]


def c_text(schedule: Schedule) -> str:
    """The C source of a schedule, without its header."""
    return TARGETS["c"](schedule)[f"{schedule.name}.c"]


def module_of(schedule: Schedule, text: str) -> ModuleType:
    """A module of its text; raises Stillborn where it is none."""
    module = ModuleType(schedule.name)
    try:
        exec(compile(text, f"{schedule.name}.py", "exec"), module.__dict__)
    except Exception as error:
        raise Stillborn(str(error)) from error
    return module


def library_of(schedule: Schedule, text: str) -> ctypes.CDLL:
    """A C source compiled; raises Stillborn where that fails."""
    with tempfile.TemporaryDirectory(prefix="kinsym-") as folder:
        header = TARGETS["c"](schedule)[f"{schedule.name}.h"]
        (Path(folder) / f"{schedule.name}.h").write_text(header, encoding="utf-8")
        (Path(folder) / f"{schedule.name}.c").write_text(text, encoding="utf-8")
        try:
            return ctypes.CDLL(str(compile_shared(folder, schedule.name, folder, flags=FLAGS)))
        except CheckFailed as error:
            raise Stillborn(str(error)) from error


def _examination(
    robot: Robot, schedule: Schedule, parameters: Mapping[str, Fraction], number: int, targets: list[Solver]
) -> Examination:
    return Examination(
        robot=robot,
        schedule=schedule,
        parameters=parameters,
        number=number,
        counts=counts_of(schedule),
        targets=targets,
        ledger=_Impatient(),
    )
