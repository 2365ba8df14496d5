"""``python -m tests.versions``: the gallery's files under the oldest and the newest libraries and every Python here.

Makes an environment for each (``--folder`` keeps them for the next time), derives a sample of the gallery there and
compares every byte with ``generated/``, runs the checks of one robot and reads a URDF file. ``--lowest`` is the oldest
Python with the lower bounds alone, ``--all`` the whole gallery. Exit status 1 if anything differs.
"""

from __future__ import annotations

import argparse
import difflib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from kinsym.check.report import SUFFIX
from kinsym.command.importing import robot_file
from kinsym.robot import gallery, load
from tests.regenerate import GENERATED, comparable
from tests.urdf.trees import J, urdf
from tests.versions.environments import LOWEST, ROOT, environments

#: A closed form of every kind, an arm with a lock, and two without a closed form, whose cuts are chosen with NumPy.
SAMPLE = (
    *("planar_rr", "scara", "stanford_screw", "puma560", "fanuc_s900w", "elbow_6r_screw", "kuka_iiwa", "raven_2"),
    *("fanuc_crx10ial", "kinova_jaco"),
)
CHECKED = "planar_rr"


def differences(interpreter: Path, names: tuple[str, ...], folder: Path) -> Iterator[str]:
    """What comes out otherwise in an environment, as unified differences."""
    for i, name in enumerate(names):
        kind = ("python", "flint")[i % 2]
        out = folder / name
        run(interpreter, folder, "derive", name, "--no-check", "-o", str(out), SYMPY_GROUND_TYPES=kind)
        yield from compared(GENERATED / name, out, without=SUFFIX)
    run(interpreter, folder, "derive", CHECKED, "-o", str(folder / "checked"))
    yield from compared(GENERATED / CHECKED, folder / "checked")
    path = folder / "arm.urdf"
    path.write_text(urdf(J("j1", "revolute", "a", "b"), J("j2", "revolute", "b", "c", "0.4 0 1e-9", "1.5708 0 0")))
    run(interpreter, folder, "import", str(path), "-o", str(folder / "arm.toml"))
    yield from _difference("arm.toml", robot_file(load(str(path))), (folder / "arm.toml").read_text(encoding="utf-8"))


def run(interpreter: Path, folder: Path, *arguments: str, **environment: str) -> None:
    """kinsym in an environment, warnings being errors."""
    command = [interpreter, "-W", "error", "-m", "kinsym", *arguments, "--quiet"]
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, "PYTHONPATH": str(ROOT), **environment})


def compared(expected: Path, found: Path, without: str = "/") -> Iterator[str]:
    """The differences of two folders, all files or those whose names do not end in ``without``."""
    names = {path.name for folder in (expected, found) for path in folder.iterdir() if not path.name.endswith(without)}
    for name in sorted(names):
        texts = [
            (place / name).read_text(encoding="utf-8") if (place / name).exists() else "" for place in (expected, found)
        ]
        yield from _difference(name, comparable(name, texts[0]), comparable(name, texts[1]))


def _difference(name: str, expected: str, found: str) -> Iterator[str]:
    if expected != found:
        yield "\n".join(difflib.unified_diff(expected.splitlines(), found.splitlines(), f"{name} expected", name, n=1))


def versions(interpreter: Path) -> str:
    """The installed libraries in one line."""
    code = (
        "import sys, importlib.metadata as m; print(*(f'{name} {m.version(name)}' for name in sys.argv[1:]), sep=', ')"
    )
    names = ("sympy", "mpmath", "numpy", "jinja2", "lxml", "python-flint")
    return subprocess.run([interpreter, "-c", code, *names], capture_output=True, text=True, check=True).stdout.strip()


def main() -> int:
    """Go through the environments; a line for each."""
    parser = argparse.ArgumentParser(prog="python -m tests.versions", description=__doc__)
    parser.add_argument("--folder", type=Path, help="where environments are kept (default: nowhere)")
    parser.add_argument("--lowest", action="store_true", help="the oldest Python with the lower bounds alone")
    parser.add_argument("--all", action="store_true", help="the whole gallery instead of a sample")
    options = parser.parse_args()
    status = 0
    with tempfile.TemporaryDirectory(prefix="kinsym-versions-") as temporary:
        place = options.folder.resolve() if options.folder else Path(temporary, "environments")
        for environment in environments():
            if options.lowest and environment.ends != LOWEST:
                continue
            interpreter = environment.make(place)
            folder = Path(tempfile.mkdtemp(dir=temporary))
            found = list(differences(interpreter, gallery() if options.all else SAMPLE, folder))
            print(
                f"{environment.label} ({versions(interpreter)}): {'DIFFERS' if found else 'the same bytes'}", flush=True
            )
            print("\n".join(found), end="\n" if found else "")
            status = max(status, bool(found))
    return status


if __name__ == "__main__":
    sys.exit(main())
