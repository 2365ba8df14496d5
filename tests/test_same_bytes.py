"""The same table gives the same bytes, whatever the order of hashes and whichever library does the arithmetic."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from kinsym.robot import to_toml
from tests.arms import robot

ROOT = Path(__file__).resolve().parent.parent
ROBOTS = ("puma560", "scara", "elbow_6r_screw")
SHAPE_NAMES = ("sliding_rrp", "slides_between")


def derived(table: str, folder: Path, **environment: str) -> dict[str, bytes]:
    """What a fresh interpreter writes for a robot."""
    subprocess.run(
        [sys.executable, "-m", "kinsym", "derive", table, "-o", str(folder), "--no-check", "--quiet"],
        check=True,
        cwd=ROOT,
        env={**os.environ, **environment},
    )
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


@pytest.mark.parametrize("name", ROBOTS)
def test_hashes_and_arithmetic_leave_no_trace(name: str, tmp_path: Path) -> None:
    """SymPy takes its rationals from python-flint where it is installed; SYMPY_GROUND_TYPES forbids or demands it."""
    plain = derived(name, tmp_path / "plain", PYTHONHASHSEED="0", SYMPY_GROUND_TYPES="python")
    assert len(plain) == 5
    flint = derived(name, tmp_path / "flint", PYTHONHASHSEED="1", SYMPY_GROUND_TYPES="flint")
    assert flint == plain


@pytest.mark.parametrize("name", SHAPE_NAMES)
def test_the_same_of_arms_that_slide(name: str, tmp_path: Path) -> None:
    """They go through the last stage of the search."""
    file = tmp_path / f"{name}.toml"
    file.write_text(to_toml(robot(name)))
    plain = derived(str(file), tmp_path / "plain", PYTHONHASHSEED="0", SYMPY_GROUND_TYPES="python")
    flint = derived(str(file), tmp_path / "flint", PYTHONHASHSEED="1", SYMPY_GROUND_TYPES="flint")
    assert flint == plain


def test_python_flint_is_really_used() -> None:
    """The comparison above means nothing without it."""
    code = "from sympy import QQ; print(type(QQ(1, 2)).__module__)"
    result = subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "SYMPY_GROUND_TYPES": "flint"},
    )
    assert result.stdout.startswith("flint")
