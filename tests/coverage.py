"""How much of kinsym the tests run: ``python -m tests.coverage [ARGUMENTS OF PYTEST]``, default the whole suite.

Subprocesses and the workers of pytest-xdist are measured as well (``[tool.coverage]`` of ``pyproject.toml``). It ends
with status 1 if fewer lines or branches are run than :data:`LINES` and :data:`BRANCHES` ask for, or a test fails.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

LINES, BRANCHES = 95.0, 90.0


def share(found: dict[str, Any], what: str) -> float:
    """Per cent of the ``lines`` or ``branches`` of a summary that are run."""
    covered, total = ("covered_lines", "num_statements") if what == "lines" else ("covered_branches", "num_branches")
    return 100.0 * found[covered] / found[total] if found[total] else 100.0


def table(report: dict[str, Any]) -> list[str]:
    """The files below either bound, the worst first, then all of them together."""
    rows = [
        (share(found["summary"], "lines"), share(found["summary"], "branches"), name, found["missing_lines"])
        for name, found in report["files"].items()
    ]
    said = [
        f"{lines:6.1f} % lines {branches:6.1f} % branches  {name}  {' '.join(map(str, missing))}"
        for lines, branches, name, missing in sorted(rows)
        if lines < LINES or branches < BRANCHES
    ]
    totals = report["totals"]
    return [*said, f"{share(totals, 'lines'):6.1f} % lines {share(totals, 'branches'):6.1f} % branches  in all"]


def main(arguments: list[str]) -> int:
    """Run pytest under coverage and print what it leaves out."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "coverage.json"
        command = [sys.executable, "-m", "pytest", "-q", "--cov", f"--cov-report=json:{place}", *arguments]
        tests = subprocess.run(command, check=False).returncode
        if not place.is_file():
            return tests or 1
        report = json.loads(place.read_text(encoding="utf-8"))
    print("\n".join(table(report)))
    short = share(report["totals"], "lines") < LINES or share(report["totals"], "branches") < BRANCHES
    return tests or int(short)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
