"""The completion scripts: every command and option is in them, and bash completes with them."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from kinsym.cli import COMMANDS, main
from kinsym.command.completion import SHELLS, script
from kinsym.command.derive import TARGETS
from kinsym.command.parsing import parser_of
from kinsym.robot import gallery


@pytest.mark.parametrize("shell", SHELLS)
def test_everything_is_there(shell: str) -> None:
    """A command, option or robot that is added comes into the scripts by itself."""
    text = script(shell)
    for name, module in COMMANDS.items():
        assert name in text
        for option in parser_of(name, module).options():
            assert option.lstrip("-") in text
    assert all(robot in text for robot in gallery())


@pytest.mark.parametrize("shell", list(filter(shutil.which, SHELLS)))
def test_the_shell_reads_it(shell: str) -> None:
    """The syntax is that of the shell, as far as this machine has it; bash is always there."""
    subprocess.run([shell, "-n"], input=script(shell), text=True, check=True)


def completed(folder: Path, *words: str) -> list[str]:
    """What bash offers for the last of the words."""
    program = script("bash") + (
        '\nCOMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _kinsym; ((${#COMPREPLY[@]})) && printf "%s\\n" "${COMPREPLY[@]}"'
    )
    done = subprocess.run(
        ["bash", "-c", program, "bash", *words], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    return done.stdout.splitlines()


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("kinsym de", ["derive"]),
        ("kinsym derive puma", ["puma560"]),
        ("kinsym derive my", ["my_arm.toml"]),
        ("kinsym show out", ["out"]),
        ("kinsym derive ur5 --targ", ["--target"]),
        ("kinsym derive ur5 --target n", ["numpy"]),
        ("kinsym derive ur5 --target = e", ["extension"]),
        ("kinsym derive ur5 --target =", list(TARGETS)),
        ("kinsym explain --task pose ur10", ["ur10e"]),
        ("kinsym explain ur5 theta7", ["theta7"]),
        ("kinsym check ", ["out"]),
        ("kinsym robots ur5 puma", ["puma560"]),
        ("kinsym robots --json puma", ["puma560"]),
        ("kinsym completion z", ["zsh"]),
        ("kinsym derive --name m", []),
        ("kinsym nothing x", []),
    ],
)
def test_bash_completes(tmp_path: Path, words: str, offered: list[str]) -> None:
    """Commands, options, values, robots and files by their place."""
    (tmp_path / "out").mkdir()
    for name in ("my_arm.toml", "my_notes.txt"):
        (tmp_path / name).touch()
    assert completed(tmp_path, *words.split(" ")) == offered


def test_the_command_prints_the_script(capsys: pytest.CaptureFixture[str]) -> None:
    """And names the nearest shell."""
    assert main(["completion", "fish"]) == 0
    assert capsys.readouterr().out == script("fish").rstrip("\n") + "\n"
    assert main(["completion", "bsh"]) == 2
    assert "Did you mean bash?" in capsys.readouterr().err
