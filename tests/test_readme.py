"""The examples of the README work as they stand there."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from kinsym.cli import main

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    """The first code block of a language."""
    match = re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)
    assert match is not None
    return match.group(1)


def test_the_robot_file_and_the_python_session(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The table is derived, and the module it gives runs the lines shown."""
    monkeypatch.chdir(tmp_path)
    Path("two_links.toml").write_text(block("toml"), encoding="utf-8")
    assert main(["derive", "two_links.toml", "-o", ".", "--quiet"]) == 0
    shapes = "print(T.shape, q.shape, valid.shape, J.shape)"
    code = block("python").replace("q, valid", "print(q.shape); q, valid", 1) + shapes
    done = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout.splitlines() == ["(2, 2)", "(4, 4) (1, 2, 2) (1, 2) (2, 6, 2)"]


def test_the_session_in_python(tmp_path: Path) -> None:
    """The lines run as they stand, give the shapes that they say, and write the files; so do the two calls below."""
    found = re.search(r"## From Python.*?```python\n(.*?)```", README, re.DOTALL)
    assert found is not None
    calls = re.findall(r"`(solution\.[^`]*l1=0\.4\)|solution\.[^`]*\"l1\": 0\.4}\))`", README)
    assert len(calls) == 2
    one_link = "ks.from_inline('0 l1 0 theta1', convention='paul')"
    more = [f"solution, q = ks.derive({one_link}), [0.1]", *calls, "print(T.shape, arm.ik(T).shape)"]
    command = [sys.executable, "-W", "error", "-c", "\n".join([found[1], *more])]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path, env=environment)
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert lines[0].startswith("  2. theta3: two-link triangle")
    assert lines[-1] == "(4, 4) (8, 6)"
    assert (tmp_path / "out" / "puma560.py").exists()


def test_the_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Every command of the list is understood; those that need a file of the user's say that it is missing."""
    monkeypatch.chdir(tmp_path)
    commands = re.search(r"## Use\n\n```console\n(.*?)```", README, re.DOTALL)
    assert commands is not None
    for line in commands.group(1).splitlines():
        words = [word.strip('"') for word in re.findall(r'"[^"]*"|\S+', line.split("#")[0])]
        assert words[0] == "kinsym"
        checks = ["--no-check"] if words[1] == "derive" else []
        missing = {"my_robot.toml", "table.csv", "robot.urdf", "check"} & set(words)
        assert main([*words[1:], *checks]) == (2 if missing else 0), capsys.readouterr().err


def test_the_lines_shown_are_those_printed(capsys: pytest.CaptureFixture[str]) -> None:
    """The derivation in the first block is what kinsym prints."""
    assert main(["show", "fanuc_s900w"]) == 0
    printed = capsys.readouterr().out
    shown = block("console").split("...\n")[1]
    assert shown in printed
    assert main(["show", "puma560"]) == 0
    assert block("text") in capsys.readouterr().out
