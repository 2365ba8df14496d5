"""Compilers do compute several poses at once in the loops of the batch."""

from __future__ import annotations

import platform
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from tests.arms import derivation
from tests.emit.schedules import puma

#: The flags of the header for any x86-64 processor since 2013, and the compilers' words for a loop that they took.
FLAGS = ("-std=c99", "-O3", "-mavx2", "-mfma")
REPORTS = {
    "gcc": ("-fopt-info-vec-optimized", r":(\d+):\d+: optimized: +loop vectorized using 32 byte vectors"),
    "clang": ("-Rpass=loop-vectorize", r":(\d+):\d+: remark: vectorized loop \(vectorization width: [48]"),
}
LANES = "for (int k = 0; k < LANES; ++k) {"
#: How many loops copy before one computes, by the name of the function.
COPIES = {"fk_block": 1, "read_block": 1, "fk_batch": 1, "ik_batch": 1}


def loops_over_lanes(source: str) -> list[int]:
    """The lines of the loops over lanes that compute, in the order of the source."""
    lines, copies = [], 0
    for number, line in enumerate(source.splitlines(), start=1):
        if line and line[0] not in " {}/*#":
            copies = next((count for name, count in COPIES.items() if name in line), 0)
        if line.strip() == LANES:
            if copies == 0:
                lines.append(number)
            copies = max(0, copies - 1)
    return lines


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="the flags are those of x86-64")
@pytest.mark.parametrize("compiler", REPORTS)
@pytest.mark.parametrize(
    "make",
    [puma, *(lambda name=name: build_schedule(derivation(name)) for name in ("ur5", "scorbot_5r", "skew_wrist"))],
    ids=["puma", "ur5", "scorbot_5r", "skew_wrist"],
)
def test_every_loop_over_lanes_is_vectorised(make: Callable[[], Schedule], compiler: str, tmp_path: Path) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    schedule = make()
    for name, text in TARGETS["c"](schedule).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    flag, words = REPORTS[compiler]
    command = [compiler, *FLAGS, flag, "-c", f"{schedule.name}.c", "-o", "batch.o"]
    said = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True).stderr
    taken = {int(number) for number in re.findall(words, said)}
    loops = loops_over_lanes((tmp_path / f"{schedule.name}.c").read_text(encoding="utf-8"))
    # forward kinematics, the pose, a loop for each step that branches, and what keeps solutions that reach the pose
    assert len(loops) == 2 + schedule.depth + schedule.gate
    assert set(loops) <= taken
