"""kinsym in a terminal of the operating system: colour, a live line, Ctrl-C, completion by a key."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from kinsym.command.completion import script

ROOT = Path(__file__).resolve().parents[2]


class Pty:
    """A program in a terminal of 80 columns; ``text`` is what it has written so far."""

    def __init__(self, words: Sequence[str], folder: Path, **environment: str) -> None:
        self._own, other = pty.openpty()
        names = {"TERM": "xterm", "COLUMNS": "80", "PYTHONPATH": str(ROOT), "PATH": os.environ["PATH"], **environment}
        self.process = subprocess.Popen(
            words, stdin=other, stdout=other, stderr=other, cwd=folder, env=names, start_new_session=True
        )
        os.close(other)
        self.text = ""

    def read(self, until: str = "", seconds: float = 60) -> str:
        """Read until a text has come, or to the end."""
        deadline = time.monotonic() + seconds
        while not (until and until in self.text) and time.monotonic() < deadline:
            if not select.select([self._own], [], [], 0.1)[0]:
                continue
            try:
                chunk = os.read(self._own, 65536)
            except OSError:
                break
            if not chunk:
                break
            self.text += chunk.decode()
        assert until in self.text
        return self.text

    def type(self, keys: str) -> None:
        """Press keys."""
        os.write(self._own, keys.encode())

    def end(self) -> int:
        """The exit status."""
        os.close(self._own)
        return self.process.wait(timeout=30)


def kinsym(*words: str) -> list[str]:
    """The command line."""
    return [sys.executable, "-m", "kinsym", *words]


def shown(raw: str) -> str:
    """What stays on the screen of a raw text: no erased line, no colour."""
    lines = [line.rpartition("\x1b[K")[2] for line in raw.replace("\r\n", "\n").split("\n")]
    return re.sub(r"\x1b\[[0-9;]*m", "", "\n".join(lines))


def test_derive_on_a_terminal(tmp_path: Path) -> None:
    """The stages are drawn and gone, headings are bold, every line fits."""
    terminal = Pty(kinsym("derive", "planar_rr", "--no-check"), tmp_path)
    raw = terminal.read()
    assert terminal.end() == 0
    assert "deriving planar_rr ..." in raw
    assert "\x1b[1mInverse kinematics\x1b[0m" in raw
    left = shown(raw)
    assert "deriving" not in left
    assert "\x1b" not in left
    assert max(map(len, left.splitlines())) <= 80
    assert re.search(r"\ntook \d+\.\d s\n\Z", left)


def test_interrupted(tmp_path: Path) -> None:
    """Ctrl-C in the middle of a stage: status 130, one word, the line gone, nothing written."""
    terminal = Pty(kinsym("derive", "fanuc_crx10ial"), tmp_path)
    terminal.read(until="deriving")
    os.killpg(terminal.process.pid, signal.SIGINT)
    left = shown(terminal.read())
    assert terminal.end() == 130
    assert left.endswith("\nkinsym: interrupted\n")
    assert "deriving" not in left
    assert "Traceback" not in left
    assert os.listdir(tmp_path) == []


def test_no_colour(tmp_path: Path) -> None:
    """NO_COLOR leaves the letters alone; without a terminal nothing has to be said."""
    terminal = Pty(kinsym("derive", "planar_rrr_pual"), tmp_path, NO_COLOR="1")
    assert "Did you mean planar_rrr_paul?" in shown(terminal.read()).replace("\n", " ")
    assert "m" not in re.findall(r"\x1b\[[0-9;]*(.)", terminal.text)
    assert terminal.end() == 2


def test_a_key_completes_in_bash(tmp_path: Path) -> None:
    """Tab after ``--targ``, as a user presses it."""
    (tmp_path / "rc").write_text(f"PS1='$ '\n{script('bash')}\n", encoding="utf-8")
    shell = Pty(["bash", "--noprofile", "--rcfile", "rc", "-i"], tmp_path)
    shell.read(until="$ ")
    shell.type("kinsym derive puma5\t--targ\tn\t")
    shell.read(until="kinsym derive puma560 --target numpy")
    shell.type("\x15exit\n")
    shell.read()
    assert shell.end() == 0
