"""LaTeX through pdflatex: what its log complains of."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

needs_pdflatex = pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")

COMMAND = ("pdflatex", "-draftmode", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape")
#: A line that sticks out by more points than this is seen.
WORST = 10.0


def compile_twice(text: str, folder: Path) -> str:
    """The log of the second run, in one line; fails where a reference stays open or a line sticks out."""
    (folder / "page.tex").write_text(text, encoding="ascii")
    for _ in range(2):
        run = subprocess.run([*COMMAND, "page.tex"], cwd=folder, capture_output=True, check=False, timeout=120)
        log = (folder / "page.log").read_text(encoding="latin-1").replace("\n", "")
        assert run.returncode == 0, log[-2000:]
    assert "undefined" not in log
    assert "multiply defined" not in log
    overfull = [float(points) for points in re.findall(r"Overfull \\[hv]box \(([\d.]+)pt too", log)]
    assert max(overfull, default=0.0) <= WORST
    return log
