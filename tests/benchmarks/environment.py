"""The environment of the peer libraries: one place beside the working copy, made and filled by one command.

Every library is installed by itself, so that one that fails on a machine is named and costs no other.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

FOLDER = Path(tempfile.gettempdir()) / "kinsym-peers"
PACKAGES = {
    "EAIK": "eaik==1.2.2",
    "ssik": "ssik==8.2.0",
    "Robotics Toolbox": "roboticstoolbox-python[ik]==1.5.0",
    "casadi": "casadi==3.8.2",
    "OPW": "py-opw-kinematics==1.3.0",
    "UR": "ur-analytic-ik==0.1.0.post3",
}
_RECORD = "kinsym-peers.json"


def interpreter(folder: Path) -> Path:
    """The Python of an environment."""
    return folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")


def setup(folder: Path) -> dict[str, str]:
    """Make the environment and install what can be installed; what is missing and why (:func:`missing`)."""
    venv.create(folder, with_pip=True, clear=True)
    failed: dict[str, str] = {}
    for name, package in PACKAGES.items():
        print(f"installing {package} ...", file=sys.stderr, flush=True)
        command = [str(interpreter(folder)), "-m", "pip", "install", "--quiet", package]
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        if finished.returncode:
            errors = [line for line in finished.stderr.splitlines() if line.startswith("ERROR")]
            failed[name] = (errors or finished.stderr.splitlines() or ["pip failed"])[-1].strip()
            print(f"{package} cannot be installed: {failed[name]}", file=sys.stderr)
    (folder / _RECORD).write_text(json.dumps(failed), encoding="utf-8")
    return failed


def missing(folder: Path) -> dict[str, str]:
    """The libraries that cannot be asked, each with the reason; all of them where there is no environment."""
    if not interpreter(folder).exists() or not (folder / _RECORD).exists():
        return dict.fromkeys(PACKAGES, "not set up")
    return dict(json.loads((folder / _RECORD).read_text(encoding="utf-8")))
