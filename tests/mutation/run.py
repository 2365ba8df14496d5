"""Mutants one after the other in a copy of the tree, each in a process of its own that has the libraries loaded."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import resource
import shutil
import signal
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from tests.mutation.killers import stages
from tests.mutation.mutants import ROOT, Mutant

#: What the tests read. Nothing is ever written anywhere but in the copy.
TREE = ("kinsym", "templates", "tests", "generated", "pyproject.toml")
KILLED, SURVIVED = "killed", "SURVIVED"
ENDLESS, CRASHED, NO_IMPORT = "never ends", "crashes", "cannot be imported"

#: A mutant may take this many times what a call of pytest takes without it and as many seconds more, and these bytes.
PATIENCE, SECONDS, BYTES = 2, 5, 8 * 2**30
#: What is loaded before a child is made cannot be rewritten by pytest, which warns of it.
_LOADED = "ignore::pytest.PytestAssertRewriteWarning"
_OPTIONS = ("-q", "-x", "-n", "0", "-p", "no:cacheprovider", "--tb=no", "-W", _LOADED)


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What became of a mutant: the first test that failed, or how it ended; the seconds of processor time."""

    mutant: Mutant
    outcome: str
    reason: str
    seconds: float


class Unsound(Exception):
    """Tests that fail without any change: nothing can be said of mutants."""


class Laboratory:
    """A copy of the tree, in which one module at a time is another."""

    def __init__(self, folder: Path, root: Path = ROOT, calls: Callable[[str], tuple[str, ...]] = stages) -> None:
        self._folder, self._calls = folder, calls
        for name in TREE:
            source = root / name
            if source.is_dir():
                shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy2(source, folder / name)
        self._seconds: dict[str, float] = {}
        for name in ("flint", "hypothesis", "jinja2", "mpmath", "numpy", "sympy"):
            __import__(name)

    def prepare(self, modules: Iterable[str]) -> float:
        """Run every test that will be needed once, unchanged, which also compiles the copy; the seconds it took."""
        for stage in dict.fromkeys(stage for module in modules for stage in self._calls(module)):
            reason, self._seconds[stage] = self._in_child((stage,), compiled=True)
            if reason is not None:
                raise Unsound(f"{stage}: {reason}")
        return sum(self._seconds.values())

    def try_out(self, mutant: Mutant) -> Outcome:
        """Put a mutant in its place, run the tests of its module, and put the module back."""
        path = self._folder / mutant.module
        good, status = path.read_bytes(), path.stat()
        try:
            path.write_text(mutant.text, encoding="utf-8")
            # compiled code is taken for that of a source of the same size and second
            os.utime(path, (status.st_atime, status.st_mtime + 60))
            reason, seconds = self._in_child(self._calls(mutant.module))
        finally:
            path.write_bytes(good)
            os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
        outcome = SURVIVED if reason is None else KILLED
        return Outcome(mutant=mutant, outcome=outcome, reason=reason or "", seconds=seconds)

    def _in_child(self, calls: tuple[str, ...], *, compiled: bool = False) -> tuple[str | None, float]:
        """The first test that fails, or how the process ended; None if all pass. And its processor time."""
        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe(duplex=False)
        child = context.Process(target=self._child, args=(calls, compiled, theirs))
        before = _children()
        child.start()
        theirs.close()
        try:
            reason = ours.recv()
        except EOFError:
            reason = None
            ended = False
        else:
            ended = True
        child.join()
        if not ended:
            reason = ENDLESS if child.exitcode in (-signal.SIGXCPU, -signal.SIGKILL) else CRASHED
        return reason, _children() - before

    def _child(self, calls: tuple[str, ...], compiled: bool, pipe: Any) -> None:
        """Run the tests of the copy with the modules of the copy."""
        faulthandler.disable()
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        sys.dont_write_bytecode = not compiled
        os.chdir(self._folder)
        sys.path[:] = [str(self._folder), *(place for place in sys.path if not _ours(place))]
        for name in [name for name in sys.modules if name.partition(".")[0] in ("kinsym", "tests")]:
            del sys.modules[name]
        pipe.send(self._first_failure(calls, compiled))
        pipe.close()

    def _first_failure(self, calls: tuple[str, ...], compiled: bool) -> str | None:
        for call in calls:
            if not compiled:
                used = resource.getrusage(resource.RUSAGE_SELF)
                limit = used.ru_utime + used.ru_stime + SECONDS + PATIENCE * self._seconds[call]
                resource.setrlimit(resource.RLIMIT_CPU, (round(limit), resource.RLIM_INFINITY))
            watch = _Watch()
            status = pytest.main([*_OPTIONS, call], plugins=[watch])
            if status not in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
                return watch.failed or CRASHED
        return None


class _Watch:
    """A plugin that remembers the first test that failed and the file that could not be collected."""

    failed = ""

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed and not self.failed:
            self.failed = report.nodeid

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed and not self.failed:
            self.failed = NO_IMPORT


def _ours(place: str) -> bool:
    """Whether a place on Python's path is the tree itself."""
    return Path(place or ".").resolve() == ROOT


def _children() -> float:
    """Processor time of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
