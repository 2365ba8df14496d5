"""``python -m tests.fuzz [--minutes 10] [READER ...]``: coverage-guided fuzzing of everything that reads a robot.

atheris (``pip install atheris``) runs libFuzzer over kinsym's readers, whose code it instruments; each reader gets a
process and an equal share of the time. A reader ends at the first input that makes it raise anything but RobotError,
take longer than ten seconds or more than 2 GiB; the input is printed. What is found becomes a line of ``FOUND`` in
``tests/fuzz/test_fuzz.py``. Exit status: 0 nothing found, 1 something found.
"""

from __future__ import annotations

import argparse
import importlib.util
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.fuzz.targets import TARGETS, seeds, words

ROOT = Path(__file__).resolve().parents[2]
LAST_LINES = 30


def fuzz(reader: str, seconds: int) -> bool:
    """Fuzz one reader in a process of its own; whether nothing was found. Prints a line, and what was found."""
    with tempfile.TemporaryDirectory(prefix="kinsym-fuzz-") as place:
        folder = Path(place)
        (folder / "corpus").mkdir()
        for i, seed in enumerate(seeds(reader)):
            (folder / "corpus" / f"seed{i}").write_bytes(seed)
        (folder / "words").write_text("".join(f'"{_escaped(word)}"\n' for word in words()))
        finished = subprocess.run(
            [sys.executable, "-m", "tests.fuzz.guided", reader, str(seconds), place],
            cwd=ROOT,
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
        )
        found = [path for path in sorted(folder.iterdir()) if re.match("crash|timeout|oom|slow", path.name)]
        inputs = {path.name: path.read_bytes() for path in found}
    runs = re.search(r"number_of_executed_units: *(\d+)", finished.stderr)
    reached = re.findall(r"cov: (\d+)", finished.stderr)
    print(
        f"{reader}: {runs[1] if runs else 'no'} inputs, {reached[-1] if reached else 'no'} branches reached", flush=True
    )
    if finished.returncode == 0 and not inputs:
        return True
    print("\n".join((finished.stdout + finished.stderr).splitlines()[-LAST_LINES:]))
    for name, data in inputs.items():
        print(f'{name}: ("{reader}", {data!r})')
    return False


def _escaped(word: str) -> str:
    return word.replace("\\", "\\\\").replace('"', '\\"')


def main() -> int:
    """Fuzz the readers named, or all."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("readers", nargs="*", choices=[*TARGETS, []], metavar="READER", help=", ".join(TARGETS))
    parser.add_argument("--minutes", type=float, default=10.0, help="in all (default: 10)")
    options = parser.parse_args()
    if importlib.util.find_spec("atheris") is None:
        print("atheris is not installed. Run: pip install atheris", file=sys.stderr)
        return 2
    readers = options.readers or list(TARGETS)
    seconds = max(1, round(60 * options.minutes / len(readers)))
    clean = [fuzz(reader, seconds) for reader in readers]
    return 0 if all(clean) else 1


if __name__ == "__main__":
    sys.exit(main())
