"""Derivation and emission in a process of its own, as a user starts it; the C that peers generate is kept."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from tests.benchmarks.environment import interpreter
from tests.benchmarks.speed.arms import ARMS

ROOT = Path(__file__).resolve().parents[3]


class Cold(NamedTuple):
    """Processor seconds of one run, in one thread; or why there are none."""

    seconds: float | None
    refused: str = ""


def own(arm: str) -> Cold:
    """``kinsym derive`` without checks: equations, NumPy, C and LaTeX."""
    with tempfile.TemporaryDirectory() as folder:
        table = ["--dh", ARMS[arm].table, "--convention", "paul", "--name", arm]
        lengths = [word for name, value in ARMS[arm].lengths.items() for word in ("--bind", f"{name}={value}")]
        return _run([sys.executable, "-m", "kinsym", "derive", *table, *lengths, "--no-check", "--quiet", "-o", folder])


def peer(name: str, arm: str, environment: Path, folder: Path) -> Cold:
    """A peer that generates C (``roboticstoolbox``, ``casadi``)."""
    return _run([str(interpreter(environment)), "-m", f"tests.benchmarks.speed.peers.{name}", arm, str(folder)])


def _run(command: list[str]) -> Cold:
    before = _children()
    # Compiled modules are kept, as on a user's machine: all libraries have theirs from the second run on.
    usual = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    alone = {**usual, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, env=alone)
    taken = _children() - before
    if finished.returncode:
        return Cold(None, (finished.stderr.strip().splitlines() or ["no word"])[-1])
    return Cold(taken)


def _children() -> float:
    """Processor seconds of all processes that were started here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
