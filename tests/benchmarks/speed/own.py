"""kinsym's programs of an arm: the C with its lengths bound and as parameters, the package, the module."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from kinsym.command.rendering import rendered
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from kinsym.write import write_set
from tests.benchmarks.speed.arms import Arm
from tests.benchmarks.speed.native import Program, kinsym_batch, kinsym_line, kinsym_solver

BOUND, FREE = "bound", "parameters"


@dataclass(frozen=True, kw_only=True)
class Own:
    """The folder with the files of an arm, lengths bound or as parameters."""

    schedule: Schedule
    folder: Path
    struct: str

    @property
    def has_batch(self) -> bool:
        """Whether the C solves many poses in one call."""
        return f"{self.schedule.name}_ik_batch(" in (self.folder / f"{self.schedule.name}.h").read_text("utf-8")

    def solver(self) -> Program:
        """All solutions of one pose."""
        return self._program(kinsym_solver(self.schedule.name, self.struct))

    def batch(self) -> Program:
        """All solutions of many poses."""
        return self._program(kinsym_batch(self.schedule.name))

    def line(self, function: str) -> Program:
        """``fk`` or ``jacobian``."""
        return self._program(kinsym_line(self.schedule.name, function))

    def package(self) -> Path:
        """The folder to put on the path for ``import NAME``, filled by pip as a user would."""
        target = self.folder / "site"
        if not target.exists():
            command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps"]
            source = self.folder / f"{self.schedule.name}-solver"
            subprocess.run([*command, "--target", str(target), str(source)], check=True)
        return target

    def _program(self, adapter: str) -> Program:
        return Program(folder=self.folder, sources=(f"{self.schedule.name}.c",), adapter=adapter)


def robot_of(arm: Arm, *, bound: bool) -> Robot:
    """The arm as kinsym reads it."""
    names = ("alpha", "a", "d", "theta")
    draft = {
        "name": arm.name,
        "title": arm.title,
        "convention": "paul",
        "joints": [dict(zip(names, cells, strict=True)) for cells in arm.cells],
        "parameters": {} if bound else {name: Fraction(str(value)) for name, value in arm.lengths.items()},
    }
    values = {name: Fraction(str(value)) for name, value in arm.lengths.items()}
    return from_draft(draft, where=arm.name, bindings=values if bound else {})


def prepare(arm: Arm, folder: Path, *, bound: bool) -> Own:
    """Derive and write."""
    derivation = derive(robot_of(arm, bound=bound))
    schedule = build_schedule(derivation)
    write_set(folder, rendered(derivation, schedule, ("numpy", "c", "extension")))
    struct = ", ".join(repr(arm.lengths[item.name]) for item in schedule.parameters)
    return Own(schedule=schedule, folder=folder, struct=struct)
