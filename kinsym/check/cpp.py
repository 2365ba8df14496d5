"""Generated C++ made ready to run: the header under the names of the C, the ikfast solver behind plain functions."""

from __future__ import annotations

import ctypes
import os
import shlex
import shutil
from pathlib import Path

import numpy as np

from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import FLAGS, compile_shared
from kinsym.check.laws import CLOSURE, FORWARD, Judge
from kinsym.check.ledger import Ledger
from kinsym.check.solvers import Floats
from kinsym.check.task import closure
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.cpp import shim
from kinsym.emit.source.ikfast import TYPES, companions

#: What generated C++ must compile with: the oldest standard it is promised for, every warning an error.
CPP_FLAGS = ("-std=c++11", *FLAGS[1:])
IKFAST = "ikfast"

FORWARD_LAW = "ComputeFk equals the exact forward kinematics"
TOLD_LAW = "says which joints it has, which are free, and its type"
INVERSE_LAW = "every solution of ComputeIk leads back to its pose"
FOUND_LAW = "ComputeIk finds the known joint vector"
REFUSE_LAW = "ComputeIk refuses what is no pose"


def find_cpp_compiler() -> str | None:
    """The path of a C++ compiler: ``$CXX`` if it names a program, else c++, g++ or clang++; None if there is none."""
    try:
        named = shlex.split(os.environ.get("CXX", ""))
    except ValueError:  # a quotation mark without its partner
        named = []
    return next((path for word in [*named[:1], "c++", "g++", "clang++"] if (path := shutil.which(word))), None)


class CppSolver(CSolver):
    """A generated header of C++; the library has its functions under the names of the C."""

    name = "C++"


def build_header(schedule: Schedule, folder: Path, compiler: str) -> ctypes.CDLL:
    """Compile ``NAME.hpp`` of a folder.

    Raises CheckFailed if that fails.
    """
    (folder / f"{schedule.name}_shim.cpp").write_text(shim(schedule), encoding="utf-8", newline="\n")
    return _built(f"{schedule.name}_shim", folder, compiler)


def build_ikfast(schedule: Schedule, folder: Path, compiler: str) -> ctypes.CDLL:
    """Compile ``NAME_ikfast.cpp`` of a folder inside a namespace, as MoveIt's plugin does.

    Raises CheckFailed if that fails.
    """
    for name, text in companions(schedule).items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    return _built("shim", folder, compiler)


def _built(name: str, folder: Path, compiler: str) -> ctypes.CDLL:
    library = compile_shared(folder, name, folder, compiler=compiler, flags=CPP_FLAGS, suffix=".cpp")
    return ctypes.CDLL(str(library))


class IkfastSolver:
    """A compiled ikfast solver, called through plain functions."""

    def __init__(self, library: ctypes.CDLL, schedule: Schedule) -> None:
        self.schedule = schedule
        self._library = library
        self._joints = [joint.name for joint in schedule.joints]
        pointer = ctypes.c_void_p
        library.forward.argtypes = [pointer, pointer]
        library.forward.restype = None
        library.inverse.argtypes = [pointer, pointer, pointer, ctypes.c_int]
        library.inverse.restype = ctypes.c_int

    def told(self) -> list[int]:
        """How many joints, how many free ones, the first of these or -1, the type, the bytes of a number."""
        out = (ctypes.c_int * 5)()
        self._library.told(out)
        return list(out)

    def forward(self, q: Floats) -> Floats:
        """(m, n) joint vectors to (m, 4, 4) poses, the identity where the task tells nothing."""
        q = np.ascontiguousarray(q)
        poses = np.empty((len(q), 4, 4))
        for joints, pose in zip(q, poses, strict=True):
            self._library.forward(joints.ctypes.data, pose.ctypes.data)
        return poses

    def inverse(self, poses: Floats, reference: Floats) -> tuple[Floats, list[int]]:
        """(m, 4, 4) poses and (m, n) vectors with the free joints to (m, S, n) solutions and their numbers."""
        columns = [self._joints.index(name) for name in self.schedule.inputs]
        found = np.full((len(poses), self.schedule.maximum, len(self._joints)), np.nan)
        counts = []
        for pose, joints, q in zip(np.ascontiguousarray(poses), reference, found, strict=True):
            free = np.ascontiguousarray(joints[columns])
            counts.append(self._library.inverse(pose.ctypes.data, free.ctypes.data, q.ctypes.data, len(q)))
        return found, counts


def hold_ikfast(ledger: Ledger, solver: IkfastSolver, judge: Judge, *, poses: Floats, q: Floats) -> None:
    """An ikfast solver at random poses (m, 4, 4) of known joint vectors (m, n)."""
    schedule, names = solver.schedule, [joint.name for joint in solver.schedule.joints]
    places = [names.index(name) for name in schedule.inputs]
    wanted = [len(names), len(places), *(places[:1] or [-1]), int(TYPES[schedule.task][1], 16), 8]
    ledger.count(TOLD_LAW, IKFAST, 1, int(solver.told() != wanted))
    size = judge.kinematics.size
    errors = closure(solver.forward(q), poses, schedule.task, size)
    ledger.judge(FORWARD_LAW, IKFAST, errors, FORWARD)
    found, counts = solver.inverse(poses, q)
    closures = judge.closures(found, poses)
    there = np.arange(found.shape[1]) < np.array(counts)[:, None]
    worst = np.where(there, np.where(np.isnan(closures), np.inf, closures), 0.0).max(axis=1, initial=0.0)
    ledger.judge(INVERSE_LAW, IKFAST, worst, CLOSURE)
    missed = ~judge.found(found, q, poses)
    ledger.count(FOUND_LAW, IKFAST, len(q), int(missed.sum()))
    broken = poses[:1].copy()
    broken[0, :, 3] = np.nan
    broken[0, :3, :3] *= 1.01
    ledger.count(REFUSE_LAW, IKFAST, 1, int(solver.inverse(broken, q[:1])[1] != [0]))
