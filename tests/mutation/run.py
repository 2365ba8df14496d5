"""Mutants one after the other in a copy of the tree, each in a process of its own that has the libraries loaded."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import resource
import shutil
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import pytest

from tests.mutation.killers import calls as calls_of
from tests.mutation.mutants import ROOT, Mutant

#: What the tests read. Nothing is ever written anywhere but in the copy.
TREE = ("kinsym", "templates", "tests", "generated", "docs", "pyproject.toml")
KILLED, SURVIVED = "killed", "SURVIVED"
ENDLESS, CRASHED, NO_IMPORT = "never ends", "crashes", "cannot be imported"

#: A test of a mutant may take this many times the longest of its call without it, these seconds more and these bytes.
PATIENCE, SECONDS, BYTES = 3, 5, 8 * 2**30
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

    def __init__(self, folder: Path, root: Path = ROOT, calls: Callable[[str], tuple[str, ...]] = calls_of) -> None:
        self._folder, self._calls = folder, calls
        for name in TREE:
            source = root / name
            if source.is_dir():
                shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy2(source, folder / name)
        self._longest: dict[str, float] = {}
        for name in ("flint", "hypothesis", "jinja2", "mpmath", "numpy", "sympy"):
            __import__(name)

    def try_out(self, mutant: Mutant) -> Outcome:
        """Run the tests of a module with a mutant in its place, call by call, until one fails."""
        total = 0.0
        for call in self._calls(mutant.module):
            limit, before = SECONDS + PATIENCE * self._without(call), _children()
            with self._placed(mutant):
                reason, _ = self._in_child(call, limit)
            total += _children() - before
            if reason is not None:
                return Outcome(mutant=mutant, outcome=KILLED, reason=reason, seconds=total)
        return Outcome(mutant=mutant, outcome=SURVIVED, reason="", seconds=total)

    def _without(self, call: str) -> float:
        """Seconds of the longest test without a change, which also compiles the copy; raises Unsound if one fails."""
        if call not in self._longest:
            reason, self._longest[call] = self._in_child(call, None)
            if reason is not None:
                raise Unsound(f"{call}: {reason}")
        return self._longest[call]

    @contextmanager
    def _placed(self, mutant: Mutant) -> Iterator[None]:
        """The copy with the mutant in it."""
        path = self._folder / mutant.module
        good, status = path.read_bytes(), path.stat()
        try:
            path.write_text(mutant.text, encoding="utf-8")
            # compiled code is taken for that of a source of the same size and second
            os.utime(path, (status.st_atime, status.st_mtime + 60))
            yield
        finally:
            path.write_bytes(good)
            os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))

    def _in_child(self, call: str, limit: float | None) -> tuple[str | None, float]:
        """The first test that fails, or how the process ended; None if all pass. And the seconds of the longest."""
        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe(duplex=False)
        child = context.Process(target=self._child, args=(call, limit, theirs))
        child.start()
        theirs.close()
        told: list[tuple[str | None, float]] = []
        with suppress(EOFError):
            told.append(ours.recv())
        child.join()
        end = ENDLESS if child.exitcode in (-signal.SIGXCPU, -signal.SIGKILL) else CRASHED
        return told[0] if told else (end, 0.0)

    def _child(self, call: str, limit: float | None, pipe: Any) -> None:
        """Run tests of the copy with the modules of the copy."""
        faulthandler.disable()
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        sys.dont_write_bytecode = limit is not None
        os.chdir(self._folder)
        sys.path[:] = [str(self._folder), *(place for place in sys.path if not _ours(place))]
        for name in [name for name in sys.modules if name.partition(".")[0] in ("kinsym", "tests")]:
            del sys.modules[name]
        watch = _Watch(limit)
        status = pytest.main([*_OPTIONS, *call.split()], plugins=[watch])
        passed = status in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED)
        pipe.send((None if passed else watch.failed or CRASHED, watch.longest))
        pipe.close()


class _Watch:
    """A plugin that remembers the first test that failed and the longest, and gives each as many seconds."""

    def __init__(self, limit: float | None) -> None:
        self.failed, self.longest, self._limit = "", 0.0, limit
        self.pytest_runtest_logstart()

    def pytest_runtest_logstart(self) -> None:
        self._start = time.process_time()
        if self._limit is not None:
            resource.setrlimit(resource.RLIMIT_CPU, (ceil(self._start + self._limit), resource.RLIM_INFINITY))

    def pytest_runtest_logfinish(self) -> None:
        self.longest = max(self.longest, time.process_time() - self._start)

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
